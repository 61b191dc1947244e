# SPDX-License-Identifier: MIT
"""Series whose coefficients are functions of the momenta, against NumPy and differences; and Lie
transforms of the paper's precessing frame and of a gravity gradient in sin I and cos J, against
polhode's own integration, with eps and eps/2."""

import pickle

import budgets
import numpy as np
import polhode
import pytest
from closeness import assert_allclose, largest
from polhode.series import CompiledSeries, LieTransform, Series, SeriesTerm, Symbols, Truncation

VALUES = {"L": 0.8, "G": 1.0, "H": 0.5}
PAIRS = [("l", "L"), ("g", "G"), ("h", "H")]
NAMES = Symbols(["L", "G", "H", "eps"], ["l", "g", "h", "s"], PAIRS, VALUES)
AT = {"l": 0.3, "g": 0.7, "h": 1.1, "s": 0.2, "eps": 0.4}
# Text, and the same in NumPy.
FUNCTIONS = [
    ("sqrt(G^2 - L^2)*sin(l)", lambda L, G, H, l, **_: np.sqrt(G**2 - L**2) * np.sin(l)),
    ("1/(G + L) + eps^2*cos(g)/(2*G - H)^3", lambda L, G, H, g, eps, **_: (
        1 / (G + L) + eps**2 * np.cos(g) / (2 * G - H)**3)),
    ("sqrt(1 - H^2/G^2)*sqrt(1 - (L/G)^2)*cos(2*l - g)", lambda L, G, H, l, g, **_: (
        np.sqrt(1 - H**2 / G**2) * np.sqrt(1 - (L / G)**2) * np.cos(2 * l - g))),
    ("(L - 0.8)*G^-2 + sqrt(2)*H*sin(h)^2", lambda L, G, H, h, **_: (
        (L - 0.8) / G**2 + np.sqrt(2) * H * np.sin(h)**2)),
]
DIRECTION = {"L": 0.3, "G": 0.5, "H": -0.4}


def series(text):
    return Series(NAMES, text)


def displaced(size):
    return {name: VALUES[name] + size * DIRECTION[name] for name in VALUES}


@pytest.mark.parametrize("text, function", FUNCTIONS)
def test_values_are_those_of_numpy_to_the_seventh_order(text, function):
    f = series(text)
    assert f.known_degree == 6 and not f.exact
    assert_allclose(f(**VALUES, **AT), function(**VALUES, **AT), rtol=budgets.series_values)
    errors = [abs(f(**at, **AT) - function(**at, **AT)) for at in map(displaced, (0.2, 0.1))]
    assert_allclose(np.log2(errors[0] / errors[1]), 7, atol=budgets.series_function_slope)
    assert errors[1] < budgets.series_function_error
    assert_allclose(CompiledSeries(f).at([*displaced(0.1).values(), 0.4, 0.3, 0.7, 1.1, 0.2]),
                    f(**displaced(0.1), **AT), rtol=budgets.series_values)


@pytest.mark.parametrize("left", range(4))
@pytest.mark.parametrize("right", range(4))
def test_brackets_are_those_of_differences(left, right):
    def slope(f, name):
        at, step = {**VALUES, **AT}, 1e-5
        high, low = ({**at, name: at[name] + sign * step} for sign in (1, -1))
        return (f(**high) - f(**low)) / (2 * step)

    (text, f), (other, g) = FUNCTIONS[left], FUNCTIONS[right]
    expected = sum(slope(f, q) * slope(g, p) - slope(f, p) * slope(g, q) for q, p in PAIRS)
    bracket = series(text).bracket(series(other))
    assert_allclose(bracket(**VALUES, **AT), expected, atol=budgets.series_function_difference)
    assert bracket.known_degree >= 5


