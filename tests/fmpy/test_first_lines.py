"""The lines of Python with which an FMU's own page begins run as printed, and say what its sentence says."""

import html
import math
import re
import runpy
import zipfile

import pytest
from unit import paths

# One contact in so many steps, with the force of a step late at worst.
TOLERANCE = 0.03


def page(name):
    with zipfile.ZipFile(paths()[name]) as fmu:
        return fmu.read("documentation/index.html").decode()


def ran(name, folder, monkeypatch, capfd):
    """What the lines print, in a folder with the FMU under its own name."""
    text = page(name)
    block = re.search(r"<pre><code>(.*?)</code></pre>", text, re.S)
    lines = html.unescape(block[1])
    assert 9 <= len(lines.splitlines()) <= 14
    own = re.search(r'extract\("(.*?)"\)', lines)[1]
    (folder / own).write_bytes(open(paths()[name], "rb").read())
    (folder / "run.py").write_text(lines)
    monkeypatch.chdir(folder)
    runpy.run_path("run.py", run_name="__main__")
    said = capfd.readouterr()
    assert "warning" not in (said.out + said.err).lower(), said
    return said.out


def in_si(value, unit):
    prefix = {"n": 1e-9, "µ": 1e-6, "m": 1e-3, "k": 1e3, "M": 1e6}
    return float(value) * (prefix[unit[0]] if len(unit) > 1 else 1.0)


@pytest.mark.parametrize("name", sorted(paths()))
def test_the_first_lines_run_as_printed(name, tmp_path, monkeypatch, capfd):
    printed = ran(name, tmp_path, monkeypatch, capfd)
    if printed.startswith("mean force"):
        assert float(printed.split()[2]) > 0.0
        return
    force, restitution = re.match(r"largest force (\S+) N, restitution (\S+)\n", printed).groups()
    sentence = re.search(r"raises the force to (\S+) (\S+); .* and (\S+) of the speed comes back", page(name))
    wanted_force = in_si(sentence[1], sentence[2])
    assert math.isclose(float(restitution), float(sentence[3]), abs_tol=TOLERANCE), printed
    assert math.isclose(float(force), wanted_force, rel_tol=TOLERANCE), printed
