# SPDX-License-Identifier: MIT
"""Poisson series: exact against their own algebra in powers of exp(i phi), done with fractions in
dictionaries; values against NumPy."""

import copy
import pickle
from collections import defaultdict
from fractions import Fraction

import astropy.units
import budgets
import numpy as np
import polhode
import pytest
from closeness import assert_allclose
from polhode.series import CompiledSeries, Series, SeriesTerm, Symbols, Truncation

SYMBOLS = Symbols(["L", "G", "k"], ["l", "g"], [("l", "L"), ("g", "G")])


def series(text, exact=True):
    return Series(SYMBOLS, text, exact)


def some(seed, exact=True):
    """A dozen terms with small exponents and multipliers of either sign."""
    rng = np.random.default_rng(seed)
    terms = []
    for _ in range(12):
        c = Fraction(int(rng.integers(-9, 10)), int(rng.integers(1, 7)))
        n, k = rng.integers(-2, 4, 3), rng.integers(-3, 4, 2)
        terms.append(SeriesTerm(
            c if exact else float(c), dict(zip(SYMBOLS.variables, n.tolist())),
            rng.choice(["cos", "sin"]), dict(zip(SYMBOLS.angles, k.tolist()))))
    return Series.of_terms(SYMBOLS, terms)


def exponentials(f):
    """{(powers, multiples): (real, imaginary)}: f as a sum of monomials times exp(i k.phi)."""
    out = defaultdict(lambda: np.array([Fraction(0), Fraction(0)]))
    for term in f:
        n = tuple(term.powers.get(name, 0) for name in SYMBOLS.variables)
        k = tuple(term.multiples.get(name, 0) for name in SYMBOLS.angles)
        half = term.coefficient / 2
        for sign in (1, -1):
            c = [half, Fraction(0)] if term.function == "cos" else [Fraction(0), -sign * half]
            out[n, tuple(sign * x for x in k)] += c
    return clean(out)


def clean(a):
    return {key: tuple(c) for key, c in a.items() if any(c)}


def times(a, b):
    out = defaultdict(lambda: np.array([Fraction(0), Fraction(0)]))
    for (n, k), (x, y) in a.items():
        for (m, j), (u, v) in b.items():
            key = tuple(np.add(n, m).tolist()), tuple(np.add(k, j).tolist())
            out[key] += [x * u - y * v, x * v + y * u]
    return clean(out)


def plus(a, b, factor=1):
    out = defaultdict(lambda: np.array([Fraction(0), Fraction(0)]), {k: np.array(c)
                                                                     for k, c in a.items()})
    for key, c in b.items():
        out[key] += [factor * x for x in c]
    return clean(out)


def by(a, name):
    out = defaultdict(lambda: np.array([Fraction(0), Fraction(0)]))
    for (n, k), (x, y) in a.items():
        if name in SYMBOLS.angles:
            j = k[SYMBOLS.angles.index(name)]
            out[n, k] += [-j * y, j * x]
        else:
            i = SYMBOLS.variables.index(name)
            out[tuple(m - (q == i) for q, m in enumerate(n)), k] += [n[i] * x, n[i] * y]
    return clean(out)


@pytest.mark.parametrize("seed", range(4))
def test_the_algebra_is_that_of_exponentials(seed):
    f, g = some(seed), some(seed + 100)
    a, b = exponentials(f), exponentials(g)
    assert len(a) > 10
    assert exponentials(f + g) == plus(a, b)
    assert exponentials(f - g) == plus(a, b, -1) == exponentials(-(g - f))
    assert exponentials(f * g) == times(a, b) == exponentials(f.product(g))
    assert exponentials(f**3) == times(a, times(a, a)) == exponentials(f.power(3))
    for name in ("L", "G", "l", "g"):
        assert exponentials(f.derivative(name)) == by(a, name)
    bracket = {}
    for q, p in SYMBOLS.pairs:
        bracket = plus(bracket, times(by(a, q), by(b, p)))
        bracket = plus(bracket, times(by(a, p), by(b, q)), -1)
    assert exponentials(f.bracket(g)) == bracket


