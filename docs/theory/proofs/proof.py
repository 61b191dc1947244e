# SPDX-License-Identifier: MIT
"""What the proofs of the paper share: equations with their labels, and a test of identities.

An expression in sines, cosines and square roots is a quotient of polynomials as soon as each
sine, cosine and root is a symbol of its own. The symbols obey one relation each, of the form
"square = polynomial": ``s^2 = 1 - c^2`` for an angle, ``r^2 = x`` for ``r = sqrt(x)``. Dividing
the numerator by these relations gives a remainder. If the remainder is zero, the expression is
zero wherever it is defined. Nothing else is simplified, so a proof takes milliseconds.

    section = Section("2", "Eulerian variables")

    @section.equation("(18)", "Psi = I3 (phid ctheta + psid)")
    def eq_18():
        equal(diff(T, psid), I3 * (phid * cos(theta) + psid))
"""

import random
import time
from functools import reduce

import mpmath
import sympy as sp

DIGITS = 50
# Largest gap of two sides that agree, least gap of a misprint, at 50 digits.
CLOSE = mpmath.mpf(10) ** -30
FAR = mpmath.mpf("0.01")
# Random states are drawn from these ranges: moments of a triaxial body, momenta with |L|, |H| < G.
RANGES = {"I1": (1, 1.2), "I2": (1.5, 1.8), "I3": (2.1, 2.4), "G": (2, 3), "lambda": (0.2, 0.8)}
ELSEWHERE = (0.3, 1.4)
TURN = (-3, 3)


class ProofError(AssertionError):
    """A claim that does not hold."""


# --- identities ---------------------------------------------------------------------------------


class Fraction:
    """A quotient of polynomials. The denominator is kept as {factor: power}."""

    def __init__(self, over, numerator, denominator=None):
        self.over, self.numerator, self.denominator = over, numerator, denominator or {}

    def missing(self, powers):
        """The product of the factors of `powers` that the denominator lacks."""
        lacking = (f ** (n - self.denominator.get(f, 0)) for f, n in powers.items()
                   if n > self.denominator.get(f, 0))
        return reduce(lambda a, b: a * b, lacking, self.over.ring.one)

    def __add__(self, other):
        powers = {f: max(self.denominator.get(f, 0), other.denominator.get(f, 0))
                  for f in {**self.denominator, **other.denominator}}
        total = (self.numerator * self.missing(powers) + other.numerator * other.missing(powers))
        return Fraction(self.over, self.over.remainder(total), powers)

    def __mul__(self, other):
        powers = dict(self.denominator)
        for factor, power in other.denominator.items():
            powers[factor] = powers.get(factor, 0) + power
        product = self.over.remainder(self.numerator * other.numerator)
        return Fraction(self.over, product, powers)

    def inverse(self):
        if not self.numerator:
            raise ProofError("division by an expression that is identically zero")
        below = self.over.remainder(self.over.one(self.denominator))
        return Fraction(self.over, below, self.over.factors(self.numerator))


