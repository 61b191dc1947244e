# SPDX-License-Identifier: MIT
"""Section 3.1 of the paper: Serret's generating function and canonical constants.

An integral of cosJ along l is never evaluated. Its derivative by a constant of the motion is the
integral of a derivative, and the integrands agree: that is what is proven. All integrals start
where u does, at l = pi/2."""

from proof import Section, differs, equal, euler_differentials
from section2 import (
    I1,
    I2,
    I3,
    G,
    J,
    five,
    g,
    h,
    half,
    hamiltonian,
    incl,
    l,
    of_five,
    phi,
    psi,
    theta,
)
from section2 import p as momenta
from sympy import cos, diff, sin, sqrt, symbols

section = Section("3.1", "Richelot, Serret, Radau, Tisserand")

T, L, H, t, t_o, u, n, C = symbols("T L H t t_o u n C")

# differentials of the five angles; they are independent of each other
dh, dI, dg, dJ, dl = symbols("dh dI dg dJ dl")
moving = {h: dh, incl: dI, g: dg, J: dJ, l: dl}
dphi, dtheta, dpsi = euler_differentials(five, moving)

# Free rotation in Andoyer's variables; `spread` lies between 1/I2 and 1/I1.
spread = sin(l) ** 2 / I1 + cos(l) ** 2 / I2
energy = half * spread * (G**2 - L**2) + L**2 / (2 * I3)
g_rate, l_rate = G * spread, L * (1 / I3 - spread)
# L at given l, G, T: a root, here for L > 0
L_of = sqrt((spread * G**2 - 2 * T) / (spread - 1 / I3))
through_L = {J: (sqrt(G**2 - L**2) / G, L / G)}


section.definition("(36)", "(q, p; H) -> (Q, P; H*)", "The canonical transformation.")
section.definition("(37)", "dzeta = p dq - H dt", "Not exact by itself; the sum (39) is.")
section.definition("(38)", "dzeta~ = Q dP + H* dt", "Not exact by itself; the sum (39) is.")
section.definition("(39)", "dS = p dq + Q dP - (H - H*) dt", "Exact, if the map is canonical.")
section.definition("(40)", "S_t dt + S_q dq + S_P dP = p dq + Q dP - (H - H*) dt",
                   "The total differential of S(q, P, t).")


section.definition("(41)", "p = S_q, Q = S_P, H + S_t = H*",
                   "The coefficients of dq, dP and dt in (40).")
section.definition("(42)", "H(q, S_q, t) + S_t = H*(S_P, P, t)", "Jacobi's equation: (41).")

# (33) to (35)
momenta_of_plane = {
    momenta[0]: G * (cos(theta) * cos(J) + sin(theta) * sin(J) * cos(psi - l)),
    momenta[1]: G * sin(J) * sin(l - psi),
    momenta[2]: G * cos(J),
}


@section.equation("(43)", "(23) with S_phi, S_theta, S_psi for the momenta, + S_t = H*")
def eq_43():
    """S of (51) solves it with H* = 0: its derivatives are (33) to (35), for which (23) is T, and
    S_t = -T."""
    equal(hamiltonian.subs(momenta_of_plane), energy.subs(L, G * cos(J)))


section.definition("(44)", "H + dS/dt - S_q qdot = 0",
                   "(42) with H* = 0: P is constant, so that dS/dt = S_t + S_q qdot.")


@section.equation("(45)", "S = A1 t + A2 phi + int S_theta dtheta + int S_psi dpsi + C")
def eq_45():
    """Neither t nor phi occurs in H. The two integrals are one line integral."""
    equal(diff(hamiltonian, phi))
    equal(diff(hamiltonian, t))


@section.equation("(46)", "A1 = -T")
def eq_46():
    """S_t = A1, and (43) with H* = 0 makes it -T."""
    A1 = symbols("A1")
    equal((hamiltonian.subs(momenta_of_plane) + A1).subs(A1, -energy.subs(L, G * cos(J))))


def one_form():
    """Phi dphi + Theta dtheta + Psi dpsi for (33) to (35)."""
    return sum(momenta_of_plane[p] * d for p, d in zip(momenta, (dphi, dtheta, dpsi)))


@section.equation("(47)", "S_phi = Phi, S_theta = Theta, S_psi = Psi")
def eq_47():
    """At fixed T, G, H the differential of (51) is Phi dphi + Theta dtheta + Psi dpsi."""
    equal(one_form(), G * (cos(incl) * dh + dg + cos(J) * dl), of_five)


@section.equation("(48)", "S = -t T + Phi phi + int Theta dtheta + int Psi dpsi + C")
def eq_48():
    """Insert (46) and (47) into (45). The two integrals are one line integral."""
    A1, A2 = symbols("A1 A2")
    equal((A1 * t + A2 * phi).subs({A1: -T, A2: momenta[0]}), -t * T + momenta[0] * phi)
    equal(one_form(), G * (cos(incl) * dh + dg + cos(J) * dl), of_five)


@section.equation("(49)", "S = -t T + G phi cI + G int cJ dl"
                  " + G int [-cJ d(l - psi) + sJ s(l - psi) dtheta] + C")
def eq_49():
    """The integrands agree: Theta dtheta + Psi dpsi = G [cJ dl - cJ d(l - psi) + sJ s(l - psi)
    dtheta]. Phi is G cI."""
    dth, dps = symbols("dtheta dpsi")
    equal(
        momenta_of_plane[momenta[1]] * dth + momenta_of_plane[momenta[2]] * dps,
        G * (cos(J) * dl - cos(J) * (dl - dps) + sin(J) * sin(l - psi) * dth),
    )
    equal(momenta_of_plane[momenta[0]], G * cos(incl), of_five)


