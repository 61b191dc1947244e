# SPDX-License-Identifier: MIT
"""Section 4 of the paper: perturbations, osculation, and precessing frames."""

import mpmath
from proof import Section, close, differs, equal
from section2 import (
    I1,
    I2,
    I3,
    g_B,
    g_of_plane,
    half,
    hamiltonian,
    l,
    omega,
    phi,
    psi,
    rate_matrix,
    rates,
    theta,
)
from section2 import p as momenta
from section3_1 import L
from section3_2 import of_momenta, sqrt_L
from sympy import Function, Matrix, cos, cot, diff, sin, sqrt, symbols

section = Section("4", "Perturbations and precessing frames")

Phi, Theta, Psi = momenta
mu = Matrix(symbols("mu1:4"))  # of the frame, in body components
moments = (I1, I2, I3)
V = Function("V")(phi, theta, psi)


@section.misprint("(96), footnote", "Delaunay's Hamiltonian gets mu^2/(2L)", right="mu^2/(2 L^2)")
def eq_96_footnote():
    """Minus the energy of Kepler's motion is mu/(2a), and L = sqrt(mu a)."""
    gm, a = symbols("mu a", positive=True)
    differs(gm / (2 * a), gm**2 / (2 * sqrt(gm * a)))
    equal(gm / (2 * a), gm**2 / (2 * sqrt(gm * a) ** 2))


def orbit_state(elements, gm, t):
    """Position and velocity from (sqrt(mu a), norm of h, its third component; -M_o, -omega,
    -Omega)."""
    action, h, h_z, M, w, node = *elements[:3], *(-x for x in elements[3:])
    a, e = action**2 / gm, mpmath.sqrt(1 - (h / action) ** 2)
    M += mpmath.sqrt(gm / a**3) * t
    E = mpmath.findroot(lambda x: x - e * mpmath.sin(x) - M, M)
    b, rate = a * mpmath.sqrt(1 - e**2), mpmath.sqrt(gm / a**3) / (1 - e * mpmath.cos(E))
    plane = [a * (mpmath.cos(E) - e), b * mpmath.sin(E)]
    speed = [-a * mpmath.sin(E) * rate, b * mpmath.cos(E) * rate]
    ci, (sw, cw), (sn, cn) = h_z / h, (mpmath.sin(w), mpmath.cos(w)), (
        mpmath.sin(node), mpmath.cos(node))
    si = mpmath.sqrt(1 - ci**2)
    axes = [(cn * cw - sn * sw * ci, -cn * sw - sn * cw * ci),
            (sn * cw + cn * sw * ci, -sn * sw + cn * cw * ci), (sw * si, cw * si)]
    return [u * x + v * y for x, y in (plane, speed) for u, v in axes]


@section.equation("(96)", "{sqrt(mu a), sqrt(mu a (1 - e^2)), sqrt(mu a (1 - e^2)) cos i;"
                  " -M_o, -omega, -Omega} is canonical", slow=True)
def eq_96():
    """Evaluate the 15 Lagrange brackets of the six constants by differences, at one state of an
    orbit. mu is the gravitational parameter; the text calls it the reduced mass."""
    gm, t = mpmath.mpf("1.3"), mpmath.mpf("0.7")
    at = [mpmath.mpf(x) for x in ("1.4", "1.2", "0.9", "-0.4", "-1.1", "0.6")]
    step = mpmath.mpf(10) ** -12
    columns = []
    with mpmath.workdps(80):
        for i in range(6):
            ends = [orbit_state([x + k * step * (i == j) for j, x in enumerate(at)], gm, t)
                    for k in (-3, -2, -1, 1, 2, 3)]
            weights = [mpmath.mpf(w) / 60 for w in (-1, 9, -45, 45, -9, 1)]
            columns.append([sum(w * end[j] for w, end in zip(weights, ends)) / step
                            for j in range(6)])
        for i in range(6):
            for j in range(i):
                found = sum(columns[i][k] * columns[j][k + 3] - columns[i][k + 3] * columns[j][k]
                            for k in range(3))
                close(found, -1 if i == j + 3 else 0)


section.definition("(97)", "qdot = H_p, pdot = -H_q", "The unperturbed equations.")
section.definition("(98)", "q = f(Q, P, t), p = chi(Q, P, t)", "The canonical map to constants.")
section.definition("(99)", "Qdot = H*_P = 0, Pdot = -H*_Q = 0, H* = 0", "They are constants.")
section.definition("(100)", "q = f(Q(t), P(t), t), p = chi(Q(t), P(t), t)",
                   "The same functions of constants that vary.")