class Algebra:
    """Polynomials in the symbols, sines, cosines and roots of some expressions.

    Parameters
    ----------
    expressions : iterable of Expr
        What is to be written as quotients of polynomials.
    angles : dict, optional
        ``{angle: (sine, cosine)}`` for angles that are functions of others. The sine and the
        cosine of any other angle are two symbols on a circle.
    """

    def __init__(self, expressions, angles=None):
        self.angles = angles or {}
        self.known = {}  # what was rewritten -> the expression in symbols only
        self.circles = {}  # angle -> its sine and cosine
        self.relations = []  # (symbol, its square), each in terms of earlier symbols
        self.plain = {}  # other symbols, in the order of their appearance
        self.expressions = [self.rewritten(sp.sympify(e)) for e in expressions]
        symbols = [*self.plain, *(s for pair in self.circles.values() for s in pair)]
        symbols += [s for s, _ in self.relations if s not in symbols]
        self.ring = sp.ring(symbols or [sp.Symbol("x")], sp.QQ)[0]
        self.values, self.squares = {}, []
        for symbol, generator in zip(symbols, self.ring.gens):
            self.values[symbol] = Fraction(self, generator)
        for symbol, square in self.relations:
            base, root = self.fraction(square), self.values[symbol].numerator
            below = self.one(base.denominator)
            self.squares.append((self.ring.gens.index(root), base.numerator * below))
            self.values[symbol] = Fraction(self, root, base.denominator)
        self.fractions = [self.fraction(e) for e in self.expressions]

    # from an expression to symbols

    def symbol(self, name):
        return self.plain.setdefault(sp.Symbol(name), sp.Symbol(name))

    def rewritten(self, e):
        if e not in self.known:
            self.known[e] = self.rewrite(e)
        return self.known[e]

    def rewrite(self, e):
        if e.is_Rational:
            return e
        if e.is_Symbol:
            return self.symbol(e.name)
        if isinstance(e, (sp.sin, sp.cos, sp.tan, sp.cot)):
            sine, cosine = self.sine_and_cosine(e.args[0])
            return {sp.sin: sine, sp.cos: cosine, sp.tan: sine / cosine,
                    sp.cot: cosine / sine}[e.func]
        if e.is_Pow and e.exp.is_Rational and e.exp.q == 2:
            return self.root(self.rewritten(e.base)) ** (2 * e.exp)
        if e.is_Add or e.is_Mul or (e.is_Pow and e.exp.is_Integer):
            return e.func(*map(self.rewritten, e.args))
        return self.symbol(f"[{e}]")  # derivatives, integrals and pi obey no relation here

    def sine_and_cosine(self, angle):
        """By the addition theorem, down to single angles."""
        sine, cosine = sp.S.Zero, sp.S.One
        for term in sp.Add.make_args(sp.expand(angle)):
            count, single = term.as_coeff_Mul()
            if single is sp.pi or single is sp.S.One:
                s, c = sp.sin(term), sp.cos(term)
            elif count.is_Integer:
                one, (s, c) = self.circle(single), (sp.S.Zero, sp.S.One)
                for _ in range(abs(count)):
                    s, c = s * one[1] + c * one[0], c * one[1] - s * one[0]
                s = s if count > 0 else -s
            else:
                raise ProofError(f"{angle} is no sum of whole angles")
            sine, cosine = sine * c + cosine * s, cosine * c - sine * s
        return sine, cosine

    def circle(self, angle):
        if angle in self.angles:
            return tuple(map(self.rewritten, self.angles[angle]))
        if angle not in self.circles:
            sine, cosine = sp.Symbol(f"sin({angle})"), sp.Symbol(f"cos({angle})")
            self.circles[angle] = (sine, cosine)
            self.relations.append((sine, 1 - cosine**2))
        return self.circles[angle]

    def root(self, base):
        root = sp.Symbol(f"sqrt({base})")
        if all(root != symbol for symbol, _ in self.relations):
            self.relations.append((root, base))
        return root

    # from symbols to polynomials

    def fraction(self, e):
        if e.is_Rational:
            return Fraction(self, self.ring(sp.QQ(e.p, e.q)))
        if e.is_Symbol:
            return self.values[e]
        parts = [self.fraction(part) for part in e.args if not e.is_Pow or part != e.exp]
        if e.is_Add:
            return reduce(lambda a, b: a + b, parts)
        if e.is_Mul:
            return reduce(lambda a, b: a * b, parts)
        base = self.fraction(e.base)
        base = base if e.exp > 0 else base.inverse()
        return reduce(lambda a, b: a * b, [base] * abs(e.exp))

    def one(self, powers):
        """The product of factors with their powers."""
        return reduce(lambda a, b: a * b, (f**n for f, n in powers.items()), self.ring.one)

    def factors(self, polynomial):
        """A denominator; the generators that divide it are factors of their own."""
        powers = {}
        shared = [min(powers) for powers in zip(*polynomial.monoms())]
        for generator, power in zip(self.ring.gens, shared):
            if power:
                powers[generator] = power
                polynomial = polynomial.quo(generator**power)
        if polynomial != 1:
            powers[polynomial] = 1
        return powers

    def remainder(self, polynomial):
        """The remainder of the division by all relations, the latest first."""
        for index, square in reversed(self.squares):
            by_power = {}
            for monomial, coefficient in polynomial.terms():
                half, rest = divmod(monomial[index], 2)
                reduced = monomial[:index] + (rest,) + monomial[index + 1 :]
                part = by_power.setdefault(half, {})
                part[reduced] = part.get(reduced, 0) + coefficient
            highest = max(by_power, default=0)
            if not highest:
                continue
            polynomial = self.ring.zero
            for half in range(highest, -1, -1):
                polynomial = polynomial * square + self.ring.from_dict(by_power.get(half, {}))
            return self.remainder(polynomial)
        return polynomial

    # numbers

    def sampled(self, seed):
        """Values of the fractions at a random state, with 50 digits."""
        state = random.Random(seed)
        with mpmath.workdps(DIGITS):
            for _ in range(1000):
                at = self.random_state(state)
                if at is not None:
                    break
            else:
                raise ProofError("no random state gives real roots")
            return [self.number(f.numerator, at) / self.number(self.one(f.denominator), at)
                    for f in self.fractions]

    def random_state(self, state):
        at = {}
        for symbol in self.plain:
            low, high = RANGES.get(symbol.name, ELSEWHERE)
            at[symbol.name] = mpmath.mpf(state.uniform(low, high))
        for sine, cosine in self.circles.values():
            angle = mpmath.mpf(state.uniform(*TURN))
            at[sine.name], at[cosine.name] = mpmath.sin(angle), mpmath.cos(angle)
        for (symbol, _), (_, square) in zip(self.relations, self.squares):
            if symbol.name not in at:
                value = self.number(square, at)
                if value <= 0:
                    return None
                at[symbol.name] = mpmath.sqrt(value)
        return at

    def number(self, polynomial, at):
        names = [symbol.name for symbol in self.ring.symbols]
        total = mpmath.mpf(0)
        for monomial, coefficient in polynomial.terms():
            term = mpmath.mpf(int(coefficient.numerator)) / int(coefficient.denominator)
            for name, power in zip(names, monomial):
                term *= at[name] ** power if power else 1
            total += term
        return total