def test_the_algebra_is_that_of_functions():
    root, L, G = series("sqrt(G^2 - L^2)"), series("L"), series("G")
    at = {**displaced(0.02), **AT}
    for zero in (root * root - G**2 + L**2, root / root - 1, 1 / (G + L) - (G + L)**-1,
                 root**-2 * root - 1 / root, series("G/(G*L)") - 1 / L, root.derivative("H")):
        assert_allclose(zero(**at), 0, atol=budgets.series_values)
    for zero in (root.derivative("L") * root + L,
                 root.bracket(series("sin(l)")) - L / root * series("cos(l)")):
        assert_allclose(zero(**at), 0, atol=budgets.series_function_error)
    keep = Truncation({"eps": 1}, 1)
    assert series("eps*sqrt(G)").product(series("eps")).truncated(keep) == series("0")
    moved = root.displaced("G", series("eps"), Truncation({"eps": 1}, 3))
    assert_allclose(moved(**{**VALUES, "eps": 1e-3}), np.sqrt(1.001**2 - 0.8**2),
                    atol=budgets.series_function_error)
    # A divisor that is a sum of functions.
    rates = {"l": series("L"), "s": 0.3}
    f = series("sqrt(G)*cos(l - s)").integral(rates)
    back = f.derivative("l") * L + 0.3 * f.derivative("s")
    assert_allclose(back(**at), series("sqrt(G)*cos(l - s)")(**at), rtol=budgets.series_values)


def test_derivatives_lose_a_degree_each_but_polynomials_none():
    f, p = series("sqrt(G)"), series("L^3*cos(l) + G*H")
    for n in range(6):
        assert f.known_degree == 6 - n and p.known_degree == 6
        f, p = f.derivative("G"), p.derivative("L")
    assert not p
    with pytest.raises(ValueError, match="nothing is known of this derivative: a polynomial of "
                                         "degree 6 has no more than 6 derivatives of a root"):
        f.derivative("G")


def test_texts_and_tables_are_in_displacements_and_read_back():
    assert str(series("G^2*eps*cos(l)")) == (
        "eps*cos(l) + 2*(G - 1)*eps*cos(l) + (G - 1)^2*eps*cos(l)")
    assert series("G*sin(g)").latex() == r"\sin(g) + (G - 1) \sin(g)"
    assert series("G").csv() == (
        "coefficient,function,(L - 0.8)^,(G - 1)^,(H - 0.5)^,eps^,l,g,h,s,known\n"
        "1,cos,0,0,0,0,0,0,0,0,all\n1,cos,0,1,0,0,0,0,0,0,all\n")
    f = series("G*sin(g)")
    assert f.terms == list(f) == [SeriesTerm(1.0, {}, "sin", {"g": 1}),
                                  SeriesTerm(1.0, {"G": 1}, "sin", {"g": 1})] and len(f) == 2
    assert Series.of_terms(NAMES, f.terms) == f and f.to_doubles() == f
    for text, _ in FUNCTIONS:
        for f in (series(text), series(text).derivative("G")):
            assert pickle.loads(pickle.dumps(f)) == f == Series.of_csv(NAMES, f.csv())
            assert Series.of_csv(NAMES, f.csv()).known_degree == f.known_degree
            assert Series(NAMES, str(f)).terms == f.terms
    assert NAMES.values == VALUES and eval(repr(NAMES)) == NAMES == pickle.loads(
        pickle.dumps(NAMES))
    assert NAMES != Symbols(NAMES.variables, NAMES.angles, PAIRS)


# An axisymmetric body: G^2/(2A) + L^2 (1/(2C) - 1/(2A)), with a clock s that advances at a rate n.
A, C, CLOCK = 1.0, 1.3, 0.3
FREE = f"G^2/{2 * A} + L^2*({1 / (2 * C) - 1 / (2 * A)})"
START = {**VALUES, "l": 0.3, "g": 0.7, "h": 1.1}
SPAN = 12.0


def precessing_frame(eps):
    """-mu.g, mu in the plane of the frame."""
    h = series(FREE + " - eps*sqrt(G^2 - H^2)*sin(h - s)")
    term = polhode.MomentumTerm(
        lambda t: [-eps * np.cos(CLOCK * t), -eps * np.sin(CLOCK * t), 0.0], axes="inertial")
    return h, ["s"], term


def gravity_gradient(eps):
    """3 gm/(2 r^3) (C - A) u^2, u the cosine between the axis of the body and the mass."""
    cos_I, sin_I = series("H/G"), series("sqrt(1 - H^2/G^2)")
    cos_J, sin_J = series("L/G"), series("sqrt(1 - L^2/G^2)")
    u = (sin_J * series("sin(g)*cos(h - s)")
         + (sin_J * cos_I * series("cos(g)") + cos_J * sin_I) * series("sin(h - s)"))
    h = series(FREE) + series("eps") * u**2
    term = polhode.GravityGradient(
        lambda t: [np.cos(CLOCK * t), np.sin(CLOCK * t), 0.0], 2 * eps / (3 * (C - A)))
    return h, ["g", "s"], term


