# SPDX-License-Identifier: MIT
"""The site builds without a warning (every page in a table of contents, every link leads
somewhere), fetches nothing from elsewhere, and shows what it generates."""

import os
import re
import subprocess
import sys
from html.parser import HTMLParser
from pathlib import Path

import pytest
from pybtex.database import parse_file
from sphinx.testing.util import SphinxTestApp
from sphinx.util.inventory import InventoryFile

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools/site"))
import checkout  # noqa: E402
import cpp_reference  # noqa: E402
import python_reference  # noqa: E402

FETCHED = {"script": "src", "link": "href", "img": "src", "iframe": "src", "source": "src"}


@pytest.fixture(scope="module")
def site(tmp_path_factory, build):
    folder = tmp_path_factory.mktemp("site")
    environment = dict(os.environ, POLHODE_PYTHON=str(build / "python"))
    command = [sys.executable, "-m", "sphinx", "-W", "--keep-going", "-q", "-b", "html",
               "-d", folder / "doctrees", ROOT / "docs", folder / "html"]  # fmt: skip
    done = subprocess.run(command, cwd=ROOT, env=environment, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)  # fmt: skip
    assert done.returncode == 0, done.stdout
    return folder / "html"


class Page(HTMLParser):
    """Anchors of a page, where its links lead, what a browser loads to show it, and how many of
    its tables do not scroll by themselves."""

    def __init__(self, path):
        super().__init__()
        self.anchors, self.links, self.fetched = set(), [], []
        self.tables, self.boxes = 0, 0
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attrs):
        values = dict(attrs)
        kinds = {*(values.get("rel") or "").split()}
        self.anchors |= {values[key] for key in ("id", "name") if values.get(key)}
        self.tables += tag == "table"
        self.boxes += "pst-scrollable-table-container" in (values.get("class") or "")
        if tag == "a" and values.get("href"):
            self.links.append(values["href"])
        elif tag in FETCHED and values.get(FETCHED[tag]):
            if tag != "link" or kinds & {"stylesheet", "icon", "preload"}:
                self.fetched.append(values[FETCHED[tag]])


@pytest.fixture(scope="module")
def pages(site):
    found = (path for path in site.rglob("*.html") if "_static" not in path.parts)
    return {path: Page(path) for path in found}


def test_nothing_is_fetched_from_elsewhere(site, pages):
    seen = 0
    for path, page in pages.items():
        remote = [a for a in page.fetched if re.match(r"(\w+:)?//", a)]
        assert not remote, f"{path.relative_to(site)}: {remote}"
        for address in page.fetched:
            assert (path.parent / re.split("[?#]", address)[0]).exists(), f"{path}: {address}"
            seen += 1
    assert seen > 0
    for sheet in site.rglob("*.css"):
        text = sheet.read_text(encoding="utf-8")
        fetched = re.findall(r"url\(\s*['\"]?(?:https?:)?//[^)]*\)", text)
        assert not fetched, f"{sheet.relative_to(site)}: {fetched}"


def test_every_link_and_anchor_leads_somewhere(site, pages):
    broken = []
    for path, page in pages.items():
        for link in (a for a in page.links if not re.match(r"\w+:", a)):
            place, _, anchor = link.partition("#")
            target = (path.parent / place).resolve() if place else path
            known = pages[target].anchors if target in pages else set()
            if not target.exists() or anchor and target in pages and anchor not in known:
                broken.append(f"{path.relative_to(site)}: {link}")
    assert broken == []


def test_every_table_scrolls_in_itself(site, pages):
    tables = {path.relative_to(site): page.tables - page.boxes for path, page in pages.items()}
    assert {path for path, beside in tables.items() if beside} <= {Path("genindex.html")}
    assert sum(page.tables for page in pages.values()) > 0


def test_the_index_of_the_search_can_be_read_from_a_disk(site):
    # a script, not data that a browser would have to fetch
    index = (site / "searchindex.js").read_text(encoding="utf-8")
    assert index.startswith("Search.setIndex(") and "herpolhod" in index
    assert 'src="searchindex.js"' in (site / "search.html").read_text(encoding="utf-8")


def test_every_public_header_is_in_the_reference(pages, site):
    for header in (ROOT / "include/polhode").rglob("*.hpp"):
        layer = header.parent.name if header.parent.name != "polhode" else "index"
        if header.name == "polhode.hpp" or "detail" in header.parts:
            continue
        anchor = header.name.replace(".", "-").replace("_", "-")
        assert anchor in pages[site / f"reference/cpp/{layer}.html"].anchors, header


