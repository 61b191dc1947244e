# SPDX-License-Identifier: MIT
"""The site builds strictly (every page in the nav, every link and anchor leads somewhere), fetches
nothing from elsewhere, and shows what it generates."""

import os
import re
import subprocess
import sys
from html import unescape
from html.parser import HTMLParser
from pathlib import Path, PurePosixPath

import pytest
from mkdocs.exceptions import PluginError

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools/site"))
import docstrings  # noqa: E402
import hooks  # noqa: E402
import python_reference  # noqa: E402
import references  # noqa: E402
from declarations import declarations  # noqa: E402

FETCHED = {"script": "src", "link": "href", "img": "src", "iframe": "src", "source": "src"}


@pytest.fixture(scope="module")
def site(tmp_path_factory, build):
    out = tmp_path_factory.mktemp("site")
    environment = dict(os.environ, POLHODE_PYTHON=str(build / "python"), NO_MKDOCS_2_WARNING="1")
    command = [sys.executable, "-m", "mkdocs", "build", "--strict", "-d", out]
    done = subprocess.run(command, cwd=ROOT, env=environment, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    # --quiet would switch --strict off with the warnings
    assert done.returncode == 0 and "WARNING" not in done.stdout, done.stdout
    return out


class Fetched(HTMLParser):
    """Addresses that a browser loads to show a page."""

    def __init__(self):
        super().__init__()
        self.addresses = []

    def handle_starttag(self, tag, attrs):
        values = dict(attrs)
        kinds = {*values.get("rel", "").split()}
        if tag == "link" and not kinds & {"stylesheet", "icon", "preload"}:
            return
        if tag in FETCHED and values.get(FETCHED[tag]):
            self.addresses.append(values[FETCHED[tag]])


def test_nothing_is_fetched_from_elsewhere(site):
    seen = 0
    for page in site.rglob("*.html"):
        parser = Fetched()
        parser.feed(page.read_text(encoding="utf-8"))
        remote = [a for a in parser.addresses if re.match(r"(\w+:)?//", a)]
        assert not remote, f"{page.relative_to(site)}: {remote}"
        for address in (a for a in parser.addresses if page.name != "404.html"):
            path = page.parent / address.split("?")[0].split("#")[0]
            assert path.exists(), f"{page}: {address}"
            seen += 1
    assert seen > 0
    for sheet in site.rglob("*.css"):
        text = sheet.read_text(encoding="utf-8")
        fetched = re.findall(r"url\(\s*['\"]?(?:https?:)?//[^)]*\)", text)
        assert not fetched, f"{sheet.relative_to(site)}: {fetched}"


def test_every_public_header_is_in_the_reference(site):
    for header in (ROOT / "include/polhode").rglob("*.hpp"):
        layer = header.parent.name if header.parent.name != "polhode" else "index"
        if header.name == "polhode.hpp" or layer == "detail":
            continue
        html = (site / f"reference/cpp/{layer}.html").read_text(encoding="utf-8")
        assert f'id="{header.name.replace(".", "-").replace("_", "-")}"' in html, header


def test_every_python_name_is_on_one_page_of_the_reference(site):
    index = (site / "reference/python/index.html").read_text(encoding="utf-8")
    assert f">{python_reference.OTHERS}<" not in index, "tools/site/python_reference.py: see Others"
    names = [name for page in python_reference.PAGES for group in page.groups.values()
             for name in group.split()]
    assert len(names) == len(set(names))


def test_an_overloaded_function_shows_every_signature_and_docstring(site):
    html = (site / "reference/python/bodies-and-states.html").read_text(encoding="utf-8")
    start = html.index('id="polhode.to_rotor"')
    shown = html[start:html.index('<h3 id="polhode.', start)]
    assert shown.count("doc-signature") > 3
    assert "hub state of Euler angles with their rates" in shown
    assert "polhode.EulerState)" not in shown  # nanobind's own list of signatures


def test_every_example_is_shown(site):
    html = (site / "examples.html").read_text(encoding="utf-8")
    for path in (ROOT / "examples").iterdir():
        if path.suffix in (".toml", ".cpp", ".py"):
            assert f'id="{path.name.replace(".", "-")}"' in html, path.name


def test_links_into_the_checkout_lead_to_the_page_that_shows_the_file():
    source = ROOT / "docs/guide/tumblers.md"

    def linked(markdown):
        return hooks.site_links(markdown, source, PurePosixPath("docs/guide/tumblers.md"))

    assert linked("[a](charts.md#on-the-command-line)") == "[a](charts.md#on-the-command-line)"
    assert linked("[a](../../examples/apophis.toml)") == "[a](../examples.md#apophis-toml)"
    header = "../../include/polhode/free/free_rotation.hpp"
    assert linked(f"[a]({header})") == "[a](../reference/cpp/free.md#free-rotation-hpp)"
    assert linked("[a](../../CONTRIBUTING.md#build-and-test)") == (
        "[a](../project/contributing.md#build-and-test)")
    assert linked("[a](https://example.org/b.md)") == "[a](https://example.org/b.md)"
    assert linked("```\n[a](../../LICENSE)\n```") == "```\n[a](../../LICENSE)\n```"
    assert linked("```text\nt = <any> s\n```\n`<any>`") == "```text\nt = \u2026 s\n```\n`<any>`"
    with pytest.raises(PluginError, match="no page of the site shows ../../Makefile"):
        linked("[a](../../Makefile)")


def test_the_formulas_reach_the_page(site):
    html = (site / "theory/regimes.html").read_text(encoding="utf-8")
    formulas = re.findall(r'class="arithmatex">([^<]*)<', html)
    assert any("kappa" in unescape(formula) for formula in formulas)
    assert (site / "assets/katex/katex.min.js").stat().st_size > 0


def test_every_reference_has_a_doi_or_says_why_not():
    found = references.entries((ROOT / "docs/references.bib").read_text(encoding="utf-8"))
    text = (ROOT / "docs/references.bib").read_text(encoding="utf-8")
    assert len(found) == text.count("\n@")
    for entry in found:
        assert ("doi" in entry) != ("nodoi" in entry), entry["key"]
        assert re.fullmatch(r"10\.\d{4,}/\S+", entry.get("doi", "10.1000/none")), entry["key"]
        assert entry["author"] and entry["title"] and not set("{}\\") & set("".join(entry.values()))


HEADER = """\
#pragma once
#include <vector>
namespace polhode {
inline namespace v0 {
namespace detail {
struct Hidden { int x; };
}  // namespace detail

// What it is.
class Thing : public Base {
 public:
  // Makes one.
  explicit Thing(double x) : x_{x}, y_(f(x)) { check("}"); }
  double x() const { return x_; }  // metres
  template <class T>
    requires(sizeof(T) > 1)
  T as(const T& a = T{}) const;

 private:
  double x_, y_;
};
enum class Mode {
  fast,  // quick
  slow
};
template <Real T = double>
BasicThing<T> made(const std::vector<T>& v) {
  if (v.empty()) { return {}; }
  return {v[0]};
}
template <Real T>
T BasicThing<T>::member() const { return T(1.0); }
inline constexpr double table[] = {1.0, 2.0};
extern template Thing made(const std::vector<double>&);
}  // namespace v0
}  // namespace polhode
"""
DECLARED = """\
// What it is.
class Thing : public Base {
 public:
  // Makes one.
  explicit Thing(double x);
  double x() const;  // metres
  template <class T>
    requires(sizeof(T) > 1)
  T as(const T& a = T{}) const;
};
enum class Mode {
  fast,  // quick
  slow
};
template <Real T = double>
BasicThing<T> made(const std::vector<T>& v);
inline constexpr double table[] = {1.0, 2.0};"""


def test_declarations_leave_out_bodies_private_members_and_details():
    assert declarations(HEADER) == DECLARED


def test_docstrings_with_sections_become_markdown():
    text = "Makes q* of [it].\n\nParameters\n----------\na, b : two `a*b`\n    of them.\nc : one.\n"
    text += "\nReturns\n-------\nThing\n    What was made.\n\nNever throws.\n\n>>> a*b*c"
    assert [line for line in docstrings.as_markdown(text).splitlines() if line] == [
        "Makes q\\* of \\[it\\].",
        "**Parameters**", "`a, b`", ":   two `a*b` of them.", "`c`", ":   one.",
        "**Returns**", "Thing", ":   What was made.",
        "Never throws.", "```pycon", ">>> a*b*c", "```"]
