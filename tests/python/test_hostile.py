"""Hostile FMUs and measurements: refused with the reason, nothing written, no memory taken."""

import json
import os
import tempfile
import zipfile
from pathlib import Path

import pytest
from brinell import Contact, ContactError, ProgramError, fit
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