def documented(site, kind):
    inventory = InventoryFile.loads((site / "objects.inv").read_bytes(), uri="")
    return {name for group, items in inventory.data.items() if group.startswith(kind)
            for name in items}  # fmt: skip


def test_every_python_name_is_on_one_page_of_the_reference(site, build):
    found = []
    for page in (ROOT / "docs/reference/python").glob("*.md"):
        text = page.read_text(encoding="utf-8")
        for module, names in re.findall(r"```\{names\} (\S+)\n(.*?)```", text, re.DOTALL):
            found += [f"{module}.{name}" for name in names.split()]
    assert len(found) == len(set(found)) and set(found) <= documented(site, "py:")
    code = "import public_names as p; print(*(f'{t.__module__}.{n}' for n, t in p.PUBLIC.items()))"
    path = [str(build / "python"), str(ROOT / "python/tests")]
    environment = dict(os.environ, PYTHONPATH=os.pathsep.join(path))
    done = subprocess.run([sys.executable, "-c", code], env=environment, text=True, check=True,
                          stdout=subprocess.PIPE)  # fmt: skip
    public = set(done.stdout.split())
    assert public - set(found) == set(), "docs/reference/python: no page has these names"


def test_an_overloaded_function_shows_every_signature_and_docstring(site):
    html = (site / "reference/python/bodies-and-states.html").read_text(encoding="utf-8")
    start = html.index('id="polhode.to_rotor"')
    shown = html[start : html.index('id="polhode.angular_velocity"', start)]
    assert shown.count("polhode.EulerState") and shown.count("<dt") > 3
    assert "hub state of Euler angles with their rates" in shown


def test_types_of_other_packages_are_links(site):
    html = (site / "reference/python/bodies-and-states.html").read_text(encoding="utf-8")
    assert "https://numpy.org/doc/stable/reference/typing.html#numpy.typing.ArrayLike" in html
    assert "scipy.spatial.transform.Rotation.html" in html


def test_types_of_cpp_are_links(site):
    html = (site / "reference/cpp/free.html").read_text(encoding="utf-8")
    assert re.search(r'href="rotor\.html#[^"]*polhode4BodyE"', html)
    assert "polhode::FreeRotation::at" in documented(site, "cpp:")


def test_every_example_is_shown(pages, site):
    for path in (ROOT / "examples").iterdir():
        if path.suffix in (".toml", ".cpp", ".py"):
            anchors = pages[site / "examples/files.html"].anchors
            assert re.sub("[._]", "-", path.name) in anchors, path.name


LINKS = """\
# Page

[a](other.md#a-part) [b](../examples/b.toml) [c](../examples) [d](https://example.org/b.md)
[e](../LICENSE)

```{shown-files} examples/*.toml
```
"""


def test_links_into_the_checkout_lead_to_the_page_that_shows_the_file(tmp_path, monkeypatch):
    docs = tmp_path / "docs"
    for folder in (docs / "examples", tmp_path / "examples"):
        folder.mkdir(parents=True)
    (docs / "conf.py").write_text("extensions = ['myst_parser', 'checkout']\n"
                                  "myst_heading_anchors = 3\n")  # fmt: skip
    (docs / "index.md").write_text(LINKS)
    (docs / "other.md").write_text("# Other\n\n## A part\n")
    (docs / "examples/files.md").write_text("# Files\n")
    (tmp_path / "examples/b.toml").write_text("schema = 1\n")
    (tmp_path / "LICENSE").write_text("MIT\n")
    monkeypatch.setattr(checkout, "ROOT", tmp_path)
    monkeypatch.setattr(checkout, "DOCS", docs)
    app = SphinxTestApp("html", docs, builddir=tmp_path / "build")
    try:
        app.build()
        html = (Path(app.outdir) / "index.html").read_text(encoding="utf-8")
        warned = app.warning.getvalue()
    finally:
        app.cleanup()
    for address in ("other.html#a-part", "#b-toml", "examples/files.html",
                    "https://example.org/b.md"):  # fmt: skip
        assert f'href="{address}"' in html, address
    assert "no page of the site shows LICENSE" in warned
    assert warned.count("no page of the site") == 1