def chain_rule():
    """Rates of q_n and p_n that constants with the Hamiltonian DeltaH* cause, as sums over
    Poisson brackets in (Q, P). For a canonical map the brackets are 0 and 1."""
    n = 3
    a, b = symbols("a1:4"), symbols("b1:4")  # DeltaH by q and by p

    def table(name):
        return Matrix(n, n, lambda i, j: symbols(f"{name}{i}{j}"))

    qQ, qP, pQ, pP = map(table, ("qQ", "qP", "pQ", "pP"))

    def poisson(uQ, uP, vQ, vP):
        return sum(uQ[j] * vP[j] - uP[j] * vQ[j] for j in range(n))

    def rate(uQ, uP):
        """u_Q Qdot + u_P Pdot with Qdot = DeltaH*_P and Pdot = -DeltaH*_Q."""
        by_P = [sum(a[m] * qP[m, j] + b[m] * pP[m, j] for m in range(n)) for j in range(n)]
        by_Q = [sum(a[m] * qQ[m, j] + b[m] * pQ[m, j] for m in range(n)) for j in range(n)]
        return sum(uQ[j] * by_P[j] - uP[j] * by_Q[j] for j in range(n))

    for i in range(n):
        brackets_q = [poisson(qQ[i, :], qP[i, :], qQ[m, :], qP[m, :]) for m in range(n)]
        brackets_p = [poisson(qQ[i, :], qP[i, :], pQ[m, :], pP[m, :]) for m in range(n)]
        equal(rate(qQ[i, :], qP[i, :]),
              sum(a[m] * brackets_q[m] + b[m] * brackets_p[m] for m in range(n)))
        brackets_p = [poisson(pQ[i, :], pP[i, :], qQ[m, :], qP[m, :]) for m in range(n)]
        brackets_pp = [poisson(pQ[i, :], pP[i, :], pQ[m, :], pP[m, :]) for m in range(n)]
        equal(rate(pQ[i, :], pP[i, :]),
              sum(a[m] * brackets_p[m] + b[m] * brackets_pp[m] for m in range(n)))


@section.equation("(101)", "qdot = (H + DeltaH)_p, pdot = -(H + DeltaH)_q")
def eq_101():
    """Use (102), (103) and the chain rule. The varying constants add sums of DeltaH_q and DeltaH_p
    times the brackets (q, q), (q, p) and (p, p), which are 0 and 1."""
    chain_rule()


@section.equation("(102)", "Qdot = (H* + DeltaH*)_P, Pdot = -(H* + DeltaH*)_Q")
def eq_102():
    """The proof is that of (101), read backwards."""
    chain_rule()


section.definition("(103)", "H* = 0, DeltaH*(Q, P, t) = DeltaH(q, p, t)",
                   "The perturbation as a function of the constants.")
section.definition("(104)", "qdot = g + Phi", "The chain rule: (105) and (106) name its parts.")
section.definition("(105)", "g = q_t at fixed C", "The unperturbed velocity.")
section.definition("(106)", "Phi = sum q_C Cdot", "The convective term.")


@section.equation("(107)", "Phi = sum q_Q Qdot + sum q_P Pdot = DeltaH_p")
def eq_107():
    """Insert (102) into (106) and sum over the brackets (q_n, q_m) = 0, (q_n, p_m) = 0 or 1."""
    chain_rule()


section.definition("(108)", "q_n = f_n(A(C, t))", "f is (78) to (80).")
section.definition("(109)", "qdot_n = g_n + Phi_n", "The chain rule.")
section.definition("(110)", "g_n = sum f_A (A_t at fixed C)", "The chain rule.")


@section.equation("(111)", "Phi_n = sum f_A A_C Cdot = sum f_C Cdot = DeltaH_p")
def eq_111():
    """Use the chain rule and then (107)."""
    f_A = Matrix(1, 6, symbols("f1:7"))
    A_C = Matrix(6, 6, lambda i, j: symbols(f"A{i}{j}"))
    C = Matrix(symbols("C1:7"))
    equal((f_A * A_C) * C, f_A * (A_C * C))
    chain_rule()


section.definition("(112)", "T = 1/2 sum I_i (omega_i + mu_i)^2", "mu_i are body components.")
T = half * sum(m * (w + x) ** 2 for m, w, x in zip(moments, omega, mu))
total = [m * (w + x) for m, w, x in zip(moments, omega, mu)]
side = total[0] * cos(psi) - total[1] * sin(psi)


@section.equation("(113)", "Phi = I1 (w1 + mu1) stheta spsi + I2 (w2 + mu2) stheta cpsi"
                  " + I3 (w3 + mu3) ctheta")
def eq_113():
    equal(diff(T, rates[0]), total[0] * sin(theta) * sin(psi) + total[1] * sin(theta) * cos(psi)
          + total[2] * cos(theta))


@section.misprint("(114)", "Theta = I3 (w3 + mu3)",
                  right="Theta = I1 (w1 + mu1) cpsi - I2 (w2 + mu2) spsi")