# --- claims -------------------------------------------------------------------------------------

CLAIMS = []  # kinds of the claims of the equation being checked


def entries(lhs, rhs):
    """Differences of two sides: numbers, vectors or matrices."""
    if isinstance(lhs, sp.MatrixBase) or isinstance(rhs, sp.MatrixBase):
        return list(lhs - rhs)
    return [sp.sympify(lhs) - sp.sympify(rhs)]


def equal(lhs, rhs=0, angles=None):
    """Proves that two sides are identical: every remainder is zero.

    Parameters
    ----------
    lhs, rhs : Expr or Matrix
        The two sides.
    angles : dict, optional
        ``{angle: (sine, cosine)}`` for angles that are functions of others.

    Raises
    ------
    ProofError
        If a remainder is not zero.
    """
    for fraction in Algebra(entries(lhs, rhs), angles).fractions:
        if fraction.numerator:
            raise ProofError(f"remainder of {len(fraction.numerator)} terms is not zero")
    CLAIMS.append("equal")


def differs(lhs, rhs=0, angles=None):
    """Proves that two sides are not identical, and that they differ visibly.

    Parameters
    ----------
    lhs, rhs, angles
        See `equal`.

    Raises
    ------
    ProofError
        If every remainder is zero, or if at five random states the sides are within 0.01.
    """
    algebra = Algebra(entries(lhs, rhs), angles)
    if not any(fraction.numerator for fraction in algebra.fractions):
        raise ProofError("the form said to be misprinted holds")
    gap = max(abs(value) for seed in range(5) for value in algebra.sampled(seed))
    if not gap > FAR:
        raise ProofError(f"the misprint shows at no random state: {mpmath.nstr(gap, 3)}")
    CLAIMS.append("differs")


def close(lhs, rhs=0):
    """Shows that two numbers, computed with 50 digits, agree to 30.

    Parameters
    ----------
    lhs, rhs : mpf
        The two numbers.

    Raises
    ------
    ProofError
        If they do not agree, or if one is not a number.
    """
    gap = abs(mpmath.mpf(lhs) - rhs)
    if not gap < CLOSE * max(1, abs(mpmath.mpf(lhs))):
        raise ProofError(f"two sides differ by {mpmath.nstr(gap, 3)}")
    CLAIMS.append("close")


