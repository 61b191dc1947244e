# SPDX-License-Identifier: MIT
"""Lie transforms: against published series, against the pendulum's own integrals, and against
motion that was integrated directly; slopes of the error against the order."""

import pickle
from fractions import Fraction

import budgets
import mpmath
import numpy as np
import polhode
import pytest
from closeness import assert_allclose
from polhode.series import LieTransform, Series, Symbols, Truncation
from rejections import rejected

METHODS = ["deprit", "hori"]
PENDULUM = Symbols(["G", "k"], ["g", "t"], [("g", "G")])
TWO = Symbols(["L", "G", "k"], ["l", "g"], [("l", "L"), ("g", "G")])


def up_to(order):
    return Truncation({"k": 1}, order)


def pendulum(order, method="hori", text="G^2/2 + k*cos(g)", **options):
    return LieTransform(Series(PENDULUM, text), up_to(order), ["g"], method=method, **options)


# a_r = r^2 + q^2 / (2 r^2) + 5 q^4 / (32 r^6) + 9 q^6 / (64 r^10) in the limit of large r,
# Abramowitz and Stegun 20.3.15, with k = q / 4, G = r / 2, K = a / 8.
@pytest.mark.parametrize("method", METHODS)
def test_the_pendulum_is_that_of_mathieus_functions(method):
    mean = pendulum(7, method).mean_hamiltonian
    assert mean == Series(PENDULUM, "G^2/2 + 1/4*k^2*G^-2 + 5/64*k^4*G^-6 + 9/128*k^6*G^-10")
    assert {term.coefficient for term in mean} == {
        Fraction(1, 2), Fraction(1, 4), Fraction(5, 64), Fraction(9, 128)}


# The mean momentum is the action, the integral of the momentum over a turn; the mean Hamiltonian
# at the action is the energy.
@pytest.mark.parametrize("order", [2, 4, 6])
def test_the_mean_hamiltonian_is_the_energy_of_the_action(order):
    mean = pendulum(order).mean_hamiltonian
    errors = []
    for k in (0.04, 0.08):
        def momentum(g, k=k):
            return mpmath.sqrt(2 * (mpmath.mpf(1) / 2 - k * mpmath.cos(g)))

        action = mpmath.quad(momentum, [0, mpmath.pi, 2 * mpmath.pi]) / (2 * mpmath.pi)
        errors.append(abs(mean(G=float(action), k=k) - 0.5))
    assert_allclose(np.log2(errors[1] / errors[0]), order + 2, atol=budgets.lie_slope)


def integrated(rate, y, stop, steps=2000):
    """Runge and Kutta's fourth order."""
    h = stop / steps
    for i in range(steps):
        t = i * h
        a = rate(t, y)
        b = rate(t + h / 2, y + h / 2 * a)
        c = rate(t + h / 2, y + h / 2 * b)
        y = y + h / 6 * (a + 2 * b + 2 * c + rate(t + h, y + h * c))
    return y


def predicted(transform, q, p, at, clock, stop):
    """One degree of freedom: to the mean variables, on along the angle, and back."""
    symbols = dict(zip((q, p), at[:2]))
    rest = at[2]
    symbols.update(rest)
    mean = {name: symbols[name] + transform.short_period_back(name)(**symbols) for name in (q, p)}
    rate = transform.mean_hamiltonian.derivative(p)(**{**symbols, **mean})
    later = {**rest, q: mean[q] + rate * stop, p: mean[p]}
    if clock:
        later[clock] = rest[clock] + stop
    return np.array([later[name] + transform.short_period(name)(**later) for name in (q, p)])


# k cos g is the pendulum; k cos(g - t) + k cos(g + t) a forced one, with time as a clock.
@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("order", [1, 2, 3])
@pytest.mark.parametrize("forced", [False, True])
def test_the_motion_is_that_of_direct_integration(method, order, forced):
    text, clocks, angles = "G^2/2 + k*cos(g)", {}, ["g"]
    if forced:
        text, clocks, angles = "13/5*G + k*G^2*cos(g - t) + k*G*cos(g + t) + k*sin(g)", {"t": 1}, [
            "g", "t"]
    transform = LieTransform(Series(PENDULUM, text), up_to(order), angles, clocks=clocks,
                             method=method)
    errors = []
    for k in (0.005, 0.01):
        def rate(t, y, k=k):
            g, G = y
            if forced:
                return np.array([
                    2.6 + 2 * k * G * np.cos(g - t) + k * np.cos(g + t),
                    k * G**2 * np.sin(g - t) + k * G * np.sin(g + t) - k * np.cos(g)])
            return np.array([G, k * np.sin(g)])

        start = np.array([0.4, 1.3])
        found = predicted(transform, "g", "G", (*start, {"k": k, "t": 0.0}), "t" if forced else "",
                          10.0)
        errors.append(np.abs(found - integrated(rate, start, 10.0)).max())
    assert errors[1] < budgets.lie_first_order
    assert_allclose(np.log2(errors[1] / errors[0]), order + 1, atol=budgets.lie_map_slope)