def test_truncation_is_by_weighted_exponents():
    f, g = some(1) * series("k^2"), some(2) * series("k^2")
    keep = Truncation({"k": 1}, 5)
    low = {key: c for key, c in exponentials(f * g).items() if key[0][2] <= 5}
    assert 0 < len(low) < len(exponentials(f * g))
    assert exponentials(f.product(g, keep)) == low == exponentials((f * g).truncated(keep))
    parts = [(f * g).part_of_order(keep, n) for n in range(11)]
    assert sum(parts[1:], parts[0]) == f * g
    assert series("k + G").power(3, Truncation({"k": 1}, 1)) == series("G^3 + 3*G^2*k")
    size = f.product_size(g, keep)
    assert size.terms >= len(f.product(g, keep)) and 0 < size.pairs < len(f) * len(g)
    assert size.bytes < f.product_size(g).bytes


def test_numbers_are_constants_and_decide_what_is_exact():
    f = series("G + k*cos(l)")
    assert f + 1 == 1 + f == series("G + 1 + k*cos(l)")
    assert 1 - f == -(f - 1) == f * -1 + 1
    assert 3 * f / Fraction(3, 2) == f * np.int64(2) == np.int64(2) * f == series("2*G+2*k*cos(l)")
    assert (Fraction(1, 3) * f).exact and (f / 3).terms[0].coefficient == Fraction(1, 3)
    for float_one in (f * 0.5, np.float64(0.5) * f, f.to_doubles() / 2, f / 2.0,
                      (f + f.to_doubles()) / 4):
        assert not float_one.exact
        assert float_one == series("0.5*G + 0.5*k*cos(l)", exact=False)
    assert f != f.to_doubles()
    assert 2 / series("4*G") == series("1/2*G^-1") == series("2*G")**-1
    assert series("G*k") / series("k^2") == series("G*k^-1")
    assert series("0.1*G") == Fraction(1, 10) * series("G")
    assert not f - f and len(f) == 2


def test_values_are_those_of_numpy():
    rng = np.random.default_rng(3)
    points = rng.uniform(0.5, 2.0, (300, 5))
    L, G, k, l, g = points.T
    f = series("3/2*L^2*cos(2*l - g) - G^-1*k*sin(g) + 7*k^3")
    expected = 1.5 * L**2 * np.cos(2 * l - g) - k * np.sin(g) / G + 7 * k**3
    flat = CompiledSeries(f)
    for values in (flat.at(points), flat(L=L, G=G, k=k, l=l, g=g), f(L=L, G=G, k=k, l=l, g=g)):
        assert values.shape == (300,)
        assert_allclose(values, expected, rtol=budgets.series_values)
    assert flat.at(points.reshape(3, 100, 5)).shape == (3, 100)
    assert flat.at(points[7]) == flat.at(points)[7] and isinstance(flat.at(points[7]), float)
    wide = flat(L=L[:4, None], G=G[0], k=k[:3], l=0.0, g=l[:3])
    assert wide.shape == (4, 3) and wide[2, 1] == f(L=L[2], G=G[0], k=k[1], l=0.0, g=l[1])
    assert len(flat) == 3 and flat.symbols == SYMBOLS
    assert series("G^2")(G=3) == 9.0 and series("5")(G=[1, 2]).tolist() == [5.0, 5.0]
    assert np.isnan(flat(L=1, G=np.nan, k=1, l=0, g=0))


