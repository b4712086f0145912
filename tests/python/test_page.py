"""The programs in Python that README.md and docs/reference/python.md show are run, and print what the pages say.

A program is a block ```python; what it prints is the next block, if that is ```text. Those of a page follow each other as in
one session, in a folder that has the decks of the examples.
"""

import contextlib
import io
import re
import shutil

import matplotlib
import pytest
from conftest import EXAMPLES, SOURCE

matplotlib.use("Agg")
BLOCK = re.compile(r"^```python\n(.*?)^```\n(?:\s*^```text\n(.*?)^```)?", re.M | re.S)


@pytest.mark.parametrize("page", ["README.md", "docs/reference/python.md"])
def test_programs_of_pages_print_what_they_say(page, tmp_path, monkeypatch):
    for deck in EXAMPLES.glob("*.toml"):
        shutil.copy(deck, tmp_path)
    monkeypatch.chdir(tmp_path)
    programs = BLOCK.findall((SOURCE / page).read_text())
    assert programs
    session = {"__name__": "__page__"}
    for program, expected in programs:
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            exec(compile(program, page, "exec"), session)
        assert printed.getvalue().strip() == expected.strip(), program


# Every class and function of the package has its place on the page.
def test_the_page_names_all_there_is():
    import arcwall

    page = (SOURCE / "docs/reference/python.md").read_text()
    for name in set(arcwall.__all__) - {"__version__"}:
        assert name in page, name
    for kind in (arcwall.Deck, arcwall.Path, arcwall.Curve, arcwall.SystemPath, arcwall.EventCurve, arcwall.Events):
        for method in vars(kind):
            if not method.startswith("_"):
                assert method in page, f"{kind.__name__}.{method}"