def eq_114():
    differs(diff(T, rates[1]), total[2])
    equal(diff(T, rates[1]), side)


@section.misprint("(115)", "Psi = I1 (w1 + mu1) cpsi - I2 (w2 + mu2) spsi",
                  right="Psi = I3 (w3 + mu3)")
def eq_115():
    differs(diff(T, rates[2]), side)
    equal(diff(T, rates[2]), total[2])


section.definition("(116)", "H = phid Phi + thetad Theta + psid Psi - T + V", "Legendre transform.")

# (118) as printed
perturbation = (
    -mu[0] * (sin(psi) / sin(theta) * (Phi - Psi * cos(theta)) + Theta * cos(psi))
    - mu[1] * (cos(psi) / sin(theta) * (Phi - Psi * cos(theta)) - Theta * sin(psi))
    - mu[2] * Psi
)


@section.equation("(117)", "H = T + DeltaH")
def eq_117():
    """T is (23) in the new momenta, and DeltaH is (118). The rates in (116) follow from
    omega + mu = I^-1 g, with g of (25) to (27)."""
    relative = Matrix([x / m for x, m in zip(g_B, moments)]) - mu
    new_rates = dict(zip(rates, rate_matrix.inv() * relative))
    legendre = (sum(P * v for P, v in zip(momenta, rates)) - T).subs(new_rates)
    equal(legendre, hamiltonian + perturbation)


@section.equation("(118)", "DeltaH = -mu1 [spsi/stheta (Phi - Psi ctheta) + Theta cpsi] - mu2"
                  " [cpsi/stheta (Phi - Psi ctheta) - Theta spsi] - mu3 Psi + V")
def eq_118():
    """It is -mu . g with (25) to (27), and V, which depends on the angles only."""
    equal(perturbation + V, -mu.dot(g_B) + V)
    eq_117()


@section.equation("(118), in Andoyer's variables", "-mu . g = -mu1 sqrt(G^2 - L^2) sl"
                  " - mu2 sqrt(G^2 - L^2) cl - mu3 L")
def eq_118_andoyer():
    """Insert (1490) to (1492). The equation stands after (118) and leaves V out."""
    equal(-mu.dot(g_of_plane), -mu[0] * sqrt_L * sin(l) - mu[1] * sqrt_L * cos(l) - mu[2] * L,
          of_momenta)


section.definition("(119)", "qdot_n = g_n + DeltaH_p", "(109) with (111).")
convective = Matrix([diff(perturbation + V, P) for P in momenta])


@section.equation("(120)", "DeltaH_Phi = -(mu1 spsi + mu2 cpsi)/stheta")
def eq_120():
    equal(convective[0], -(mu[0] * sin(psi) + mu[1] * cos(psi)) / sin(theta))


@section.equation("(121)", "DeltaH_Theta = -mu1 cpsi + mu2 spsi")
def eq_121():
    equal(convective[1], -mu[0] * cos(psi) + mu[1] * sin(psi))


@section.equation("(122)", "DeltaH_Psi = (mu1 spsi + mu2 cpsi) cot theta - mu3")
def eq_122():
    equal(convective[2], (mu[0] * sin(psi) + mu[1] * cos(psi)) * cot(theta) - mu[2])


section.definition("(128)", "cI = H/G, cJ = L/G", "As (84).")


@section.equation("(123)", "omega(qdot) = omega(g) + omega(DeltaH_p)")
def eq_123():
    """(5) to (7) are linear in the rates."""
    first, second = Matrix(symbols("x1:4")), Matrix(symbols("y1:4"))
    at = [omega.subs(dict(zip(rates, v))) for v in (first + second, first, second)]
    equal(at[0], at[1] + at[2])


@section.equation("(124)", "omega(qdot) = omega(g) - mu")
def eq_124():
    """(5) to (7) with the rates (120) to (122) give -mu."""
    equal(rate_matrix * convective, -mu)


@section.misprint("(4448)", "third line: omega(DeltaH_p) = mu", right="omega(DeltaH_p) = -mu")
def eq_4448():
    """With -mu the implication holds: omega(g) = omega_rel + mu = omega_inert, and omega(g) is
    I^-1 g."""
    differs(rate_matrix * convective, mu)
    equal(rate_matrix * convective, -mu)
    unperturbed = Matrix([diff(hamiltonian, P) for P in momenta])
    equal(rate_matrix * unperturbed, Matrix([x / m for x, m in zip(g_B, moments)]))


section.definition("(125)", "q_n = f_n(A(C, t))", "As (108).")
section.definition("(126)", "A_i = C_i + int n_i dt", "n_i are the rates of free rotation.")
section.definition("(127)", "g_n = sum q_A (A_t at fixed C)", "As (110).")