# --- equations ----------------------------------------------------------------------------------


class Equation:
    """One equation of the paper with its check."""

    def __init__(self, label, text, kind, right="", check=None, slow=False):
        self.label, self.text, self.kind, self.right = label, text, kind, right
        self.check, self.slow = check, slow
        how = (check.__doc__ or "") if check else ""
        self.how = " ".join(how.split())

    def run(self):
        """The status, an error message or None, and seconds."""
        if self.check is None:
            return "definition", None, 0.0
        CLAIMS.clear()
        start = time.perf_counter()
        try:
            with mpmath.workdps(DIGITS):
                self.check()
            status, error = self.status(), None
        except ProofError as problem:
            status, error = "failed", str(problem)
        return status, error, time.perf_counter() - start

    def status(self):
        kinds = set(CLAIMS)
        if not kinds & {"equal", "close"}:
            raise ProofError("nothing was proven")
        if self.kind == "misprint":
            if "differs" not in kinds:
                raise ProofError("the printed form was not shown to be false")
            return "misprinted"
        return "numeric" if "close" in kinds else "proven"


class Section:
    """The equations of one section of the paper, in its order.

    Parameters
    ----------
    name : str
        Number of the section.
    title : str
        Its title.
    """

    def __init__(self, name, title):
        self.name, self.title, self.equations = name, title, []

    def definition(self, label, text, how=""):
        """An equation that defines its left-hand side, or a line of prose."""
        self.equations.append(Equation(label, text, "definition"))
        self.equations[-1].how = how

    def equation(self, label, text, slow=False):
        """Decorator of a check that proves an equation; its docstring tells how."""
        return self.add(label, text, "equation", "", slow)

    def misprint(self, label, text, right, slow=False):
        """Decorator of a check that refutes the printed form and proves the right one."""
        return self.add(label, text, "misprint", right, slow)

    def add(self, label, text, kind, right, slow):
        def keep(check):
            self.equations.append(Equation(label, text, kind, right, check, slow))
            return check

        return keep


# --- mechanics ----------------------------------------------------------------------------------


def R1(a):
    """Passive rotation about the first axis."""
    return sp.Matrix([[1, 0, 0], [0, sp.cos(a), sp.sin(a)], [0, -sp.sin(a), sp.cos(a)]])


def R3(a):
    """Passive rotation about the third axis."""
    return sp.Matrix([[sp.cos(a), sp.sin(a), 0], [-sp.sin(a), sp.cos(a), 0], [0, 0, 1]])


def hat(w):
    """The matrix of the vector product with w, [SA (4)]."""
    return sp.Matrix([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]])


def along(f, rates):
    """The rate of change of f when its variables change at ``{variable: rate}``."""
    return sum((sp.diff(f, x) * rate for x, rate in rates.items()), 0 * f)


def bracket(f, h, pairs):
    """Poisson bracket: the sum of f_q h_p - f_p h_q over pairs (q, p)."""
    return sum(sp.diff(f, q) * sp.diff(h, p) - sp.diff(f, p) * sp.diff(h, q) for q, p in pairs)


def euler_angles(R, phi, theta, psi):
    """``{angle: (sine, cosine)}`` of the Euler angles of a rotation matrix, [SA (2)]."""
    sine = sp.sqrt(1 - R[2, 2] ** 2)
    return {theta: (sine, R[2, 2]), phi: (R[2, 0] / sine, -R[2, 1] / sine),
            psi: (R[0, 2] / sine, R[1, 2] / sine)}


def euler_differentials(R, moving):
    """The differentials of phi, theta, psi when the variables of R change."""
    dR, square = along(R, moving), 1 - R[2, 2] ** 2
    return ((R[2, 0] * dR[2, 1] - R[2, 1] * dR[2, 0]) / square, -dR[2, 2] / sp.sqrt(square),
            (R[1, 2] * dR[0, 2] - R[0, 2] * dR[1, 2]) / square)
