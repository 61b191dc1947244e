# SPDX-License-Identifier: MIT
"""What `mkdocs build` asks of polhode: generated pages, navigation by folder, links, KaTeX.

Pages of docs/ link to files of the checkout (../../examples/apophis.toml, ../CONTRIBUTING.md), so
that they read well without the site. In the site such a link goes to the page that shows the file;
one that no page shows is an error of the strict build."""

import functools
import pathlib
import posixpath
import re

import cpp_reference
import python_reference
import references
import tutorials
from mkdocs.exceptions import PluginError
from mkdocs.structure.files import File

import examples

ROOT = pathlib.Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"
# Distributions install it there: package libjs-katex of Debian and Ubuntu.
KATEX = pathlib.Path("/usr/share/javascript/katex")

# Files of the checkout that are pages of the site.
COPIED = {"CONTRIBUTING.md": "project/contributing.md", "CHANGELOG.md": "project/changes.md"}

LINK = re.compile(r"(\[[^\]]*\]\()([^)\s#]+)((?:#[^)\s]*)?\))")
CELL = re.compile(r"<t[dh][ >].*?</t[dh]>", re.DOTALL)
CODE = re.compile(r"(?<=<code>)[^<]+(?=</code>)")
OUTPUT = re.compile(r" *`{3,}text\b")
LONG_NAME = re.compile(r"[\w.:/-]{14,}")
JOINT = re.compile(r"(?<=[a-z0-9][._/:])(?=\w)|(?<=[a-z0-9])(?=[A-Z])")
FENCE = re.compile(r"^( *)(`{3,}|~{3,}).*?^\1\2[ \t]*$", re.MULTILINE | re.DOTALL)


@functools.cache
def generated_pages():
    """Address in the site -> (Markdown, the file whose folder its links start from)."""
    pages = {"references.md": (references.page(ROOT), DOCS / "references.md"),
             "examples.md": (examples.page(ROOT), DOCS / "examples.md")}
    for name, text in cpp_reference.pages(ROOT).items():
        pages[f"reference/cpp/{name}"] = (text, DOCS / "reference/cpp" / name)
    for name, text in python_reference.pages(ROOT).items():
        pages[f"reference/python/{name}"] = (text, DOCS / "reference/python" / name)
    for name, text in tutorials.pages(ROOT).items():
        pages[f"tutorials/{name}"] = (text, DOCS / "tutorials" / name)
    for source, address in COPIED.items():
        pages[address] = ((ROOT / source).read_text(encoding="utf-8"), ROOT / source)
    return pages


def address_of(path):
    """The page that shows a file or folder of the checkout, with an anchor; None if none does."""
    name = path.relative_to(ROOT).as_posix() if ROOT in [path, *path.parents] else ""
    if name == "README.md":
        return "index.md"
    if name == "docs/references.bib":
        return "references.md"
    if name.startswith("docs/tutorials/") and name.endswith(".py"):
        return tutorials.address(name)
    if name.startswith("docs/"):
        return name.removeprefix("docs/")
    if name in COPIED:
        return COPIED[name]
    if name == "examples" or name.startswith("examples/"):
        return examples.address(name)
    if name == "python/polhode":
        return "reference/python/index.md"
    if name.startswith("include/polhode"):
        return cpp_reference.address(name)
    return None


def site_link(target, source, page):
    """The target of a link as the site has it; the target itself where it is no file."""
    if "://" in target or target.startswith(("mailto:", "/")):
        return target
    path = pathlib.Path(posixpath.normpath(source.parent / target))
    if path.suffix == ".md" and DOCS in path.parents and page == source.relative_to(ROOT):
        return target
    address = address_of(path)
    if address is None:
        raise PluginError(f"{source.relative_to(ROOT)}: no page of the site shows {target}")
    place, _, anchor = address.partition("#")
    here = posixpath.dirname(page.relative_to("docs").as_posix())
    return posixpath.relpath(place, here or ".") + ("#" + anchor if anchor else "")


def shown(fence):
    """A fence for readers: an output's `<any>` stands for what is another at every run."""
    return fence.replace("<any>", "\u2026") if OUTPUT.match(fence) else fence


def site_links(markdown, source, page):
    """The Markdown with every link outside of fences as the site has it."""
    def rewritten(text):
        return LINK.sub(lambda m: mended(m, source, page), text)

    parts, end = [], 0
    for fence in FENCE.finditer(markdown):
        parts += [rewritten(markdown[end:fence.start()]), shown(fence[0])]
        end = fence.end()
    return "".join([*parts, rewritten(markdown[end:])])


def mended(match, source, page):
    link = site_link(match[2], source, page)
    anchor = match[3]
    if "#" in link and anchor != ")":
        link = link.partition("#")[0]
    return match[1] + link + anchor


def folder_pages(folder, generated):
    """Pages of a folder of the nav: its index, then by name, then generated ones in their order."""
    names = sorted(p.relative_to(DOCS).as_posix() for p in (DOCS / folder).rglob("*.md"))
    names += [name for name in generated if name.startswith(folder)]
    return sorted(names, key=lambda name: posixpath.basename(name) != "index.md")


def expanded(nav, generated):
    """The nav with entries `folder/` replaced by the pages of that folder; empty ones left out."""
    whole = []
    for entry in nav:
        title, value = next(iter(entry.items())) if isinstance(entry, dict) else (None, entry)
        if isinstance(value, str) and value.endswith("/"):
            value = folder_pages(value, generated)
            if not value:
                continue
        elif isinstance(value, list):
            value = expanded(value, generated)
        whole.append({title: value} if title else value)
    return whole


def katex_files(config):
    if not (KATEX / "katex.min.js").exists():
        raise PluginError(f"{KATEX} is missing: tools/install-deps installs libjs-katex")
    names = ["katex.min.js", "katex.min.css"]
    names += [f"fonts/{p.name}" for p in sorted((KATEX / "fonts").glob("*.woff2"))]
    for name in names:
        yield File.generated(config, f"assets/katex/{name}", abs_src_path=str(KATEX / name))


def on_config(config):
    generated_pages.cache_clear()  # mkdocs serve builds again and again
    config.nav = expanded(config.nav, generated_pages())
    return config


def on_files(files, config):
    for address, (text, source) in generated_pages().items():
        file = File.generated(config, address, content=text)
        file.polhode_source = source
        files.append(file)
    for file in katex_files(config):
        files.append(file)
    return files


def on_page_markdown(markdown, page, **_):
    address = pathlib.PurePosixPath("docs") / page.file.src_uri
    source = getattr(page.file, "polhode_source", ROOT / address)
    return site_links(markdown, source, address)


def on_page_content(html, **_):
    """Long names in tables may break behind a dot or an underscore, and before a capital letter."""
    def breakable(code):
        return LONG_NAME.sub(lambda name: JOINT.sub("<wbr>", name[0]), code[0])

    return CELL.sub(lambda cell: CODE.sub(breakable, cell[0]), html)
