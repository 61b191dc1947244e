# SPDX-License-Identifier: MIT
"""Elliptic integrals and functions of arrays, over the whole range of double.

The parameter is m = k^2; the keyword m1 gives 1 - m to its own accuracy, for m next to 1. The
characteristic is n in 1 - n sin^2, as in DLMF and Mathematica. Arguments broadcast as in NumPy;
numbers give a float. NaN in, NaN out; outside the real domain the value is NaN. ValueError for a
pair with m + m1 != 1."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from polhode._core import Modulus, _elliptic  # type: ignore[attr-defined]
from polhode._signatures import publish

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

__all__ = [
    "JacobiFunctions",
    "Modulus",
    "agm",
    "amplitude",
    "carlson_rc",
    "carlson_rd",
    "carlson_rf",
    "carlson_rj",
    "cel",
    "complementary_nome",
    "complete_b",
    "complete_d",
    "complete_e",
    "complete_k",
    "complete_pi",
    "heuman_lambda0",
    "jacobi",
    "jacobi_zeta",
    "legendre_b",
    "legendre_d",
    "legendre_e",
    "legendre_f",
    "legendre_pi",
    "nome",
]


class JacobiFunctions(NamedTuple):
    """sn, cn and dn: floats, or arrays of one shape."""

    sn: Any
    cn: Any
    dn: Any


def legendre_f(phi: ArrayLike, m: ArrayLike, *, m1: ArrayLike | None = None) -> Any:
    """Incomplete integral of the first kind, F = int_0^phi dx / sqrt(1 - m sin^2 x).
    [DLMF 19.2.4]

    Any angle phi (rad), odd in phi. Any m <= 1; m > 1 where |sin phi| <= 1/sqrt(m), before pi/2.
    At m = 1: inf from pi/2 on."""
    return _elliptic.legendre_f(phi, m, m1)


def legendre_e(phi: ArrayLike, m: ArrayLike, *, m1: ArrayLike | None = None) -> Any:
    """Incomplete integral of the second kind, E = int_0^phi sqrt(1 - m sin^2 x) dx.
    [DLMF 19.2.5]

    Arguments as of legendre_f; finite at m = 1."""
    return _elliptic.legendre_e(phi, m, m1)


def legendre_d(phi: ArrayLike, m: ArrayLike, *, m1: ArrayLike | None = None) -> Any:
    """D = int_0^phi sin^2 x dx / sqrt(1 - m sin^2 x) = (F - E)/m, without its cancellation.
    [DLMF 19.2.6]

    Arguments as of legendre_f."""
    return _elliptic.legendre_d(phi, m, m1)


def legendre_b(phi: ArrayLike, m: ArrayLike, *, m1: ArrayLike | None = None) -> Any:
    """B = int_0^phi cos^2 x dx / sqrt(1 - m sin^2 x) = F - D, without its cancellation.

    Arguments as of legendre_f."""
    return _elliptic.legendre_b(phi, m, m1)


def legendre_pi(
    phi: ArrayLike, n: ArrayLike, m: ArrayLike, *, m1: ArrayLike | None = None
) -> Any:
    """Incomplete integral of the third kind,
    Pi = int_0^phi dx / ((1 - n sin^2 x) sqrt(1 - m sin^2 x)). [DLMF 19.2.7]

    phi and m as of legendre_f. Any n: for n > 1 there are poles where sin^2 phi = 1/n; the value
    is inf there and Cauchy's principal value behind. n = 1: inf from pi/2 on."""
    return _elliptic.legendre_pi(phi, n, m, m1)


def complete_k(m: ArrayLike, *, m1: ArrayLike | None = None) -> Any:
    """K = F(pi/2). [DLMF 19.2.8]

    Any m <= 1, inf at 1; m > 1: NaN, since K is complex."""
    return _elliptic.complete_k(m, m1)


def complete_e(m: ArrayLike, *, m1: ArrayLike | None = None) -> Any:
    """E(pi/2). [DLMF 19.2.8]

    Any m <= 1; m > 1: NaN."""
    return _elliptic.complete_e(m, m1)


def complete_d(m: ArrayLike, *, m1: ArrayLike | None = None) -> Any:
    """D(pi/2) = (K - E)/m. [DLMF 19.2.8]

    Any m <= 1, inf at 1; m > 1: NaN."""
    return _elliptic.complete_d(m, m1)


def complete_b(m: ArrayLike, *, m1: ArrayLike | None = None) -> Any:
    """B(pi/2) = K - D.

    Any m <= 1; m > 1: NaN."""
    return _elliptic.complete_b(m, m1)