def test_calculus():
    f = some(5) - some(5).mean(["l", "g"])
    rates = {"l": Fraction(7, 3), "g": series("1/2*G")}
    one_angle = f.mean(["g"])
    assert len(one_angle) > 0
    s = one_angle.integral(rates)
    assert Fraction(7, 3) * s.derivative("l") == one_angle
    assert not f.integral({"l": 2.5, "g": 1}, least=0.1).exact
    a = series("L^3*G + L^-1*cos(l + 2*g)")
    assert a.substituted("L", series("2*k*G")) == series("8*k^3*G^4 + 1/2*k^-1*G^-1*cos(l+2*g)")
    assert series("L^2*G").substituted("L", 0.5) == series("0.25*G", exact=False)
    assert a.angles_replaced({"l": {"l": 1, "g": -2}}) == series("L^3*G + L^-1*cos(l)")
    keep = Truncation({"k": 1}, 3)
    moved = series("cos(l)").displaced("l", series("k"), keep)
    assert moved == series("cos(l) - k*sin(l) - 1/2*k^2*cos(l) + 1/6*k^3*sin(l)")
    assert series("L^2").displaced("L", 3) == series("L^2 + 6*L + 9")


def test_texts_are_read_back():
    for f in (some(7), some(8, exact=False) * 0.1, series("0")):
        assert Series(SYMBOLS, str(f), f.exact) == f
        assert Series.of_csv(SYMBOLS, f.csv(), f.exact) == f
        assert Series.of_terms(SYMBOLS, f.terms) == f or not f
        assert list(f) == f.terms
        for same in (pickle.loads(pickle.dumps(f)), copy.copy(f), copy.deepcopy(f)):
            assert same == f and hash(same) == hash(f) and same.exact == f.exact
    f = series("3/2*k^2*G^-1*cos(2*l - g)")
    assert str(f) == "3/2*G^-1*k^2*cos(2*l - g)"
    assert repr(f) == "<Series of 1, exact: 3/2*G^-1*k^2*cos(2*l - g)>"
    assert repr(some(7)**4).endswith(" ...>") and len(repr(some(7)**4)) < 200
    assert f.latex() == r"\frac{3}{2} G^{-1} k^{2} \cos(2 l - g)"
    assert f._repr_latex_() == f"${f.latex()}$"
    assert f.csv() == "coefficient,function,L^,G^,k^,l,g\n3/2,cos,0,-1,2,2,-1\n"
    assert f.terms == [SeriesTerm(Fraction(3, 2), {"G": -1, "k": 2}, "cos", {"l": 2, "g": -1})]


def test_values_of_the_layer_are_values():
    same = Symbols(("L", "G", "k"), ("l", "g"), (("l", "L"), ("g", "G")))
    assert same == SYMBOLS and hash(same) == hash(SYMBOLS) and same != Symbols(["L"])
    assert pickle.loads(pickle.dumps(SYMBOLS)) == SYMBOLS == eval(repr(SYMBOLS))
    keep = Truncation({"k": 2}, 4)
    assert pickle.loads(pickle.dumps(keep)) == keep == eval(repr(keep))
    assert keep.weights == {"k": 2} and keep != Truncation({"k": 2}, 5)


OTHER = Series(Symbols(["x"]), "x")


