# SPDX-License-Identifier: MIT
"""tools/mutate: which mutants a source has, how they are drawn, and what is compiled for them."""

import pathlib
import subprocess
import sys

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))

import compiler_headers  # noqa: E402
from mutate import (  # noqa: E402
    campaign,
    draw,
    equivalent,
    operators,
    reach,
    report,
    results,
    schemata,
    sites,
)
from mutate.mutant import Mutant, numbered  # noqa: E402

SOURCE = """\
#include <algorithm>
#include <array>
#include <cmath>
#define SQUARE_OF(x) ((x) * (x))
constexpr double half = 0.5;
constexpr std::array<int, 2> table{7, 9};
static_assert(half + half == 1.0);
struct Vec {
  double x = 0.0, y = 0.0, z = 0.0;
};
template <class T>
T combined(const T& a, const T& b) {  // + in a comment
  using std::sqrt;
  if constexpr (sizeof(T) > 4) return sqrt(a) - T(half) *
                                                    b;
  return a;
}
double norm(const Vec& v, int n) {
  std::array<double, 3> a{v.x, v.y, v.z};
  switch (n) {
    case 4: return SQUARE_OF(a[0] + 1.0);
    default: break;
  }
  double sum = n < 3 ? std::min(a[0], a[1]) : -a[2];
  for (int i = 0; i < 3; ++i) sum += a[i];
  return sum;
}
"""
FLAGS = ["-x", "c++", "-std=c++20"]


@pytest.fixture(scope="module")
def clang_flags():
    return [*FLAGS, *compiler_headers.arguments()]


@pytest.fixture(scope="module")
def source(tmp_path_factory):
    folder = tmp_path_factory.mktemp("mutate")
    (folder / "part.cpp").write_text(SOURCE)
    return folder


@pytest.fixture(scope="module")
def mutants(source, clang_flags):
    return sites.candidates(source, "part.cpp", "free", clang_flags)


def changes(mutants, line):
    return {(m.operator, m.original, m.mutated) for m in mutants if m.line == line}


def test_every_operator_is_found(mutants):
    product = "T(half) * b"
    assert changes(mutants, 14) == {
        ("arithmetic", f"sqrt(a) - {product}", f"sqrt(a) + {product}"),
        ("term", f"sqrt(a) - {product}", "sqrt(a)"),
        ("term", f"sqrt(a) - {product}", f"-({product})"),
        ("function", "sqrt(a)", "a"),
        ("arithmetic", product, "T(half) / b"),
        ("factor", product, "T(half)"),
        ("factor", product, "b"),
        ("literal", "half", "0.25"),
    }
    assert changes(mutants, 24) == {
        ("sign", "n < 3 ? std::min(a[0], a[1]) : -a[2]",
         "-(n < 3 ? std::min(a[0], a[1]) : -a[2])"),
        ("condition", "n < 3", "!(n < 3)"),
        ("comparison", "n < 3", "n <= 3"),
        ("comparison", "n < 3", "n > 3"),
        ("literal", "3", "2"),
        ("function", "std::min(a[0], a[1])", "std::max(a[0], a[1])"),
        ("index", "0", "1"),
        ("index", "1", "0"),
        ("sign", "-a[2]", "a[2]"),
        ("index", "2", "1"),
    }
    assert {m.operator for m in mutants} == set(operators.NAMES)


def test_constants_types_labels_and_macros_are_left_alone(mutants):
    lines = SOURCE.split("\n")
    untouched = [i for i, text in enumerate(lines, 1)
                 if text.startswith(("#", "constexpr", "static_assert", "template"))
                 or "case 4" in text]
    assert untouched
    assert not [m for m in mutants if m.line in untouched]
    assert not [m for m in mutants if m.line == 14 and "sizeof" in m.original]
    assert {m.original for m in mutants if m.line == 19} == {"v.x", "v.y", "v.z"}


def test_all_mutants_stand_in_one_source_that_compiles_and_runs(mutants, source, tmp_path):
    """Every mutant of the snippet at once; with none active it computes what it did."""
    number_of = {(m.line, m.mutated): n for n, m in enumerate(mutants, 1)}
    text = schemata.rewritten((source / "part.cpp").read_bytes(), list(enumerate(mutants, 1)))
    assert text.count(b"\n") == SOURCE.count("\n")  # messages of the compiler lead to the line
    program = text.decode() + """
#include <cstdio>
int main() {
  std::printf("%.17g %.17g\\n", combined(4.0, 3.0), norm({1.0, 2.0, 4.0}, 2));
}
"""
    (tmp_path / "all.cpp").write_text(program)
    subprocess.run(["c++", "-std=c++20", "-w", "-include", ROOT / "tools/mutate/active.hpp",
                    tmp_path / "all.cpp", "-o", tmp_path / "all"], check=True)

    def printed(number):
        run = subprocess.run([tmp_path / "all"], env={"POLHODE_MUTANT": str(number)}, text=True,
                             check=True, stdout=subprocess.PIPE)
        return run.stdout.split()

    assert printed(0) == ["0.5", "8"]
    assert printed(number_of[14, "sqrt(a) + T(half) * b"])[0] == "3.5"
    assert printed(number_of[14, "b"])[0] == "-1"
    assert printed(number_of[14, "0.25"])[0] == "1.25"
    assert printed(number_of[24, "std::max(a[0], a[1])"])[1] == "9"
    assert printed(number_of[19, "v.y"])[1] == "10"


