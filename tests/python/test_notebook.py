"""The notebooks of the guide run, and print what they show. BRINELL_WRITE=1 writes them anew."""

import os

import nbclient
import nbformat
import pytest
from units import SCENES

NOTEBOOKS = sorted((SCENES.parent / "docs/examples").glob("*.ipynb"))


def shown(cells):
    """What each cell shows as text or a table; the bytes of a picture depend on its fonts."""
    return [
        [
            output.get("text") or {kind: text for kind, text in output["data"].items() if kind.startswith("text/")}
            for output in cell.get("outputs", [])
        ]
        for cell in cells
    ]


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_shows_what_it_prints(path, tmp_path, monkeypatch):
    # Jupyter and IPython write to the home folder, which may be full
    monkeypatch.setenv("HOME", str(tmp_path))
    notebook = nbformat.read(path, as_version=4)
    before = shown(notebook.cells)
    nbclient.NotebookClient(notebook, resources={"metadata": {"path": tmp_path}}).execute()
    if os.environ.get("BRINELL_WRITE"):
        for cell in notebook.cells:
            # the times of this run
            cell.metadata.pop("execution", None)
        notebook.metadata["language_info"] = {"name": "python"}
        nbformat.write(notebook, path)
    else:
        assert shown(notebook.cells) == before
    pictures = [
        output for cell in notebook.cells for output in cell.get("outputs", []) if "image/png" in output.get("data", {})
    ]
    assert len(pictures) == 1


def test_the_notebook_of_the_drop_test_has_the_scene_of_the_repository():
    (path,) = (path for path in NOTEBOOKS if path.stem == "drop_test")
    cell = nbformat.read(path, as_version=4).cells[1].source
    assert cell == f"%%writefile drop_test.toml\n{(SCENES / 'trades/drop_test.toml').read_text().rstrip()}"
