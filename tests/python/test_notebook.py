"""The notebook of the guide runs, and prints what it shows. BRINELL_WRITE=1 writes it anew."""

import os
from pathlib import Path

import nbclient
import nbformat

NOTEBOOK = Path(os.environ["BRINELL_TEST_SCENES"]).parent / "docs/examples/impacts.ipynb"


def shown(cells):
    """What each cell shows as text or a table; the bytes of a picture depend on its fonts."""
    return [
        [
            output.get("text")
            or {kind: text for kind, text in output["data"].items() if kind.startswith("text/")}
            for output in cell.get("outputs", [])
        ]
        for cell in cells
    ]


def test_the_notebook_shows_what_it_prints(tmp_path, monkeypatch):
    # Jupyter and IPython write to the home folder, which may be full
    monkeypatch.setenv("HOME", str(tmp_path))
    notebook = nbformat.read(NOTEBOOK, as_version=4)
    before = shown(notebook.cells)
    nbclient.NotebookClient(notebook, resources={"metadata": {"path": tmp_path}}).execute()
    if os.environ.get("BRINELL_WRITE"):
        for cell in notebook.cells:
            # the times of this run
            cell.metadata.pop("execution", None)
        notebook.metadata["language_info"] = {"name": "python"}
        nbformat.write(notebook, NOTEBOOK)
    else:
        assert shown(notebook.cells) == before
    pictures = [
        output
        for cell in notebook.cells
        for output in cell.get("outputs", [])
        if "image/png" in output.get("data", {})
    ]
    assert len(pictures) == 1