def integrated(term):
    body = polhode.Body(A, A, C)
    start = polhode.to_rotor(polhode.AndoyerState(**START))
    system = polhode.System(body, terms=[term])
    problem = polhode.Problem(system, start, 0.0, SPAN, polhode.Adaptive(1e-13))
    end = polhode.to_andoyer(polhode.integrate(problem).states)
    return {name: np.asarray(getattr(end, name)).ravel()[-1] for name in START}


def predicted(t, eps):
    """To the mean variables, on along their angles, and back."""
    first = {**START, "eps": eps, "s": 0.0}
    mean = {**first, **{name: first[name] + t.short_period_back(name)(**first) for name in START}}
    later = {**mean, "s": CLOCK * SPAN}
    for q, p in PAIRS:
        later[q] = mean[q] + SPAN * t.mean_hamiltonian.derivative(p)(**mean)
    return {name: later[name] + t.short_period(name)(**later) for name in START}


@pytest.mark.parametrize("theory", [precessing_frame, gravity_gradient])
@pytest.mark.parametrize("method", ["hori", "deprit"])
def test_theories_of_order_n_leave_a_remainder_of_order_n_plus_1(theory, method):
    for order in 1, 2:
        errors = []
        for eps in (0.008, 0.004):
            h, angles, term = theory(eps)
            t = LieTransform(h, Truncation({"eps": 1}, order), angles, clocks={"s": CLOCK},
                             method=method)
            found, exact = predicted(t, eps), integrated(term)
            errors.append(largest(
                abs(np.angle(np.exp(1j * (found[name] - exact[name])))) if name in "lgh"
                else abs(found[name] - exact[name]) for name in START))
        assert_allclose(np.log2(errors[0] / errors[1]), order + 1,
                        atol=budgets.series_function_theory_slope)


@pytest.mark.parametrize("theory, frame", [
    (precessing_frame, polhode.Frame.precessing([1, 0, 0], 0.1)), (gravity_gradient, None)])
def test_rates_of_elements_are_those_of_the_series(theory, frame):
    eps = 0.1
    h, _, term = theory(eps)
    body = polhode.Body(A, A, C)
    system = polhode.System(body, frame) if frame else polhode.System(body, terms=[term])
    found = polhode.rates.element_rates(system, 0.0, polhode.AndoyerState(**START), "canonical")
    at = {**START, "eps": eps, "s": 0.0}
    expected = [h.derivative(p)(**at) for p in "LGH"] + [-h.derivative(q)(**at) for q in "lgh"]
    assert_allclose(found, expected, rtol=budgets.series_values, atol=budgets.series_values)


def test_the_mean_gravity_gradient_is_the_mean_over_its_angles():
    h, angles, _ = gravity_gradient(0.1)
    keep = Truncation({"eps": 1}, 1)
    t = LieTransform(h, keep, angles, clocks={"s": CLOCK})
    assert pickle.loads(pickle.dumps(t)) == t and hash(t) == hash(pickle.loads(pickle.dumps(t)))
    size = h.transform_size(keep, clocks={"s": CLOCK})
    assert len(size.terms) == 2 and 1 < size.terms[1] < 100
    at = displaced(0.02)
    L, G, H = at.values()
    sin2_I, sin2_J = 1 - (H / G)**2, 1 - (L / G)**2
    expected = sin2_J / 4 * (1 + (H / G)**2) + (L / G)**2 * sin2_I / 2
    mean = t.mean_hamiltonian.part_of_order(keep, 1)
    assert_allclose(mean(eps=1.0, **at), expected, rtol=budgets.series_function_error)


WITHOUT = Symbols(["L", "G", "H", "eps"], ["l", "g", "h", "s"], PAIRS)