def test_the_formulas_reach_the_page(site):
    html = (site / "theory/regimes.html").read_text(encoding="utf-8")
    formulas = re.findall(r'class="math[^"]*">([^<]*)<', html)
    assert any("kappa" in formula for formula in formulas)
    assert (site / "_static/katex/katex.min.js").stat().st_size > 0
    assert list((site / "_static/katex/fonts").glob("*.woff2"))


def test_a_tutorial_is_a_page_a_script_and_a_notebook(site):
    for path in (ROOT / "docs/tutorials").glob("*.py"):
        folder = site / "tutorials"
        assert (folder / path.name).read_bytes() == path.read_bytes()
        assert (folder / f"{path.stem}.ipynb").exists()
        assert f'href="{path.stem}.ipynb"' in (folder / f"{path.stem}.html").read_text()


def test_every_reference_has_a_doi_or_says_why_not(pages, site):
    for key, entry in parse_file(ROOT / "docs/references.bib").entries.items():
        assert ("doi" in entry.fields) != ("nodoi" in entry.fields), key
        assert re.fullmatch(r"10\.\d{4,}/\S+", entry.fields.get("doi", "10.1000/none")), key
        assert key in pages[site / "references.html"].anchors, key


HEADER = """\
#pragma once
#include <vector>
namespace polhode {
inline namespace v0 {
namespace detail {
struct Hidden { int x; };
}  // namespace detail

// What it is.
class Thing : public std::vector<int> {
 public:
  // Makes one.
  explicit Thing(double x) : x_{x}, y_(x) { check("}"); }

  void check(const char*);
  double x() const { return x_; }  // metres
  double y() const { return y_; }
  template <class T>
    requires(sizeof(T) > 1)
  T as(const T& a = T{}) const;
  bool operator==(const Thing&) const = default;

 private:
  double x_, y_;
};
enum class Mode {
  fast,  // quick
  slow
};
struct Point {
  double x{}, y = 2.0;  // both
};
template <class T>
concept Small = sizeof(T) < 3;
template <Small T = char>
std::vector<T> made(const std::vector<T>& v) {
  if (v.empty()) { return {}; }
  return {v[0]};
}
inline void Thing::check(const char*) {}
using Things = std::vector<Thing>;
inline constexpr double table[] = {1.0, 2.0};
extern template std::vector<char> made(const std::vector<char>&);
}  // namespace v0
}  // namespace polhode
"""
DECLARED = """\
.. cpp:class:: Thing : public std::vector<int>
   What it is.
   .. cpp:function:: explicit Thing(double x)
      Makes one.
   .. cpp:function:: void check(const char*)
   .. cpp:function:: double x() const
      metres
   .. cpp:function:: double y() const
                      template <class T> requires(sizeof(T) > 1) T as(const T& a = T{}) const
                      bool operator==(const Thing&) const
.. cpp:enum-class:: Mode
   .. cpp:enumerator:: fast
      quick
   .. cpp:enumerator:: slow
.. cpp:struct:: Point
   .. cpp:member:: double x
                    double y = 2.0
      both
.. cpp:concept:: template <class T> Small
.. cpp:function:: template <Small T = char> std::vector<T> made(const std::vector<T>& v)
.. cpp:type:: Things = std::vector<Thing>
.. cpp:var:: constexpr double table[]"""


def test_declarations_leave_out_bodies_private_members_and_details(tmp_path):
    header = tmp_path / "thing.hpp"
    header.write_text(HEADER)
    found = cpp_reference.declarations_of([header])
    text = cpp_reference.text_of(found[str(header)])
    assert "\n".join(line for line in text.splitlines() if line.strip()) == DECLARED


def test_docstrings_with_sections_become_fields():
    text = "Makes q* of [it].\n\nParameters\n----------\na, b : two `a*b`\n    of them.\nc : one.\n"
    text += "\nReturns\n-------\nThing\n    What was made.\n\nNever throws.\n\n>>> a*b*c"
    lines = text.splitlines()
    python_reference.docstring(None, "function", "f", None, None, lines)
    assert [line for line in lines if line] == [
        "Makes q\\* of [it].",
        ":param a,b: two ``a*b`` of them.", ":param c: one.",
        ":returns: Thing -- What was made.",
        "Never throws.", ">>> a*b*c"]  # fmt: skip
