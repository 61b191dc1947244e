# SPDX-License-Identifier: MIT
"""KaTeX, and what a page of Markdown says in comments and words that a code host shows as they are.

    <!-- tabs -->      paragraphs **Python** and **C++** up to `<!-- end of tabs -->` are labels of
                       tabs; on a code host they follow one another
    <any>              in an output: what is another at every run, here an ellipsis"""

import pathlib
import re
import shutil

from docutils import nodes
from pygments.lexers.special import TextLexer
from sphinx.errors import ExtensionError

KATEX = pathlib.Path("/usr/share/javascript/katex")
TABS = re.compile(r"^<!-- tabs -->$\n(.*?)^<!-- end of tabs -->$", re.MULTILINE | re.DOTALL)
LABEL = re.compile(r"^\*\*(.+)\*\*$", re.MULTILINE)


def tab_set(match: re.Match) -> str:
    _, *parts = LABEL.split(match[1])
    items = (f":::{{tab-item}} {label}\n:sync: {label}\n{text.rstrip()}\n:::\n"
             for label, text in zip(parts[::2], parts[1::2]))  # fmt: skip
    return f"::::{{tab-set}}\n{''.join(items)}::::\n"


def read(app, docname, content) -> None:
    content[0] = TABS.sub(tab_set, content[0])


def show_any(app, doctree) -> None:
    for block in doctree.findall(nodes.literal_block):
        if block.get("language") == "text":
            text = block.astext().replace("<any>", "\u2026")
            block.children = [nodes.Text(text)]
            block.rawsource = text


def copy_katex(app) -> None:
    """The files of the distribution's package libjs-katex that a browser loads."""
    if not (KATEX / "katex.min.js").exists():
        raise ExtensionError(f"{KATEX} is missing: tools/install-deps installs libjs-katex")
    target = pathlib.Path(app.outdir) / "_static/katex"
    (target / "fonts").mkdir(parents=True, exist_ok=True)
    fonts = (KATEX / "fonts").glob("*.woff2")
    for path in (KATEX / "katex.min.js", KATEX / "katex.min.css", *fonts):
        place = "fonts" if path.suffix == ".woff2" else "."
        shutil.copyfile(path, target / place / path.name)


def setup(app):
    app.connect("builder-inited", copy_katex)
    app.add_lexer("csv", TextLexer)
    app.connect("source-read", read)
    app.connect("doctree-read", show_any)
    return {"parallel_read_safe": True}