@pytest.mark.parametrize("wrong, message", [
    (lambda: Series(WITHOUT, "sqrt(G)"),
     "column 1: 'sqrt'; expected .*: a root needs symbols with values of the momenta in it"),
    (lambda: Series(WITHOUT, "1/(G + L)"),
     "expected a divisor of one term without an angle before it; quotients by sums need symbols"),
    (lambda: series("sqrt(cos(l))"),
     r"column 12: '\)'; expected a root of a function of L, G, H before it, without angles"),
    (lambda: series("sqrt(G + eps)"), "column 13: .*without angles and other variables"),
    (lambda: series("sqrt(L^2 - G^2)"),
     r"column 15: '\)'; expected a root of a function that is positive at L = 0.8, G = 1, H = 0.5"),
    (lambda: series("sqrt(G - 1)"), "a root of a function that is positive at"),
    (lambda: series("sqrt(G - G)"), "a root of a function that is positive at"),
    (lambda: series("sqrt G"), r"column 6: 'G'; expected '\('"),
    (lambda: series("sqrt(G"), r"column 7: the end; expected '\)'"),
    (lambda: series("1/(1 - G) + L"),
     r"column 11: '\+'; expected a divisor that is not 0 at L = 0.8, G = 1, H = 0.5 before it"),
    (lambda: series("(G - 1)^-2"), "a divisor that is not 0 at"),
    (lambda: series("1/cos(l)"), "a divisor without an angle before it: a function of L, G, H, "),
    (lambda: series("1/(G + eps)"), "a divisor without an angle before it"),
    (lambda: series("1/(G - 1 + 1e-100)"), "a divisor that is not 0 at"),
    (lambda: Series(Symbols(["x"], values={"x": 0}), "1/(x + 1e-100)"),
     r"column 15: the end; expected a function whose Taylor polynomial is finite at x = 0 before"),
    (lambda: Series(Symbols(["x", "y"], values={"x": 0.3, "y": 0.1 + 0.2}), "1/sqrt(y^2 - x^2)"),
     "expected a root of a function that is positive at x = 0.3, y = 0.30000000000000004 before"),
    (lambda: series("G^0.5"), "column 3: '0.5'; expected an integer"),
    (lambda: 1 / series("G - 1"), "a division by a function that is 0 where it is taken"),
    (lambda: series("G") / series("cos(l)"), "it must be one term without an angle"),
    (lambda: series("G") + Series(WITHOUT, "G"),
     "s at L = 0.8, G = 1, H = 0.5 and variables .* without values; both series need the same"),
    (lambda: series("G").substituted("G", 1.0), "G is a variable of the coefficients too"),
    (lambda: series("G").truncated(Truncation({"G": 1}, 1)),
     "Truncation: G has a value, and coefficients are functions of it: it has no order"),
    (lambda: series("sqrt(G)")(L=1.0), "no value of G"),
    (lambda: Series.of_terms(NAMES, [SeriesTerm(1, {"G": -1})]),
     r"the term with \(G - 1\)\^-1: powers of displacements are in \[0, 6\] together"),
    (lambda: Series.of_csv(NAMES, series("G").csv().replace("all", "9")), "'9' is no degree"),
    (lambda: Series.of_csv(NAMES, Series(WITHOUT, "G").csv()), "is not the header coefficient,"),
    (lambda: LieTransform(series("G + eps*cos(g)"), Truncation({"eps": 1}, 1), ["g"],
                          clocks={"s": series("G")}), "clock s depends on G, of a pair"),
    (lambda: LieTransform(series("G + eps*cos(g)"), Truncation({"eps": 1}, 1), ["g"],
                          clocks={"s": Series(WITHOUT, "1")}), "without values meet symbols with"),
    (lambda: LieTransform(series("G^2 - 2*G + eps*cos(g)"), Truncation({"eps": 1}, 1), ["g"]),
     "turns with g, whose rate is 0 at the values chosen: a resonance; keep it in the mean"),
    (lambda: LieTransform(series("G + eps*cos(g)"), Truncation({"eps": 1}, 1), ["g"]).in_mean(
        Series(WITHOUT, "G")), "two sets of symbols"),
    (lambda: LieTransform(series("G^2 + eps*cos(g)*sqrt(G)"), Truncation({"eps": 1}, 9), ["g"]),
     "nothing is known of this derivative"),
    (lambda: Symbols(["eps", "G"], values={"G": 1}),
     "values: G comes after variables without a value in variables eps, G; put those with a value"),
    (lambda: Symbols(["G"], values={"z": 1}), "values: 'z' is no variable; there are variables G"),
    (lambda: Symbols(["G"], values={"G": np.nan}), "values: G = nan; expected a finite number"),
    (lambda: Symbols(["x", "y"], [], [("x", "y")], {"x": 1}), "values: x is a coordinate; "),
    (lambda: Symbols(list("abcd"), values=dict.fromkeys("abcd", 1)),
     "values: 4 variables; expected at most 3"),
])
def test_what_is_wrong_is_named(wrong, message):
    with pytest.raises(ValueError, match=message):
        wrong()
