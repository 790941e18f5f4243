#!/usr/bin/env python3
"""Installs the wheel of a folder that fits this machine, and does with it what its users do first: the commands `export`, `predict`
and `check` without a compiler, and the first example of the Python module.

    python packaging/trial.py target/rehearsal/python
"""

from __future__ import annotations

import argparse
import os
import re
import shutil
import subprocess
import tempfile
import venv
from pathlib import Path

from platforms import ROOT

SCENE = "mass_known"


def tried(wheels: Path) -> str:
    """What the wheel of the folder `wheels` predicts; an error if something fails."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        venv.create(folder / "environment", with_pip=True)
        programs = folder / "environment" / ("Scripts" if os.name == "nt" else "bin")
        pip = [str(programs / "python"), "-m", "pip", "--disable-pip-version-check", "install", "--quiet"]
        # the wheel from the folder, and what it depends on from the registry
        ours = ["--no-index", "--no-deps", "--only-binary", ":all:", "--find-links", str(wheels.resolve()), "brinell"]
        subprocess.run([*pip, *ours], check=True)
        subprocess.run([*pip, "brinell"], check=True)
        shutil.copytree(ROOT / "scenes", folder / "scenes")
        # no compiler, and nothing of this machine's own installation
        kept = {key: value for key, value in os.environ.items() if not key.startswith(("BRINELL", "CARGO", "PYTHON"))}
        alone = kept | {"PATH": str(folder), "HOME": name, "LOCALAPPDATA": name, "XDG_CACHE_HOME": name}

        def said(*command: str | Path) -> str:
            ended = subprocess.run(command, cwd=folder, env=alone, capture_output=True, encoding="utf-8", check=False)
            if ended.returncode:
                raise SystemExit(f"{' '.join(map(str, command))} fails:\n{ended.stdout}{ended.stderr}")
            return ended.stdout

        program = programs / ("brinell.exe" if os.name == "nt" else "brinell")
        scene = f"scenes/{SCENE}.toml"
        said(program, "export", scene)
        said(program, "check", f"{SCENE}.fmu")
        predicted = said(program, "predict", scene)
        example = re.findall(r"```python\n(.*?)```", (ROOT / "python" / "README.md").read_text(encoding="utf-8"), re.S)[
            0
        ]
        if "m/s" not in said(programs / "python", "-c", example):
            raise SystemExit("the first example of the module prints no speed")
        return predicted


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("wheels", type=Path, help="a folder with wheels")
    print(tried(parser.parse_args().wheels), end="")
