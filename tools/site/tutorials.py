# SPDX-License-Identifier: MIT
"""Tutorials: scripts of docs/tutorials in percent format, as pages and as notebooks.

`# %% [markdown]` begins text, `# %%` code. At the end of a code cell stand, as comments, the
pictures that it writes and the lines that it prints:

    # Figure apophis.png: what the picture shows.
    # Prints:
    #   P_1  30.5617 h

tests/docs/test_tutorials.py runs every cell and compares both, so that a page shows nothing else
than what its script did. Pictures are those of docs/figures (make figures)."""

import json
import pathlib
import posixpath
import re
import sys
from dataclasses import dataclass, field

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "tools/figures"))
from gallery import FIGURES, shown_width  # noqa: E402

MARKER = re.compile(r"# %%(?P<markdown> \[markdown\])?$")
FIGURE = re.compile(r"# Figure (?P<file>\S+\.png): (?P<caption>.*)$")
PRINTS = "# Prints:"
LINK = re.compile(r"\]\((?!https?:|#)([^)#\s]+)(#[^)]*)?\)")
DOWNLOAD = """\
<p class="download"><a href="{name}.py" download>{name}.py</a> and
<a href="{name}.ipynb" download>{name}.ipynb</a> are this page as a script and as a notebook: with
<code>polhode[figures]</code> they print and draw what is below.</p>
"""
# Of a notebook; it has no outputs: what it prints and draws is on the page.
KERNEL = {"display_name": "Python 3", "language": "python", "name": "python3"}


@dataclass
class Text:
    """A cell of text, as Markdown."""

    text: str


@dataclass
class Code:
    """A cell of code, what it prints, and its pictures: file -> caption."""

    line: int
    source: str
    printed: str = ""
    figures: dict[str, str] = field(default_factory=dict)


def uncommented(line: str) -> str:
    if not line.startswith("#"):
        raise ValueError(f"got {line!r}; expected a comment")
    return line.removeprefix("#").removeprefix(" ")


def code_cell(line: int, lines: list[str]) -> Code:
    """A cell from its lines, the first of which has this number."""
    said = next((i for i, x in enumerate(lines) if x == PRINTS or FIGURE.match(x)), len(lines))
    cell = Code(line, "\n".join(lines[:said]).strip("\n") + "\n")
    last, prints = None, []
    for number, text in enumerate(lines[said:], line + said):
        figure = FIGURE.match(text)
        if not text.strip():
            continue
        if not text.startswith("#"):
            raise ValueError(f"line {number}: code after what the cell prints or draws")
        if figure:
            last = figure["file"]
            cell.figures[last] = figure["caption"]
        elif text == PRINTS:
            last = PRINTS
        elif last == PRINTS:
            prints.append(text.removeprefix("#").removeprefix("   "))
        else:
            cell.figures[last] += " " + uncommented(text).strip()
    cell.printed = "\n".join(prints) + "\n" if prints else ""
    return cell


def cells(text: str) -> list:
    """The cells of a script in order; what stands before the first is left out."""
    lines = text.splitlines()
    starts = [i for i, line in enumerate(lines) if MARKER.match(line)]
    found = []
    for start, end in zip(starts, [*starts[1:], len(lines)]):
        body = lines[start + 1:end]
        if MARKER.match(lines[start])["markdown"]:
            found.append(Text("\n".join(uncommented(x) for x in body if x.strip()).strip() + "\n"))
        else:
            found.append(code_cell(start + 2, body))
    return found


def code_text(cell: Code) -> str:
    """A cell as Markdown: code, output, pictures with their captions. The code of one that only
    draws stands folded below its picture."""
    code = f"```python\n{cell.source}```\n"
    only_draws = cell.figures and not cell.printed
    parts = [] if only_draws else [code]
    if cell.printed:
        parts.append(f"```text\n{cell.printed}```\n")
    for file, caption in cell.figures.items():
        parts.append(f"```{{figure}} ../figures/{file}\n:alt: {plain(caption)}\n"
                     f":width: {shown_width(FIGURES / file)}px\n\n{caption}\n```\n")
    if only_draws:
        parts.append(f":::{{dropdown}} How it is drawn\n{code}:::\n")
    return "\n".join(parts)


def plain(caption: str) -> str:
    """A caption as the text that stands for the picture: without formulas and links."""
    return re.sub(r"\[([^\]]*)\]\([^)]*\)|[$`*]", r"\1", caption)


def page(name: str, text: str) -> str:
    first, *others = cells(text)
    title, _, rest = first.text.partition("\n")
    parts = [title + "\n", DOWNLOAD.format(name=name), rest]
    parts += [c.text if isinstance(c, Text) else code_text(c) for c in others]
    return "\n".join(parts)


def notebook(text: str, folder: str) -> str:
    """The script as a notebook; its links lead to the files of a folder of the repository."""
    def absolute(match):
        path = posixpath.normpath(f"docs/tutorials/{match[1]}")
        return f"]({folder}/{path}{match[2] or ''})"

    found = []
    for number, cell in enumerate(cells(text), 1):
        if isinstance(cell, Text):
            kind, source = {"cell_type": "markdown"}, LINK.sub(absolute, cell.text)
        else:
            kind = {"cell_type": "code", "execution_count": None, "outputs": []}
            source = cell.source
        lines = source.rstrip("\n").splitlines(keepends=True)
        found.append({**kind, "id": f"cell-{number}", "metadata": {}, "source": lines})
    whole = {"cells": found, "metadata": {"kernelspec": KERNEL}, "nbformat": 4, "nbformat_minor": 5}
    return json.dumps(whole, indent=1) + "\n"


def scripts(root: pathlib.Path = ROOT) -> list[pathlib.Path]:
    return sorted((root / "docs/tutorials").glob("*.py"))
