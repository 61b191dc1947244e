# SPDX-License-Identifier: MIT
"""The map of the paper: which declaration a comment belongs to, and what --check rejects."""

import sys

import pytest

sys.dont_write_bytecode = True

HEADER = """\
// A header.
//
// Equations   [SA (1)]
#pragma once

namespace polhode {
inline namespace v0 {

// [SA (2)]
template <Number T>
  requires(!Real<T>)
struct BasicState {
  T x;  // [SA (3)]
  T a, b;  // [SA (4)]

  // The energy { of a brace in a comment  [SA (5)]
  double energy() const { return x * x; }

 private:
  int count_ = 1'000;
};
using State = BasicState<double>;

// [SA (6)]
State first(const char* text = "{ // [SA (7)]");
State second(double x);

State third(double x) noexcept(noexcept(f(x))) {
  // [SA (8)]
  return {};
}
inline constexpr double fourth = 2.0;  // [SA (9)]
inline const double fifth = [] { return 1.0; }() + State{}.x;
// [SA (10)]
State& operator+=(State& a, const State& b) { return a; }
extern template State first(const State&);

}  // namespace v0
}  // namespace polhode
"""

OWNERS = {1: [], 2: ["BasicState", "State"], 3: ["BasicState::x"], 4: ["BasicState"],
          5: ["BasicState::energy"], 6: ["first", "second"], 8: ["third"], 9: ["fourth"],
          10: ["operator+="]}


@pytest.fixture
def tools(root, monkeypatch):
    monkeypatch.syspath_prepend(str(root / "tools"))


@pytest.mark.parametrize("number", OWNERS)
def test_a_comment_belongs_to_its_declarations(tools, number):
    from declarations import Source

    assert Source(HEADER).owners(HEADER.index(f"[SA ({number})]")) == OWNERS[number]


def test_every_header_is_read(tools, root):
    """No public function is lost: each has a name, and none swallows another."""
    from declarations import Source

    for path in sorted((root / "include/polhode").rglob("*.hpp")):
        source = Source(path.read_text(encoding="utf-8"))
        lengths = [source.text.count("\n", i.first, i.last) for i in source.items]
        assert all(length < 400 for length in lengths), path
        for item in source.items:
            head = source.code[item.first:item.last]
            assert item.name or head.startswith(("extern", "template", "static_assert")), head


PROOFS = """\
## Section 2: Eulerian variables

| equation | statement | result | right form | how |
|---|---|---|---|---|
| (1) | `a = b` | proven |  | Insert. |
| (2) | `c = d` | definition |  | |
| a\\_b | `e = f` | misprinted | `e = g` | Insert. |
"""
LIBRARY = """\
namespace polhode {
// [SA (1)]
double one(double x);
// [SA (2)]
double two(double x);
}  // namespace polhode
"""
TESTS = """\
namespace {
double helper() { return one(1.0); }
// [SA (1)]
TEST(Paper, LibraryOne) { EXPECT_EQ(helper(), 1.0); }
// [SA (2)]
TEST(Paper, LibraryTwo) { EXPECT_EQ(two(1.0), 1.0); }
// [SA "a_b"]
TEST(PaperErrata, Formula) { EXPECT_EQ(1.0, 1.0); }
}  // namespace
"""


@pytest.fixture
def check(tools, tmp_path, monkeypatch, capsys):
    """What --check says of a small project, texts changed by (file, old, new)."""
    import paper_map

    monkeypatch.setattr(paper_map, "PAPER", {"2": "1-2 a_b"})
    monkeypatch.setattr(paper_map, "ROOT", tmp_path)
    for name in ("PAGE", "PROOFS", "ERRATA"):
        monkeypatch.setattr(paper_map, name, tmp_path / name.lower())
    files = {"include/polhode/one.hpp": LIBRARY, "tests/paper/one.cpp": TESTS, "proofs": PROOFS,
             "errata": "`PaperErrata.Formula`"}

    def run(*changes):
        paper_map.source.cache_clear()
        for name, text in files.items():
            for file, old, new in changes:
                assert file != name or old in text
                text = text.replace(old, new) if file == name else text
            path = tmp_path / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        paper_map.main([])
        capsys.readouterr()
        failed = paper_map.main(["--check"])
        lines = capsys.readouterr().out.splitlines()
        assert failed == bool(lines)
        return lines

    return run


def test_a_map_that_is_true_passes(check, tmp_path):
    assert check() == []
    page = (tmp_path / "page").read_text(encoding="utf-8")
    one = "`one` ([one.hpp](../../include/polhode/one.hpp))"
    assert f"| (1) | {one} |  | `Paper.LibraryOne` | [proven]" in page
    assert "| a\\_b | not used |  | formula only: `PaperErrata.Formula` | [misprinted]" in page


@pytest.mark.parametrize("change, message", [
    (("tests/paper/one.cpp", "LibraryOne", "One"),
     "1 of section 2: no library test, but include/polhode/one.hpp uses it"),
    (("include/polhode/one.hpp", "// [SA (1)]\n", ""),
     "1 of section 2: tested by Paper.LibraryOne, but no declaration has the tag"),
    (("tests/paper/one.cpp", "two(1.0)", "1.0"),
     "2 of section 2: Paper.LibraryTwo names none of two"),
    (("proofs", "| (1) | `a = b` | proven |  | Insert. |\n", ""),
     "docs/theory/proofs: no proof of 1, section 2"),
    (("include/polhode/one.hpp", "[SA (1)]", "[SA (1), (17)]"),
     "include/polhode/one.hpp: [SA (1), (17)] names no equation of the paper, or more than one: "
     "17"),
    (("errata", "Formula", "Other"), "docs/theory/errata.md: no test PaperErrata.Other"),
])
def test_a_map_that_is_false_fails(check, change, message):
    assert message in check(change)


def test_a_definition_without_a_test_fails(check):
    lines = check(("include/polhode/one.hpp", "// [SA (2)]\n", ""),
                  ("tests/paper/one.cpp", "// [SA (2)]\n", ""))
    assert lines == ["2 of section 2: neither a test nor a proof"]


def test_an_equation_without_a_row_fails(check, monkeypatch):
    import paper_map

    monkeypatch.setattr(paper_map, "PAPER", {"2": "1-3 a_b"})
    assert check() == ["docs/theory/proofs: no proof of 3, section 2",
                       "3 of section 2: neither a test nor a proof"]