@pytest.mark.parametrize("method", METHODS)
def test_a_resonance_is_kept_and_the_rest_is_averaged(method):
    h = Series(TWO, "2*L + G + k*L*cos(l - 2*g) + k*cos(2*l - 4*g) + k*G*cos(l) + k*L^2*sin(g)^2")
    t = LieTransform(h, up_to(1), ["l", "g"], [{"l": 1, "g": -2}], method=method)
    # The mean along the resonant flow, in which l - 2 g stands still, taken on a grid.
    x = np.linspace(0, 2 * np.pi, 64, endpoint=False)
    at = {"L": 0.7, "G": 1.1, "k": 0.3}
    for l in (0.2, 1.9):
        expected = h(l=l + 2 * x, g=x, **at).mean()
        assert_allclose(t.mean_hamiltonian(l=l, g=0.0, **at), expected)
    with pytest.raises(ValueError, match=r"turns with 2\*l - 4\*g, whose rate is 0: a resonance"):
        LieTransform(h, up_to(1), ["l", "g"], method=method)


@pytest.mark.parametrize("method", METHODS)
def test_maps_undo_each_other_exactly(method):
    h = Series(TWO, "3*L + 7/5*G + k*L*cos(l - g) + k*G*sin(2*g) + k^2*L*G*cos(l)")
    f = Series(TWO, "L*cos(g) + G^2 + k*sin(l - 2*g)")
    t = LieTransform(h, up_to(3), ["l", "g"], method=method)
    assert t.in_osculating(t.in_mean(f)) == f == t.in_mean(t.in_osculating(f)) != t.in_mean(f)
    assert t.in_mean(h) == t.mean_hamiltonian
    assert t.generator.part_of_order(up_to(1), 1).bracket(Series(TWO, "3*L + 7/5*G")) == (
        h - h.mean(["l", "g"])).part_of_order(up_to(1), 1)
    L = Series(TWO, "L")
    assert L + t.short_period("L") == t.in_mean(L)
    assert L + t.short_period_back("L") == t.in_osculating(L)


def test_it_is_exact_or_in_floats_as_its_hamiltonian_is():
    exact = pendulum(5)
    floats = LieTransform(exact.hamiltonian.to_doubles(), up_to(5), ["g"])
    assert exact.mean_hamiltonian.exact and not floats.mean_hamiltonian.exact
    assert floats.mean_hamiltonian == exact.mean_hamiltonian.to_doubles()
    assert not floats.in_mean(exact.hamiltonian).exact
    clock = pendulum(1, text="G + k*cos(g - t)", clocks={"t": 0.5})
    assert not clock.generator.exact
    assert pendulum(1, text="G + k*cos(g - t)", clocks={"t": Fraction(1, 2)}).generator.exact
    rejected(ValueError, "a transform that is exact", exact.in_mean, exact.hamiltonian.to_doubles())


def test_it_is_a_value():
    t = pendulum(3, "deprit", clocks={"t": 1}, least_divisor=1e-3)
    same = pickle.loads(pickle.dumps(t))
    assert same == t and same.mean_hamiltonian == t.mean_hamiltonian
    assert (t.angles, t.keep, t.method) == (("g",), up_to(3), polhode.series.LieMethod.deprit)
    assert t.least_divisor == 1e-3 and list(t.clocks) == ["t"]
    assert "least_divisor=0.001" in repr(t)
    assert t != pendulum(3)


