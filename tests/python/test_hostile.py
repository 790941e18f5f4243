"""Hostile FMUs and measurements: refused with the reason, nothing written, no memory taken."""

import json
import os
import tempfile
import time
import zipfile
from pathlib import Path

import pytest
from brinell import Contact, ContactError, ProgramError, fit, temporary
from units import SCENES

HOSTILE = Path(os.environ["BRINELL_TEST_HOSTILE"])
SAID = json.loads((HOSTILE / "said.json").read_text())


@pytest.mark.parametrize("path", SAID)
def test_what_the_program_refuses_is_refused_with_its_reason(path, tmp_path, monkeypatch):
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    with pytest.raises(ContactError) as refused:
        Contact(path)
    assert SAID[path] in str(refused.value) and Path(path).name in str(refused.value)
    assert list(tmp_path.iterdir()) == [], "nothing is left"


def test_a_measurement_that_is_too_large_is_refused_before_it_is_read(tmp_path):
    sparse = tmp_path / "sparse.csv"
    with sparse.open("wb") as file:
        file.truncate(10**13)
    workbook = tmp_path / "bomb.xlsx"
    with zipfile.ZipFile(workbook, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive:
        archive.writestr("xl/worksheets/sheet1.xml", bytes(50_000_000))
    for path, said in [
        (sparse, "sparse.csv: the file has 10000000 MB; allowed for a measurement is 40 MB"),
        (workbook, "bomb.xlsx: xl/worksheets/sheet1.xml in it has 50 MB; allowed for a measurement is 40 MB"),
        (Path("/dev/zero"), "/dev/zero: it has more than 40 MB; allowed for a table is 40 MB"),
    ]:
        if path.exists():
            with pytest.raises((ValueError, ProgramError)) as refused:
                fit(SCENES / "mass_known.toml", path)
            assert said in str(refused.value)


@pytest.mark.skipif(os.name != "posix", reason="locks of folders")
def test_what_a_killed_process_left_is_swept_and_what_is_in_use_stays(tmp_path, monkeypatch):
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))

    def left(name, age):
        (tmp_path / name).mkdir()
        (tmp_path / name / "unit.fmu").write_text("x")
        os.utime(tmp_path / name, (time.time() - age,) * 2)
        return tmp_path / name

    old, new = left("brinell-abcdefgh.tmp", 60), left("brinell-abcdefgi.tmp", 1)
    used, own = left("brinell-abcdefgj.tmp", 60), left("brinell-results", 10**6)
    with temporary.held(used), temporary.folder() as made:
        assert not old.exists(), "nobody uses it"
        assert new.exists(), "it may not have its lock yet"
        assert used.exists() and own.exists() and made.exists()
    assert not made.exists()
