"""The notebooks of python/notebooks run from beginning to end."""

import nbformat
import pytest
from conftest import SOURCE
from nbclient import NotebookClient

NOTEBOOKS = sorted((SOURCE / "python" / "notebooks").glob("*.ipynb"))


@pytest.mark.parametrize("file", NOTEBOOKS, ids=lambda file: file.stem)
def test_a_notebook_runs(file):
    notebook = nbformat.read(file, as_version=4)
    NotebookClient(notebook, timeout=120, kernel_name="python3", resources={"metadata": {"path": str(file.parent)}}).execute()
    assert not any(cell.get("outputs") for cell in nbformat.read(file, as_version=4).cells), "the checked-in one has no outputs"