def test_a_mutant_inside_another_stands_in_its_original_arm():
    def made(start, end, original, arm):
        return Mutant("f.cpp", "free", "term", start, end, original, arm, arm, 1, 1, "x")

    text = b"y = a + b * c;"
    outer, inner = made(4, 13, "a + b * c", "a"), made(8, 13, "b * c", "b / c")
    assert schemata.rewritten(text, [(1, outer), (2, inner)]) == (
        b"y = (polhode_mutants::active(1) ? (a) : "
        b"(a + (polhode_mutants::active(2) ? (b / c) : (b * c))));")
    with pytest.raises(ValueError, match="overlap"):
        schemata.rewritten(text, [(1, made(4, 9, "a + b", "a")), (2, inner)])


def test_drawing_is_reproducible_and_gives_every_layer_its_share():
    all_mutants = numbered([
        Mutant(f"src/{layer}/a.cpp", layer, "literal", i, i + 1, str(i), str(i + 1), str(i + 1), i,
               i, f"x = {i}")
        for layer, count in (("free", 600), ("rotor", 300), ("system", 8)) for i in range(count)])
    drawn = draw.drawn(all_mutants, "7", 90)
    assert drawn == draw.drawn(list(reversed(all_mutants)), "7", 90)
    assert drawn != draw.drawn(all_mutants, "8", 90)
    count = {layer: sum(m.layer == layer for m in drawn) for layer in ("free", "rotor", "system")}
    assert sum(count.values()) == 90
    assert count["free"] > count["rotor"] > count["system"] == 8
    # Another file more takes places, and leaves the order of the others as it was.
    more = [Mutant("src/free/b.cpp", "free", "literal", 0, 1, "0", "1", "1", 1, 1, "y = 0")]
    again = [m for m in draw.drawn(all_mutants + more, "7", 90) if m.file != "src/free/b.cpp"]
    assert again == [m for m in drawn if m in again]
    assert draw.drawn(all_mutants, "7", 5000) != [] and \
        len(draw.drawn(all_mutants, "7", 5000)) == len(all_mutants)


def test_a_name_survives_shifted_lines(mutants, source, clang_flags, tmp_path):
    (tmp_path / "part.cpp").write_text("// one line more\n" + SOURCE)
    moved = sites.candidates(tmp_path, "part.cpp", "free", clang_flags)
    assert [m.key for m in moved] == [m.key for m in mutants]
    assert len({m.key for m in mutants}) == len(mutants)


def test_quick_tests_run_first_and_in_the_order_of_the_layers():
    tests = {p: [reach.Test(p, n, s, (1,)) for n, s in (("A.slow", 2.0), ("A.quick", 0.1))]
             for p in ("unit_free", "property", "unit_system")}
    order = [(b[0].program, b[0].name) for b in campaign.batches("free", tests)]
    assert order == [("unit_free", "A.quick"), ("property", "A.quick"), ("unit_system", "A.quick"),
                     ("unit_free", "A.slow"), ("property", "A.slow"), ("unit_system", "A.slow")]


def test_results_of_the_same_sources_are_kept_and_a_torn_line_is_not(tmp_path):
    path = tmp_path / "results.jsonl"
    path.write_text('{"key": "a", "fingerprint": "1", "status": "caught"}\n'
                    '{"key": "b", "fingerprint": "0", "status": "caught"}\n{"key": "c", "fing')
    assert set(campaign.earlier(path, "1")) == {"a"}
    results.append(path, {"key": "d", "fingerprint": "1"})
    assert set(campaign.earlier(path, "1")) == {"a", "d"}


def test_equivalent_mutants_are_known_by_their_text_and_are_named_with_a_reason(tmp_path, mutants):
    m = next(m for m in mutants if m.mutated == "n <= 3")
    path = tmp_path / "equivalent.toml"
    path.write_text(f'[[mutant]]\nfile = "{m.file}"\nline = "{m.context}"\n'
                    f'original = "{m.original}"\nmutated = "{m.mutated}"\nreason = "because"\n')
    found = equivalent.entries(path)
    assert equivalent.reason(found, m) == "because"
    assert [x for x in mutants if equivalent.reason(found, x)] == [m]
    survived = {x.key: {"status": "survived"} for x in mutants}
    page = report.text(mutants, [], survived, found, "1")
    assert f"| all | {len(mutants)} | 0 | 0 | 1 | {len(mutants) - 1} | 0 | 0.0 % |" in page
    assert page.count("```diff") == len(mutants) and "because" in page
    marked = "\n".join(["text", report.MARKS[0], "old", report.MARKS[1], "more"])
    lines = report.summary(mutants, [], survived, found, "1")
    assert report.put_into(marked, lines).split("\n") == \
        ["text", report.MARKS[0], "", *lines, "", report.MARKS[1], "more"]
    path.write_text('[[mutant]]\nfile = "part.cpp"\n')
    with pytest.raises(ValueError, match="missing"):
        equivalent.entries(path)


def test_the_page_tells_of_every_operator():
    page = (ROOT / "docs/accuracy/tests.md").read_text()
    assert [name for name in operators.NAMES if f"\n| {name} | " in page] == list(operators.NAMES)
    assert all(page.count(mark) == 1 for mark in report.MARKS)


def test_named_equivalents_are_mutants_of_the_sources():
    """An entry whose line has changed means nothing any more."""
    for e in equivalent.entries(ROOT / "tools/mutate/equivalent.toml"):
        lines = [line.strip() for line in (ROOT / e["file"]).read_text().split("\n")]
        assert e["line"] in lines, f"{e['file']}: no line {e['line']}"
        assert len(e["reason"]) > 20
