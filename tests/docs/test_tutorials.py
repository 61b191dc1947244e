# SPDX-License-Identifier: MIT
"""A tutorial shows what its script did: every cell prints the lines and draws the pictures that the
page shows, and a number in the text stands in the code or in the output."""

import re
import shutil
import sys
from pathlib import Path

import nbformat
import numpy as np
import pytest
import tomllib
from closeness import largest
from matplotlib.image import imread
from python_session import PythonSession
from test_blocks import NUMBER, difference, environment_of

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools/site"))
import tutorials  # noqa: E402

SECONDS = 120
# Of the mean of a block of a picture (black 0, white 1), so that a pixel of a letter may move with
# the version of matplotlib, but no line.
BLOCK, SHADE = 12, 0.15
LINK_TARGET = re.compile(r"\]\([^)]*\)")


def changed(drawn: np.ndarray, shown: np.ndarray) -> float:
    """The largest change of a block of two pictures; infinite where their sizes differ."""
    if drawn.shape != shown.shape:
        return np.inf
    height, width = (n // BLOCK for n in drawn.shape[:2])
    grey = np.abs(drawn.astype(float)[..., :3].mean(-1) - shown.astype(float)[..., :3].mean(-1))
    moved = (drawn.astype(float) - shown)[: height * BLOCK, : width * BLOCK, :3].mean(-1)
    blocks = moved.reshape(height, BLOCK, width, BLOCK).mean((1, 3))
    return largest(np.abs(blocks).max(), grey.mean())


def unsupported(text: str, shown: str) -> list[str]:
    """The decimals of a text that round no number of what was printed."""
    known = [float(n) for n in NUMBER.findall(shown)]
    wrong = []
    for number in re.findall(r"\d+\.\d+", LINK_TARGET.sub("]", text)):
        half = 0.5 * 10.0 ** -len(number.partition(".")[2])
        if not any(abs(abs(k) - float(number)) <= half * (1 + 1e-9) for k in known):
            wrong.append(number)
    return wrong


@pytest.fixture(scope="module", params=tutorials.scripts(ROOT), ids=lambda path: path.stem)
def script(request):
    return request.param


def test_a_cell_prints_and_draws_what_the_page_shows(script, tmp_path, build):
    for table in script.parent.glob("*.txt"):  # what tutorials read
        shutil.copy(table, tmp_path)
    session = PythonSession(tmp_path, environment_of(build), SECONDS)
    try:
        for cell in tutorials.cells(script.read_text(encoding="utf-8")):
            if isinstance(cell, tutorials.Text):
                continue
            there = set(tmp_path.iterdir())
            status, printed = session.run(cell.source)
            where = f"{script.name}:{cell.line}"
            assert status == 0, f"{where}: {printed}"
            missing = difference(printed, cell.printed)
            said = f"{where} printed\n{printed}\nbut says\n{cell.printed}\nfirst at: {missing}"
            assert missing is None, said
            new = {path.name for path in set(tmp_path.iterdir()) - there}
            assert new == set(cell.figures), f"{where}: wrote {new}, says {set(cell.figures)}"
    finally:
        session.close()
    for path in tmp_path.glob("*.png"):
        shown = ROOT / "docs/figures" / path.name
        assert shown.exists(), f"{shown.name} was never drawn: make figures"
        assert changed(imread(path), imread(shown)) <= SHADE, f"{path.name} is old: make figures"


def test_a_number_in_the_text_stands_in_the_code_or_in_the_output(script):
    found = tutorials.cells(script.read_text(encoding="utf-8"))
    code = [cell for cell in found if isinstance(cell, tutorials.Code)]
    shown = "\n".join(cell.source + cell.printed for cell in code)
    said = [cell.text for cell in found if isinstance(cell, tutorials.Text)]
    said += [caption for cell in code for caption in cell.figures.values()]
    assert unsupported("\n".join(said), shown) == []


def test_the_satellite_is_that_of_the_example():
    script = (ROOT / "docs/tutorials/libration.py").read_text(encoding="utf-8")
    text = re.search(r'from_text\("""\\\n(.*?)"""\)', script, re.DOTALL)[1]
    example = (ROOT / "examples/gravity-gradient-satellite.toml").read_text(encoding="utf-8")
    assert tomllib.loads(text) == tomllib.loads(example)


SCRIPT = '''\
# SPDX-License-Identifier: MIT
"""What it is."""
# %% [markdown]
# # Title
#
# Text $x$, 1.5 of it.
# %%
x = 1

print(x / 2)
# Figure a.png: A picture
#   of [it](b.md).
# Prints:
#   0.5
#      indented
# %%
y = 2
'''


def test_cells_of_a_script():
    text, first, last = tutorials.cells(SCRIPT)
    assert text.text == "# Title\n\nText $x$, 1.5 of it.\n"
    assert first.source == "x = 1\n\nprint(x / 2)\n" and first.line == 8
    assert first.printed == "0.5\n   indented\n"
    assert first.figures == {"a.png": "A picture of [it](b.md)."}
    assert last == tutorials.Code(17, "y = 2\n")
    with pytest.raises(ValueError, match="line 19: code after"):
        tutorials.cells(SCRIPT + "# Prints:\nz = 3\n")
    page = tutorials.page("it", SCRIPT)
    assert page.startswith("# Title\n") and 'href="it.py"' in page
    assert "```python\ny = 2\n```" in page and "```text\n0.5\n   indented\n```" in page
    assert "```{figure} ../figures/a.png\n:alt: A picture of it.\n" in page
    drawing = tutorials.page("it", SCRIPT + "# Figure b.png: Lines.\n")
    assert drawing.index("b.png") < drawing.index(":::{dropdown} How it is drawn\n```python\n")


def test_a_notebook_has_the_cells_of_the_script(script):
    text = script.read_text(encoding="utf-8")
    notebook = nbformat.reads(tutorials.notebook(text, "https://example.org/p"), as_version=4)
    nbformat.validate(notebook)
    code = [cell.source for cell in notebook.cells if cell.cell_type == "code"]
    found = [cell for cell in tutorials.cells(text) if isinstance(cell, tutorials.Code)]
    assert code == [cell.source.rstrip("\n") for cell in found] and code
    links = [link for cell in notebook.cells for link in re.findall(r"\]\(([^)]*)\)", cell.source)
             if cell.cell_type == "markdown"]  # fmt: skip
    assert links and all(link.startswith("https://") for link in links)


def test_a_number_that_nothing_printed_is_seen():
    assert unsupported("0.50 and 0.5 of [it](b-7.7.md), 3 of 4", "x = 0.4996") == []
    assert unsupported("0.51", "x = 0.5") == ["0.51"]


def test_a_line_that_moved_is_seen():
    picture = np.ones((240, 240, 4))
    other = picture.copy()
    picture[100:104, :, :3] = 0.3
    other[112:116, :, :3] = 0.3
    assert changed(picture, picture) == 0.0
    assert changed(picture, other) > SHADE
    assert changed(picture, picture[:-1]) == np.inf