@pytest.mark.parametrize("wrong, kind, message", [
    (lambda: series("G + z"), ValueError, "column 5: 'z'; expected .* variables L, G, k"),
    (lambda: series("G + l"), ValueError, "an angle stands in cos"),
    (lambda: series("1/(G + L)"), ValueError, "a divisor of one term"),
    (lambda: series("G").derivative("z"), ValueError, "no variable 'z'; there are"),
    (lambda: series("G").mean(["L"]), ValueError, "no angle 'L'"),
    (lambda: series("G") + OTHER, ValueError, "variables L, G, k; angles l, g and variables x"),
    (lambda: series("G").bracket(OTHER), ValueError, "two sets of symbols"),
    (lambda: series("G + L")**-1, ValueError, "a series of 2 terms; it must be one term"),
    (lambda: series("G") / 0, ValueError, "inverse"),
    (lambda: series("G^10000")**2, ValueError, "exponent 20000 of G is out of"),
    (lambda: series("cos(l) + cos(l - g)").integral({"l": 1, "g": 1}), ValueError,
     r"cos\(l - g\) turns with l - g, whose rate is 0: a resonance"),
    (lambda: series("sin(l)").integral({"l": 1e-4}, least=0.01), ValueError, "below the bound"),
    (lambda: series("cos(l)").integral({"l": series("L+G")}), ValueError, "a sum of 2 terms"),
    (lambda: series("G").integral({"l": 1}), ValueError, "has no angle"),
    (lambda: series("cos(l)").displaced("l", series("G")), ValueError, "needs a weight above 0"),
    (lambda: series("G").truncated(Truncation({"z": 1}, 1)), ValueError, "no variable 'z'"),
    (lambda: some(1).product(some(2), Truncation(most_bytes=1000)), ValueError,
     "pairs of terms may become .* GB, more than the .* GB allowed"),
    (lambda: series("G + k")(G=1), ValueError, "no value of k"),
    (lambda: series("G")(G=1, x=2), ValueError, "x is none of: variables L, G, k; angles l, g"),
    (lambda: CompiledSeries(series("G")).at([1.0, 2.0]), ValueError, r"expected \(\.\.\., 5\)"),
    (lambda: series("G")(G=3 * astropy.units.m), TypeError, "a Quantity in m"),
    (lambda: series("G")(G=[1, 2], L=[1, 2, 3]), ValueError,
     r"L of shape \(3,\) and G of shape \(2,\) do not broadcast"),
    # the two that disagree, whatever stands between them
    (lambda: series("L*G*k*cos(l)")(L=[1, 2, 3], G=1, k=[[1], [2]], l=[1, 2]), ValueError,
     r"L of shape \(3,\) and l of shape \(2,\) do not broadcast"),
    (lambda: series("G**2"), ValueError, "a power is written with"),
    (lambda: series("cos(g/2)"), ValueError, "whole multiples of angles"),
    (lambda: series("G") * np.nan, ValueError, "the coefficient nan; expected a finite number"),
    (lambda: series("G") + np.inf, ValueError, "the coefficient inf; expected a finite number"),
    (lambda: Series.of_terms(SYMBOLS, [SeriesTerm(np.nan, {"G": 1})]), ValueError,
     "the coefficient nan; expected a finite number"),
    (lambda: Series.of_csv(SYMBOLS, "coefficient,function,L^,G^,k^,l,g\nnan,cos,0,1,0,0,0\n",
                           exact=False), ValueError, "line 2: 'nan' is no"),
    (lambda: Series.of_terms(SYMBOLS, [SeriesTerm(1, {"z": 1})]), ValueError, "no variable 'z'"),
    (lambda: Series.of_terms(SYMBOLS, [SeriesTerm(1, {}, "tan")]), ValueError, "'tan'; expected"),
    (lambda: Series.of_csv(SYMBOLS, "a,b\n1,2\n"), ValueError, "coefficient,function"),
    (lambda: Symbols(["cos"]), ValueError, "cos"),
    (lambda: Symbols(["x", "x"]), ValueError, "x"),
    (lambda: Symbols("abc"), TypeError, "Symbols: variables: got 'abc', a str; expected a seq"),
    (lambda: series("G")**0.5, TypeError, "unsupported operand"),
    (lambda: series("G") * True, TypeError, "got a bool"),
    (lambda: series("G") * "2", TypeError, "sequence by non-int"),
    (lambda: series("G") * 1j, TypeError, "unsupported operand"),
    (lambda: np.ones(2) * series("G"), TypeError, "unsupported operand"),
    (lambda: series("G") * (3 * astropy.units.m), TypeError, "a Quantity in m"),
    (lambda: (3 * astropy.units.m) * series("G"), TypeError, "a Quantity in m"),
    (lambda: Truncation({"k": 0.5}, 1), TypeError, "Truncation: got {'k': 0.5}"),
])
def test_what_is_wrong_is_named(wrong, kind, message):
    with pytest.raises(kind, match=message):
        wrong()


def test_coefficients_of_any_length():
    big = series("2/3*G")**400
    (term,) = big
    assert term.coefficient == Fraction(2, 3)**400 and term.powers == {"G": 400}
    assert big * Fraction(3, 2)**400 == series("G^400")
    assert polhode.series.Series.of_terms(SYMBOLS, [term]) == big