def test_its_size_is_known_before():
    t = pendulum(6)
    size = t.hamiltonian.transform_size(t.keep)
    assert size.terms == (1, 1, 2, 2, 3, 3, 4) and size.counted == 6
    for n in range(7):
        assert size.terms[n] == (len(t.mean_hamiltonian.part_of_order(t.keep, n))
                                 + len(t.generator.part_of_order(t.keep, n)))
    assert list(size.bytes) == sorted(size.bytes) and size.bytes[6] < 1e5
    floats = t.hamiltonian.to_doubles().transform_size(t.keep)
    assert floats.terms == size.terms and floats.bytes[6] < size.bytes[6]
    assert pickle.loads(pickle.dumps(size)) == size
    # A clock divides: its rate is n.
    h = Series(PENDULUM, "G*k*cos(t)")
    assert h.transform_size(up_to(3)).terms == (0, 1, 0, 0)
    assert h.transform_size(up_to(3), clocks={"t": 2}).terms[1:] == (1, 0, 0)
    # what fits easily is not refused, what does not is refused at once
    names = ["a", "b", "c"]
    many = Symbols([*"ABC", "k"], names, list(zip(names, "ABC")))
    waves = "(1 + cos(a) + cos(b) + cos(c) + cos(a - b) + cos(b - c))"
    h = Series(many, "A + 11/10*B + 13/10*C + k*(A + B + C)^2*" + waves, exact=False)
    size = h.transform_size(up_to(30))
    assert size.counted < 30 and size.bytes[30] > 2**32 > size.bytes[10]
    with pytest.raises(ValueError, match=(
            r"LieTransform: order 30 may have .*e\+07 terms in a series and take .* GB, more than "
            r"the 4.29 GB allowed; order 18 takes 3.* GB: lower the order, or raise Trunc")):
        LieTransform(h, up_to(30), names)
    assert LieTransform(h, up_to(3), names).mean_hamiltonian


@pytest.mark.parametrize("wrong, message", [
    (lambda: pendulum(2, text="G^2/2 + cos(g)"), "order 0 depends on the angle g"),
    (lambda: pendulum(2, text="G^2/2 + k^-1*cos(g)"), "an order below 0"),
    (lambda: pendulum(31), r"the order 31 is out of \[0, 30\]"),
    (lambda: pendulum(2, method="lie"), "method: got 'lie'; expected one of deprit hori"),
    (lambda: pendulum(2).short_period("x"), "no variable 'x'"),
    (lambda: pendulum(2).in_mean(Series(TWO, "G")), "two sets of symbols"),
    (lambda: pendulum(1, text="G/1000 + k*cos(g)", least_divisor=0.01),
     "turns with g, whose rate has the coefficient 0.001, below the bound 0.01"),
    (lambda: pendulum(1, text="G + k*cos(g - t)", clocks={"x": 1}), "no angle 'x'"),
    (lambda: LieTransform(Series(PENDULUM, "G"), Truncation(), ["g"]), "no small parameters"),
    (lambda: LieTransform(Series(PENDULUM, "G"), Truncation({"G": 1}, 2), ["g"]),
     "small parameter G has a conjugate"),
    (lambda: LieTransform(Series(PENDULUM, "G"), up_to(2), ["h"]), "no angle 'h'"),
    (lambda: LieTransform(Series(PENDULUM, "G^2/2 + k*cos(g)"), Truncation({"k": 1}, 20, 5000),
                          ["g"]), "order 20 may have 11 terms .* GB allowed; order [1-9] takes"),
    (lambda: pendulum(2).hamiltonian.transform_size(Truncation()), "no small parameters"),
    (lambda: pendulum(2, clocks={"g": 1}), "the clock g has the momentum G"),
    (lambda: pendulum(2, clocks={"t": Series(PENDULUM, "G")}), "clock t depends on G, of a pair"),
    (lambda: pendulum(2, clocks={"t": Series(PENDULUM, "k")}), "clock t has a small parameter"),
    (lambda: pendulum(2, clocks={"t": Series(TWO, "1")}), "two sets of symbols"),
    (lambda: LieTransform(Series(TWO, "G"), up_to(2), ["l"], resonances=[{"g": 1}]),
     "the resonance has the angle g"),
    (lambda: LieTransform(Series(Symbols(["q", "p", "k"], [], [("q", "p")]), "p"), up_to(2), []),
     "depends on the momentum p of q, which is a variable"),
    (lambda: pendulum(1, text="G + k*cos(g - t)", clocks={"t": 1}),
     "turns with g - t, whose rate is 0: a resonance; keep it in the mean"),
])
def test_what_is_wrong_is_named(wrong, message):
    rejected(ValueError, message, wrong)
