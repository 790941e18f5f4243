"""The first Python of README.md runs as it stands, beside the unit that it names."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from unit import paths

README = Path(__file__).resolve().parents[2] / "README.md"


def test_the_first_python_block_runs(tmp_path):
    assert README.is_file(), "README.md is missing"
    blocks = re.findall(r"^```python\n(.*?)^```", README.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL)
    assert blocks, "README.md has no ```python block"
    assert "fmu" in blocks[0], "the block is about a unit"
    shutil.copy(paths()["steel_ball"], tmp_path / "steel_ball.fmu")
    # a plot needs a screen, which a test doesn't have
    environment = {**os.environ, "MPLBACKEND": "Agg"}
    run = subprocess.run(
        [sys.executable, "-c", blocks[0]], cwd=tmp_path, env=environment, capture_output=True, text=True, timeout=120
    )
    assert run.returncode == 0, f"{blocks[0]}\n{run.stderr}"
