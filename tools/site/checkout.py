# SPDX-License-Identifier: MIT
"""Links from pages into the checkout, and the directive `shown-files`.

Pages link to files (../../examples/apophis.toml, ../CONTRIBUTING.md), so that they read well
without the site. In the site such a link leads to the page that shows the file; that no page shows
it is a warning."""

import pathlib
import posixpath

from docutils import nodes
from sphinx.addnodes import download_reference, pending_xref
from sphinx.transforms import SphinxTransform
from sphinx.util import logging
from sphinx.util.docutils import SphinxDirective
from sphinx.util.nodes import make_refnode

ROOT = pathlib.Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"
LANGUAGE = {".toml": "toml", ".cpp": "cpp", ".py": "python", ".csv": "text"}
# Pages that stand for a file or a folder as a whole.
PAGES = {
    "README.md": "index",
    "CONTRIBUTING.md": "project/contributing",
    "CHANGELOG.md": "project/changes",
    "docs/references.bib": "references",
    "examples": "examples/files",
    "include/polhode": "reference/cpp/index",
    "python/polhode": "reference/python/index",
}
log = logging.getLogger(__name__)


def table(env) -> dict[str, tuple[str, str]]:
    """File of the checkout -> page and anchor that show it."""
    if not hasattr(env, "polhode_shown"):
        env.polhode_shown = {}
    return env.polhode_shown


def shows(env, path: pathlib.Path, anchor: str) -> None:
    """Says that the page being read shows a file at an anchor."""
    table(env)[path.relative_to(ROOT).as_posix()] = (env.docname, anchor)


def forget(app, env, docname) -> None:
    kept = {path: place for path, place in table(env).items() if place[0] != docname}
    env.polhode_shown = kept


def merge(app, env, docnames, other) -> None:
    """What another process has read."""
    found = {path: place for path, place in table(other).items() if place[0] in docnames}
    env.polhode_shown = {**table(env), **found}


class ShownFiles(SphinxDirective):
    """Files of the checkout, each in full under a heading of its own; the arguments are globs."""

    required_arguments = 1
    final_argument_whitespace = True

    def run(self):
        found = {path for glob in self.arguments[0].split() for path in ROOT.glob(glob)}
        return [self.section(path) for path in sorted(found)]

    def section(self, path: pathlib.Path) -> nodes.section:
        self.env.note_dependency(str(path))
        section = nodes.section("", nodes.title("", path.name), names=[path.name])
        self.state.document.note_implicit_target(section, section)
        text = path.read_text(encoding="utf-8")
        section += nodes.literal_block(text, text, language=LANGUAGE[path.suffix])
        shows(self.env, path, section["ids"][0])
        return section


class CheckoutLinks(SphinxTransform):
    """Marks the links whose target is no page of the site: `checkout` resolves them."""

    default_priority = 200

    def apply(self):
        def is_link(node):
            return isinstance(node, pending_xref | download_reference)

        for node in list(self.document.findall(is_link)):
            path = self.file_of(node) if node.get("reftype") == "myst" else None
            if path is None:
                continue
            anchor = node["reftarget"].partition("#")[2] or node.get("reftargetid") or ""
            mark = pending_xref("", *node.children, reftype="checkout", refwarn=True,
                                refdoc=self.env.docname, reftarget=path, refanchor=anchor)
            mark.source, mark.line = node.source, node.line
            node.replace_self(mark)

    def file_of(self, node) -> str | None:
        """The file or folder of the checkout that a link leads to, if it is no page."""
        target = node["reftarget"].partition("#")[0]
        if node.get("refdomain") == "doc":  # MyST took its suffix for that of a page
            if target in self.env.found_docs:
                return None
            found = (DOCS / f"{target}{suffix}" for suffix in (".py", ".md"))
            path = next((path for path in found if path.exists()), DOCS / target)
        elif not target or "://" in target:
            return None
        else:
            path = pathlib.Path(self.env.doc2path(self.env.docname)).parent / target
        name = pathlib.Path(posixpath.normpath(path))
        if ROOT not in name.parents or DOCS in name.parents and name.suffix not in (".py", ".bib"):
            return None
        return name.relative_to(ROOT).as_posix()


def resolved(app, env, node, contents):
    if node.get("reftype") != "checkout":
        return None
    path = node["reftarget"]
    page, anchor = table(env).get(path) or (PAGES.get(path) or folder_page(env, path), "")
    if page is None:
        log.warning("no page of the site shows %s", path, location=node, type="polhode")
        return contents
    return make_refnode(app.builder, node["refdoc"], page, node["refanchor"] or anchor, contents)


def folder_page(env, path: str) -> str | None:
    """The page of a layer, for include/polhode/LAYER."""
    page = path.replace("include/polhode/", "reference/cpp/")
    return page if page in env.found_docs else None


def setup(app):
    app.add_directive("shown-files", ShownFiles)
    app.add_transform(CheckoutLinks)
    app.connect("env-purge-doc", forget)
    app.connect("env-merge-info", merge)
    app.connect("missing-reference", resolved)
    return {"parallel_read_safe": True}
