# SPDX-License-Identifier: MIT
"""Scripts that are pages: tutorials in cells, and those that draw a figure of the gallery.

Each page offers its script to download, a tutorial a notebook, too."""

import pathlib
import shutil
import sys

import tutorials
from myst_parser.parsers.sphinx_ import MystParser

sys.path.append(str(tutorials.ROOT / "tools/figures"))
import gallery  # noqa: E402

DOWNLOADS = ("*.py", "*.txt")


class ScriptParser(MystParser):
    supported = ("script",)

    def parse(self, inputstring, document):
        path = pathlib.Path(document.settings.env.doc2path(document.settings.env.docname))
        page = tutorials.page if path.parent.name == "tutorials" else gallery_page
        super().parse(page(path.stem, inputstring), document)


def gallery_page(name: str, _: str) -> str:
    title, caption, code = gallery.described(name)
    picture = gallery.picture(name)
    return (f"# {title}\n\n```{{image}} ../figures/{picture.name}\n:alt: {title}\n"
            f":width: {gallery.shown_width(picture)}px\n```\n\n{caption}\n\n"
            f'<p class="download"><a href="{name}.py" download>{name}.py</a></p>\n\n'
            f"```python\n{code}\n```\n")  # fmt: skip


def copy_downloads(app, error) -> None:
    for folder in ("tutorials", "gallery"):
        target = pathlib.Path(app.outdir) / folder
        for pattern in DOWNLOADS if not error else ():
            for path in (pathlib.Path(app.srcdir) / folder).glob(pattern):
                shutil.copy(path, target)
    files = f"{app.config.repository}/blob/main"
    for path in tutorials.scripts() if not error else ():
        notebook = tutorials.notebook(path.read_text(encoding="utf-8"), files)
        (pathlib.Path(app.outdir) / "tutorials" / f"{path.stem}.ipynb").write_text(notebook)


def setup(app):
    app.add_config_value("repository", "", "html")
    app.add_source_parser(ScriptParser)
    app.connect("build-finished", copy_downloads)
    return {"parallel_read_safe": True}