@section.equation("(50)", "dg - cI d(phi - h) = -cJ d(l - psi) + sJ s(l - psi) dtheta")
def eq_50():
    """The differentials of all five angles are arbitrary."""
    equal(
        dg - cos(incl) * (dphi - dh),
        -cos(J) * (dl - dpsi) + sin(J) * sin(l - psi) * dtheta,
        of_five,
    )


@section.equation("(51)", "S = -t T + G h cI + G g + G int cJ dl + C")
def eq_51():
    """At fixed G and I, the differential of (49) is that of (51), by (50)."""
    of_50 = -cos(J) * (dl - dpsi) + sin(J) * sin(l - psi) * dtheta
    equal(
        G * cos(incl) * dphi + G * cos(J) * dl + G * of_50,
        G * (cos(incl) * dh + dg + cos(J) * dl),
        of_five,
    )


@section.equation("dimensionless", "u = n (t - t_o), n^2 = (G^2/I1 - 2T)(1/I2 - 1/I3)")
def eq_dimensionless():
    """n is that of (A35). It is the rate of the argument u, and not a mean angular velocity."""
    P2 = 2 * T / G**2
    equal((G**2 / I1 - 2 * T) * (1 / I2 - 1 / I3), G**2 * (1 / I1 - P2) * (1 / I2 - 1 / I3))


@section.misprint("identically nil", "u/n - t is an integral because it is identically nil",
                  right="because it is the constant -t_o, (62)")
def eq_identically_nil():
    """Insert u = n (t - t_o)."""
    difference = n * (t - t_o) / n - t
    differs(difference)
    equal(difference, -t_o)
    equal(diff(difference, t))


@section.equation("(52)", "dg + cJ dl = (2T/G) dt")
def eq_52():
    """Insert the rates of g and l in free rotation, with G cJ = L."""
    equal(g_rate + L / G * l_rate, 2 * energy / G)


@section.equation("(54)", "g - (2T/G) u/n + int cJ dl = g_o")
def eq_54():
    """The rate of the left-hand side is zero, by (52). At u = 0, where the integral starts, the
    left-hand side is g."""
    equal(g_rate - 2 * energy / G * diff((t - t_o), t) + L / G * l_rate)
    equal((-2 * T / G * n * (t - t_o) / n).subs(t, t_o))


@section.equation("(55)", "S = (2 u/n - t) T + G h cI + G g_o")
def eq_55():
    """Insert (54) into (51) with C = 0."""
    W, g_o = symbols("W g_o")  # W is the integral of cJ dl
    equal(
        -t * T + G * h * cos(incl) + G * g + G * W.subs(W, g_o - g + 2 * T / G * u / n),
        (2 * u / n - t) * T + G * h * cos(incl) + G * g_o,
    )


def derivative_by_G():
    """At fixed l and T, dL/dG dl = -gdot dt: the derivative of int L dl by G is minus the growth
    of g since u = 0, so that g plus it is g_o."""
    equal(diff(L_of, G) * l_rate.subs(L, L_of), -g_rate)


def derivative_by_T():
    """At fixed l and G, dL/dT dl = dt: the derivative of int L dl by T is t - t_o = u/n."""
    equal(diff(L_of, T) * l_rate.subs(L, L_of), 1)


def orientation_is_fixed():
    """(A53): with dphi = dtheta = dpsi = 0, (50) leaves dg + cI dh + cJ dl = 0."""
    free = dg - cos(incl) * (0 - dh) - (-cos(J) * (dl - 0))
    equal(G * free, G * dg + H * dh + L * dl, {**through_L, incl: (sqrt(1 - (H / G) ** 2), H / G)})


@section.equation("(56)", "dS/dG = Q1")
def eq_56():
    """Differentiate S = -t T + H h + G g + int L dl under the integral sign, at fixed Euler
    angles. By (A53) the changes of h, g and l cancel. At fixed l, dL/dG dl = -gdot dt."""
    orientation_is_fixed()
    derivative_by_G()


@section.equation("(57)", "dS/dH = Q2")
def eq_57():
    """The proof is that of (56). L at given l, G, T does not depend on H, so only h is left."""
    orientation_is_fixed()
    equal(diff(L_of, H))


@section.equation("(58)", "Q1 = g_o")
def eq_58():
    """g - int gdot dt since u = 0 is the left-hand side of (54)."""
    derivative_by_G()
    equal(g_rate, 2 * energy / G - L / G * l_rate)


@section.equation("(59)", "Q2 = h")
def eq_59():
    """h is constant in free rotation and is the only factor of H in S."""
    equal(diff(energy, H))


@section.misprint("(55)-(56)", "(55), (56) do not immediately follow from (54)",
                  right="(56), (57) do not immediately follow from (55)")
def eq_not_immediately():
    """(55) does follow from (54) and (51). A derivative of (55) as it stands, at fixed u/n, gives
    2 u/n - t in place of u/n - t."""
    eq_55()
    g_o = symbols("g_o")
    naive = (2 * u / n - t) * T + H * h + G * g_o
    differs(diff(naive, T), u / n - t)
    equal(diff(naive, T), 2 * u / n - t)


@section.equation("(60)", "dS = (u/n - t) dT + h dH + g_o dG")
def eq_60():
    """Differentiate under the integral sign: (A53), dL/dT dl = dt and dL/dG dl = -gdot dt."""
    orientation_is_fixed()
    derivative_by_T()
    derivative_by_G()


@section.equation("(61)", "dS/dT = Q3")
def eq_61():
    """Differentiate under the integral sign: dL/dT dl = dt."""
    orientation_is_fixed()
    derivative_by_T()


@section.equation("(62)", "Q3 = u/n - t = -t_o")
def eq_62():
    equal(n * (t - t_o) / n - t, -t_o)