def complete_pi(n: ArrayLike, m: ArrayLike, *, m1: ArrayLike | None = None) -> Any:
    """Pi(pi/2). [DLMF 19.2.8]

    n > 1: Cauchy's principal value; n = 1: inf. Any m <= 1, at 1 inf (-inf for n > 1); m > 1:
    NaN."""
    return _elliptic.complete_pi(n, m, m1)


def jacobi(u: ArrayLike, m: ArrayLike, *, m1: ArrayLike | None = None) -> JacobiFunctions:
    """sn, cn and dn of u. [DLMF 22.2]

    Any finite u, any m: below 0 by DLMF 22.17(i), above 1 by DLMF 22.17.2-4. Arrays are computed
    in the lanes of the processor for 0 <= m < 1 and |u| <= 1e6; their last digits may differ from
    those of numbers."""
    return JacobiFunctions(*_elliptic.jacobi(u, m, m1))


def amplitude(u: ArrayLike, m: ArrayLike, *, m1: ArrayLike | None = None) -> Any:
    """am u (rad), continuous: sin am = sn. [DLMF 22.16.1]

    Any finite u, any m; m > 1: it swings between -asin(1/k) and asin(1/k)."""
    return _elliptic.amplitude(u, m, m1)


def jacobi_zeta(phi: ArrayLike, m: ArrayLike, *, m1: ArrayLike | None = None) -> Any:
    """Z = E(phi) - (E/K) F(phi), of the amplitude phi (rad); of period pi, odd. [DLMF 22.16.32]

    Z(u) of an argument u is jacobi_zeta(amplitude(u, m), m). Any m <= 1, at 1 the limit; m > 1:
    NaN."""
    return _elliptic.jacobi_zeta(phi, m, m1)


def heuman_lambda0(psi: ArrayLike, m: ArrayLike, *, m1: ArrayLike | None = None) -> Any:
    """Heuman's lambda function, (2/pi) [E F(psi|m1) + K (E(psi|m1) - F(psi|m1))].
    [A&S 17.4.39]

    Any angle psi (rad), 0 <= m <= 1, otherwise NaN."""
    return _elliptic.heuman_lambda0(psi, m, m1)


def nome(m: ArrayLike, *, m1: ArrayLike | None = None) -> Any:
    """q = exp(-pi K'/K). [DLMF 22.2.1]

    m <= 1, negative for m < 0; m > 1: NaN."""
    return _elliptic.nome(m, m1)


def complementary_nome(m: ArrayLike, *, m1: ArrayLike | None = None) -> Any:
    """exp(-pi K/K'), the nome of 1 - m.

    m >= 0, negative for m > 1; m < 0: NaN."""
    return _elliptic.complementary_nome(m, m1)


def carlson_rf(x: ArrayLike, y: ArrayLike, z: ArrayLike) -> Any:
    """Carlson's symmetric integral of the first kind. [DLMF 19.16.1]

    x, y, z >= 0, inf where two are 0; NaN for a negative argument."""
    return _elliptic.carlson_rf(x, y, z)


def carlson_rc(x: ArrayLike, y: ArrayLike) -> Any:
    """RC(x, y) = RF(x, y, y). [DLMF 19.2.17]

    x >= 0; y < 0: Cauchy's principal value; y = 0: inf."""
    return _elliptic.carlson_rc(x, y)


def carlson_rd(x: ArrayLike, y: ArrayLike, z: ArrayLike) -> Any:
    """RD(x, y, z) = RJ(x, y, z, z), symmetric in x and y. [DLMF 19.16.5]

    x, y >= 0, not both 0 (inf); z > 0 (0: inf); NaN for a negative argument."""
    return _elliptic.carlson_rd(x, y, z)


def carlson_rj(x: ArrayLike, y: ArrayLike, z: ArrayLike, p: ArrayLike) -> Any:
    """Carlson's symmetric integral of the third kind. [DLMF 19.16.2]

    x, y, z >= 0, inf where two are 0; p < 0: Cauchy's principal value [DLMF 19.20.14]; p = 0:
    inf."""
    return _elliptic.carlson_rj(x, y, z, p)


def agm(a: ArrayLike, b: ArrayLike) -> Any:
    """The arithmetic-geometric mean of a, b >= 0. [DLMF 19.8.1]"""
    return _elliptic.agm(a, b)


def cel(kc: ArrayLike, p: ArrayLike, a: ArrayLike, b: ArrayLike) -> Any:
    """Bulirsch's complete integral, over [0, pi/2] of
    (a cos^2 + b sin^2)/((cos^2 + p sin^2) sqrt(cos^2 + kc^2 sin^2)). [DLMF 19.2.11]

    kc >= 0 and p > 0, otherwise NaN; kc = 0: inf with the sign of b, finite for b = 0."""
    return _elliptic.cel(kc, p, a, b)


publish(globals())
