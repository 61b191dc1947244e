# SPDX-License-Identifier: MIT
"""The proofs of the paper hold, their page is what they say, and a false equation fails."""

import subprocess
import sys

import mpmath
import pytest
from test_blocks import ROOT

PROOFS = ROOT / "docs/theory/proofs"
sys.path.insert(0, str(PROOFS))
import proof  # noqa: E402
import sympy as sp  # noqa: E402

import run  # noqa: E402

x, y = sp.symbols("x y")
ERRATA = (ROOT / "docs/theory/errata.md").read_text(encoding="utf-8")


def command(*options):
    return subprocess.run([sys.executable, PROOFS / "run.py", *options], text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)


def test_the_quick_proofs_hold():
    done = command("--quick", "--fresh")
    assert done.returncode == 0, done.stdout


def test_the_page_is_what_the_proofs_say():
    done = command("--check")
    assert done.returncode == 0, done.stdout


@pytest.fixture(scope="module")
def misprinted():
    return [row["label"] for row in run.rows_of(run.all_results())
            if row["result"] == "misprinted"]


def test_every_misprint_is_in_the_errata(misprinted):
    assert [label for label in misprinted if label not in ERRATA] == []


def test_every_erratum_is_proven(misprinted):
    table = ERRATA.split("## Misprints")[1].split("Slips of")[0]
    places = [line.split("|")[1] for line in table.splitlines() if line.startswith("|")][2:]
    assert places
    assert [place for place in places if not any(label in place for label in misprinted)] == []


@pytest.mark.parametrize("lhs, rhs", [
    (sp.sin(x) ** 2 - sp.cos(x) ** 2, 1 - 2 * sp.cos(x) ** 2),
    (sp.sin(x + 2 * y), sp.sin(x) * sp.cos(2 * y) + sp.cos(x) * sp.sin(2 * y)),
    (sp.tan(x) + sp.cot(x), 1 / (sp.sin(x) * sp.cos(x))),
    (sp.cos(sp.pi - x) + sp.sin(x - sp.pi / 2), -2 * sp.cos(x)),
    (1 / (sp.sqrt(x) + 1), (sp.sqrt(x) - 1) / (x - 1)),
    (sp.sqrt(x / y) ** 3, sp.sqrt(x / y) * x / y),
    (sp.Matrix([sp.sin(x) ** 2, y]), sp.Matrix([1 - sp.cos(x) ** 2, y])),
])
def test_a_true_equation_is_proven_and_is_no_misprint(lhs, rhs):
    proof.equal(lhs, rhs)
    with pytest.raises(proof.ProofError):
        proof.differs(lhs, rhs)
    with pytest.raises(proof.ProofError):
        proof.equal(lhs, rhs * (1 + sp.Rational(1, 10**9)))


@pytest.mark.parametrize("lhs, rhs", [
    (sp.sin(x) ** 2, sp.cos(x) ** 2),
    (sp.sin(x - y), sp.sin(y - x)),
    (sp.sqrt(1 - x**2), 1 - x),
    (sp.Derivative(sp.Function("f")(x), x), sp.Function("f")(x)),
])
def test_a_false_equation_is_refuted(lhs, rhs):
    proof.differs(lhs, rhs)
    with pytest.raises(proof.ProofError):
        proof.equal(lhs, rhs)


def test_an_angle_can_be_a_function_of_others():
    angles = {y: (sp.cos(x), sp.sin(x))}
    proof.equal(sp.sin(x + y), 1, angles)
    proof.differs(sp.sin(x - y), 1, angles)


def test_polynomials_have_the_values_of_the_expression():
    f = (sp.sin(2 * x - y) + sp.sqrt(y)) / (sp.cos(x) ** 2 + y**3) - sp.tan(y) / 7
    algebra = proof.Algebra([f])
    proof.RANGES, ranges = {}, proof.RANGES
    try:
        (value,) = algebra.sampled(1)
        with mpmath.workdps(proof.DIGITS):
            at = algebra.random_state(proof.random.Random(1))
    finally:
        proof.RANGES = ranges
    with mpmath.workdps(proof.DIGITS):
        angle = {v: mpmath.atan2(at[f"sin({v})"], at[f"cos({v})"]) for v in "xy"}
        # y is an angle and a number: they are different symbols of the algebra
        a, b, number = angle["x"], angle["y"], at["y"]
        direct = (mpmath.sin(2 * a - b) + mpmath.sqrt(number)) / (
            mpmath.cos(a) ** 2 + number**3) - mpmath.tan(b) / 7
        proof.close(value, direct)


def test_numbers_that_are_not_close_fail():
    with pytest.raises(proof.ProofError):
        proof.close(mpmath.mpf(1), mpmath.mpf("1.0000001"))
    with pytest.raises(proof.ProofError):
        proof.close(mpmath.nan, 0)


SCRIPT = '''
from proof import Section, differs, equal
from sympy import cos, sin, symbols

section = Section("0", "Test")
x = symbols("x")


@section.equation("(1)", "true")
def eq_1():
    equal(sin(x) ** 2, 1 - cos(x) ** 2)


@section.{kind}("(2)", "false"{right})
def eq_2():
    {claim}
'''


@pytest.mark.parametrize("kind, right, claim, error", [
    ("equation", "", "equal(sin(x), cos(x))", "not zero"),
    ("equation", "", "pass", "nothing was proven"),
    ("equation", "", "differs(sin(x), cos(x))", "nothing was proven"),
    ("misprint", ", right='x'", "equal(x, x)", "not shown to be false"),
    ("misprint", ", right='x'", "differs(sin(-x), -sin(x))", "misprinted holds"),
])
def test_a_script_with_a_false_equation_fails(kind, right, claim, error, tmp_path, monkeypatch,
                                              capsys):
    (tmp_path / "false_script.py").write_text(
        SCRIPT.format(kind=kind, right=right, claim=claim), encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.setattr(run, "SCRIPTS", ["false_script"])
    monkeypatch.setattr(run, "HERE", tmp_path)
    monkeypatch.setattr(run, "KEPT", tmp_path / "kept")
    monkeypatch.delitem(sys.modules, "false_script", raising=False)
    assert run.main([]) == 1
    printed = capsys.readouterr().out
    assert error in printed and "(1)" in printed and "1 failed" in printed


def test_results_are_kept_until_the_script_changes(tmp_path, monkeypatch):
    script = tmp_path / "kept_script.py"
    text = SCRIPT.format(kind="equation", right="", claim="equal(x, x)")
    script.write_text(text, encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.setattr(run, "HERE", tmp_path)
    monkeypatch.setattr(run, "KEPT", tmp_path / "kept")
    first = run.results("kept_script")
    assert [row["result"] for row in first["equations"]] == ["proven", "proven"]
    monkeypatch.setattr(run, "checked", lambda *_: pytest.fail("proven again"))
    assert run.results("kept_script") == first
    script.write_text(text + "\n# another\n", encoding="utf-8")
    assert run.kept_results("kept_script")["equations"] is None
