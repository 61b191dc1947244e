# SPDX-License-Identifier: MIT
"""Appendix A.1 to A.3 of the paper: the spherical triangle, the elliptic solution of free
rotation, and the variation of S."""

import mpmath
from proof import Section, along, close, differs, equal
from section2 import (
    I1,
    I2,
    I3,
    G,
    J,
    g,
    g_of_plane,
    h,
    incl,
    inertia,
    l,
    of_five,
    phi,
    psi,
    theta,
)
from section3_1 import (
    H,
    L,
    L_of,
    T,
    dg,
    dh,
    dJ,
    dl,
    dphi,
    dpsi,
    dtheta,
    energy,
    l_rate,
    n,
    spread,
    t,
    u,
)
from sympy import Function, Integral, Matrix, cos, diag, diff, pi, sin, sqrt, symbols

section = Section("A.1-A.3", "Spherical triangle, elliptic solution, variations of S")

moments = (I1, I2, I3)
omega = Matrix(symbols("omega1:4"))
# Direction cosines of the momentum, alpha', beta', gamma', and as functions of J and l
cosines = alpha, beta, gamma = symbols("alpha beta gamma")
of_plane = dict(zip(cosines, g_of_plane / G))
P2 = symbols("P2")

# --- A.1

side = cos(phi - h) * cos(psi - l) + sin(phi - h) * sin(psi - l) * cos(pi - theta)


@section.equation("(A1)", "cg = c(phi - h) c(psi - l) + s(phi - h) s(psi - l) c(pi - theta)")
def eq_A1():
    equal(cos(g), side, of_five)


dx, dy, dth = symbols("dx dy dtheta")  # of phi - h, psi - l, theta
sx, cx, sy, cy = sin(phi - h), cos(phi - h), sin(psi - l), cos(psi - l)


@section.misprint("(A2)", "sg dg = [sx cy - sx sy ctheta] dx + [cx sy - sx cy ctheta] dy"
                  " + s(phi - l) sy stheta dtheta, with x = phi - h, y = psi - l",
                  right="[sx cy + cx sy ctheta] dx + [cx sy + sx cy ctheta] dy"
                  " - sx sy stheta dtheta")
def eq_A2():
    """Take minus the differential of (A1)."""
    minus = -along(side, {phi: dx, psi: dy, theta: dth})
    differs(minus, (sx * cy - sx * sy * cos(theta)) * dx + (cx * sy - sx * cy * cos(theta)) * dy
            + sin(phi - l) * sy * sin(theta) * dth)
    equal(minus, (sx * cy + cx * sy * cos(theta)) * dx + (cx * sy + sx * cy * cos(theta)) * dy
          - sx * sy * sin(theta) * dth)


@section.misprint("(A3)", "sg dg = sg cI d(phi - h) + sg cJ d(psi - l)"
                  " + s(phi - h) s(psi - l) stheta dtheta"
                  " = sg cI d(phi - h) + sg cJ d(psi - l) + s(psi - l) sJ sg dtheta",
                  right="minus in front of both terms in dtheta")
def eq_A3():
    """The differentials of the five angles are arbitrary, and the triangle is given by them. Only
    with minus does (50) follow."""
    first = sin(g) * (cos(incl) * (dphi - dh) + cos(J) * (dpsi - dl))
    term = sx * sy * sin(theta) * dtheta
    equal(term, sy * sin(J) * sin(g) * dtheta, of_five)
    differs(sin(g) * dg, first + term, of_five)
    equal(sin(g) * dg, first - term, of_five)
    equal(sin(g) * dg, first - sy * sin(J) * sin(g) * dtheta, of_five)


# --- A.2

section.definition("(A4)", "I = diag(I1, I2, I3)", "Principal axes of inertia.")
section.definition("(A5)", "omega = omega1 b1 + omega2 b2 + omega3 b3", "Components.")


@section.equation("(A6)", "2 T = omega I omega = sum I_i omega_i^2")
def eq_A6():
    equal((omega.T * diag(*moments) * omega)[0], sum(m * w**2 for m, w in zip(moments, omega)))


section.definition("(A7)", "g = I omega", "Body angular momentum.")


@section.equation("(A8)", "g^2 = sum I_i^2 omega_i^2")
def eq_A8():
    g_ = inertia * omega
    equal(g_.dot(g_), sum((m * w) ** 2 for m, w in zip(moments, omega)))


@section.equation("(A9)", "(alpha', beta', gamma') = g/G = (I1 omega1, I2 omega2, I3 omega3)/G")
def eq_A9():
    """Insert (A7). By (32) they are sJ sl, sJ cl, cJ, as the footnote says."""
    equal(inertia * omega / G, Matrix([m * w / G for m, w in zip(moments, omega)]))
    equal(g_of_plane / G, Matrix([sin(J) * sin(l), sin(J) * cos(l), cos(J)]))


section.definition("(A10)", "P^2 = alpha'^2/I1 + beta'^2/I2 + gamma'^2/I3", "Abbreviation.")
binet = sum(x**2 / m for x, m in zip(cosines, moments))
of_omega = {x: m * w / G for x, m, w in zip(cosines, moments, omega)}


@section.equation("(A11)", "G^2 P^2 = sum I_i omega_i^2")
def eq_A11():
    """Insert (A9) into (A10)."""
    equal(G**2 * binet.subs(of_omega), sum(m * w**2 for m, w in zip(moments, omega)))


@section.equation("(A12)", "G^2 P^2 = 2 T")
def eq_A12():
    """Insert Andoyer's variables."""
    equal(G**2 * binet.subs(of_plane), 2 * energy.subs(L, G * cos(J)))


@section.equation("(A13)", "alpha'^2 + beta'^2 + gamma'^2 = 1")
def eq_A13():
    equal(sum(of_plane[x] ** 2 for x in cosines), 1)


@section.equation("(A14)", "P^2 - 1/I3 = (1/I1 - 1/I3) alpha'^2 + (1/I2 - 1/I3) beta'^2")
def eq_A14():
    """Insert gamma'^2 of (A13) into (A10)."""
    equal(binet.subs(gamma, sqrt(1 - alpha**2 - beta**2)) - 1 / I3,
          (1 / I1 - 1 / I3) * alpha**2 + (1 / I2 - 1 / I3) * beta**2)


section.definition("(A15)", "a^2 = (P^2 - 1/I3)/(1/I1 - 1/I3)", "Abbreviation.")
section.definition("(A16)", "b^2 = (P^2 - 1/I3)/(1/I2 - 1/I3)", "Abbreviation.")
a2, b2 = (P2 - 1 / I3) / (1 / I1 - 1 / I3), (P2 - 1 / I3) / (1 / I2 - 1 / I3)


@section.equation("(A17)", "alpha'^2/a^2 + beta'^2/b^2 = 1")
def eq_A17():
    """Insert (A15) and (A16) into (A14)."""
    at = {P2: binet.subs(of_plane)}
    equal((of_plane[alpha] ** 2 / a2 + of_plane[beta] ** 2 / b2).subs(at), 1)


section.definition("(A18)", "alpha'^2/a^2 = cos^2 xi, beta'^2/b^2 = sin^2 xi",
                   "The angle of a point of the ellipse (A17).")
a, b, xi, kappa = symbols("a b xi kappa")


@section.equation("(A19)", "gamma'^2 = (1 - a^2)(1 - (b^2 - a^2)/(1 - a^2) sin^2 xi)")
def eq_A19():
    """Insert (A18) into (A13)."""
    equal(1 - a**2 * cos(xi) ** 2 - b**2 * sin(xi) ** 2,
          (1 - a**2) * (1 - (b**2 - a**2) / (1 - a**2) * sin(xi) ** 2))


section.definition("(A20)", "kappa^2 = (b^2 - a^2)/(1 - a^2)",
                   "The modulus. It is Sadov's lambda, and not his kappa.")
section.definition("(A21)", "Delta xi = sqrt(1 - kappa^2 sin^2 xi)", "Abbreviation.")
section.definition("(A22)", "alpha' = a cos xi", "A root of (A18).")
section.definition("(A23)", "beta' = b sin xi", "A root of (A18). For L < 0 it has the other sign.")
kappa2 = (b**2 - a**2) / (1 - a**2)
delta = sqrt(1 - kappa2 * sin(xi) ** 2)
root_a = sqrt(1 - a**2)
of_xi = {alpha: a * cos(xi), beta: b * sin(xi), gamma: root_a * delta}


@section.equation("(A24)", "gamma' = sqrt(1 - a^2) Delta xi")
def eq_A24():
    """It is a root of (A19); for L < 0 it has the other sign. The three squares add to 1."""
    equal(of_xi[gamma] ** 2, (1 - a**2) * (1 - kappa2 * sin(xi) ** 2))
    equal(sum(x**2 for x in of_xi.values()), 1)


# Rates of the direction cosines: (A28) to (A30)
cosine_rates = [
    G * beta * gamma * (1 / I3 - 1 / I2),
    G * gamma * alpha * (1 / I1 - 1 / I3),
    G * alpha * beta * (1 / I2 - 1 / I1),
]


@section.misprint("due to (A13)", "P^2 is a constant of motion due to (A13)",
                  right="due to (A12): G and T are constant")
def eq_P_is_constant():
    """(A13) holds for every motion of the three cosines, and along an arbitrary one of them, such
    as one at constant gamma', P^2 changes. Along free rotation, (A28) to (A30), it does not."""
    any_motion = {alpha: beta, beta: -alpha, gamma: 0}
    equal(along(alpha**2 + beta**2 + gamma**2, any_motion))
    differs(along(binet, any_motion))
    equal(along(binet, dict(zip(cosines, cosine_rates))))


euler = [omega[1] * omega[2] * (I2 - I3), omega[2] * omega[0] * (I3 - I1),
         omega[0] * omega[1] * (I1 - I2)]


def euler_equation(i):
    """The component of -omega x I omega."""
    equal(-omega.cross(inertia * omega)[i], euler[i])


@section.equation("(A25)", "I1 domega1/dt = omega2 omega3 (I2 - I3)")
def eq_A25():
    """It is the first component of (12)."""
    euler_equation(0)


@section.equation("(A26)", "I2 domega2/dt = omega3 omega1 (I3 - I1)")
def eq_A26():
    """It is the second component of (12)."""
    euler_equation(1)


@section.equation("(A27)", "I3 domega3/dt = omega1 omega2 (I1 - I2)")
def eq_A27():
    """It is the third component of (12)."""
    euler_equation(2)


def cosine_rate(i):
    equal(euler[i] / G, cosine_rates[i].subs(of_omega))


@section.equation("(A28)", "dalpha'/dt = G beta' gamma' (1/I3 - 1/I2)")
def eq_A28():
    """Insert (A9) into (A25)."""
    cosine_rate(0)


@section.equation("(A29)", "dbeta'/dt = G gamma' alpha' (1/I1 - 1/I3)")
def eq_A29():
    """Insert (A9) into (A26)."""
    cosine_rate(1)


@section.equation("(A30)", "dgamma'/dt = G alpha' beta' (1/I2 - 1/I1)")
def eq_A30():
    """Insert (A9) into (A27)."""
    cosine_rate(2)


@section.equation("(A33)", "dxi/Delta xi = (b/a) sqrt(1 - a^2) (1/I2 - 1/I3) G dt")
def eq_A33():
    """Insert (A22) to (A24) into (A28)."""
    xi_rate = b / a * root_a * (1 / I2 - 1 / I3) * G * delta
    equal(diff(of_xi[alpha], xi) * xi_rate, cosine_rates[0].subs(of_xi))


@section.equation("(A34)", "dxi/sqrt(1 - kappa^2 sin^2 xi)"
                  " = G dt sqrt((1/I1 - P^2)(1/I2 - 1/I3))")
def eq_A34():
    """The squares of both factors of G dt agree, by (A15) and (A16)."""
    equal(b2 / a2 * (1 - a2) * (1 / I2 - 1 / I3) ** 2, (1 / I1 - P2) * (1 / I2 - 1 / I3))


section.definition("(A35)", "n = G sqrt((1/I1 - P^2)(1/I2 - 1/I3))",
                   "The rate of the argument u, and not a mean motion: the momentum comes round"
                   " after 4 K/n.")


@section.equation("(A36)", "int dxi/sqrt(1 - kappa^2 sin^2 xi) from 0 = n (t - t_o)")
def eq_A36():
    """The integrands are those of (A34) and (A35); both sides are zero at t_o."""
    eq_A34()


section.definition("(A37)", "u = int n dt = n (t - t_o)", "Dimensionless time.")
section.definition("(A38)", "F(xi, kappa) = int dx/sqrt(1 - kappa^2 sin^2 x) from 0 to xi",
                   "The second argument is the modulus.")


@section.equation("(A39)", "u = F(xi, kappa)")
def eq_A39():
    """Insert (A37) and (A38) into (A36)."""
    eq_A34()


def at_amplitudes(check):
    """Calls check(xi, u, m) with u = F(xi, kappa) and m = kappa^2."""
    for x in map(mpmath.mpf, ("0.3", "1.1", "-2.4")):
        for m in map(mpmath.mpf, ("0.04", "0.5", "0.96")):
            check(x, mpmath.ellipf(x, m), m)


section.definition("(A40)", "xi = am(u, kappa)", "am is the inverse of F.")


@section.equation("(A41)", "sin xi = sn(u, kappa)")
def eq_A41():
    """This defines sn by am. The sn of theta functions agrees."""
    at_amplitudes(lambda x, w, m: close(mpmath.ellipfun("sn", w, m=m), mpmath.sin(x)))


@section.equation("(A42)", "cos xi = cn(u, kappa)")
def eq_A42():
    """This defines cn by am. The cn of theta functions agrees."""
    at_amplitudes(lambda x, w, m: close(mpmath.ellipfun("cn", w, m=m), mpmath.cos(x)))


@section.equation("(A43)", "Delta xi = sqrt(1 - kappa^2 sn^2 u) = dn(u, kappa)")
def eq_A43():
    """This defines dn by am. The dn of theta functions agrees."""
    at_amplitudes(lambda x, w, m: close(mpmath.ellipfun("dn", w, m=m),
                                        mpmath.sqrt(1 - m * mpmath.sin(x) ** 2)))


@section.equation("(A44)", "cI = ctheta cJ + stheta sJ c(psi - l)")
def eq_A44():
    equal(cos(incl), cos(theta) * cos(J) + sin(theta) * sin(J) * cos(psi - l), of_five)


@section.misprint("same as (A1)", "(A44) is the same as (A1), up to a cyclic transposition",
                  right="it is the law of cosines of angles: (A1) of the polar"
                  " triangle")
def eq_A44_and_A1():
    """The transpositions of (A1) give cosines of the sides phi - h and psi - l, and not cI. In the
    polar triangle pi minus an angle stands for the opposite side, pi minus a side for the opposite
    angle: this turns (A1) into (A44)."""
    for other, angle in ((phi - h, incl), (psi - l, J)):
        differs(cos(incl), cos(g) * cos(other) + sin(g) * sin(other) * cos(angle), of_five)
    x, y, opposite, included = symbols("x y opposite included")
    law = cos(opposite) - cos(x) * cos(y) - sin(x) * sin(y) * cos(included)
    equal(law.subs({x: phi - h, y: psi - l, opposite: g, included: pi - theta}), cos(g) - side)
    polar = law.subs({x: pi - J, y: theta, opposite: pi - incl, included: pi - (psi - l)})
    equal(-polar, cos(incl) - cos(theta) * cos(J) - sin(theta) * sin(J) * cos(psi - l))


@section.equation("(A45)", "sJ c(psi - l) = alpha' spsi + beta' cpsi"
                  " = a spsi cos am(u) + b cpsi sin am(u)")
def eq_A45():
    """Use the addition theorem, (A9), (A22) and (A23)."""
    middle = alpha * sin(psi) + beta * cos(psi)
    equal(sin(J) * cos(psi - l), middle.subs(of_plane))
    equal(middle.subs(of_xi), a * sin(psi) * cos(xi) + b * cos(psi) * sin(xi))


@section.misprint("(A46)", "cI = ctheta sqrt(1 - a^2) Delta am(u) + a stheta spsi cos am(u)"
                  " + b cpsi sin am(u)",
                  right="last term b stheta cpsi sin am(u)")
def eq_A46():
    """Insert (A45) and (A24) into (A44). Delta am(u) is dn(u)."""
    law = cos(theta) * gamma + sin(theta) * (alpha * sin(psi) + beta * cos(psi))
    equal(cos(incl), law.subs(of_plane), of_five)
    first = cos(theta) * root_a * delta + a * sin(theta) * sin(psi) * cos(xi)
    differs(law.subs(of_xi), first + b * cos(psi) * sin(xi))
    equal(law.subs(of_xi), first + b * sin(theta) * cos(psi) * sin(xi))


# --- A.3

vT, vG, vH, vg, vh, vl, v_cJ, x = symbols("vT vG vH vg vh vl v_cJ x")
# cJ as a function of l, T, G; its integral; the integral of its variation at fixed l
tilt = Function("cJ")
W = Integral(tilt(x, T, G), (x, pi / 2, l))
vW = diff(W, T) * vT + diff(W, G) * vG
section.definition("(A47)", "S = -t T + G h cI + G g + G int cJ dl + C", "(51).")
section.definition("(A48)", "S = S(t, T, l, L, g, G, h, H)", "The variables of S.")


# The variation of (A47) at fixed t, with H = G cI
whole = along(-t * T + h * H + G * g + G * W, {T: vT, h: vh, H: vH, G: vG, g: vg, l: vl})
without_l = -t * vT + H * vh + h * vH + (g + W) * vG + G * vg + G * vW


@section.misprint("(A51)", "delta S = -t delta T + G cI delta h + h delta(G cI)"
                  " + (g + int cJ dl) delta G + G delta g + G int delta(cJ) dl",
                  right="one more term: + G cJ delta l")
def eq_A51():
    """Use Leibniz's rule. The upper limit l adds cJ delta l, when the variation of cJ is taken at
    fixed l."""
    differs(whole, without_l)
    equal(whole, without_l + G * tilt(l, T, G) * vl)


@section.equation("(A52)", "dg - cI d(phi - h) = -cJ d(l - psi) + sJ s(l - psi) dtheta")
def eq_A52():
    """It is (50), and (A3) with its corrected sign, over sg."""
    equal(dg - cos(incl) * (dphi - dh), -cos(J) * (dl - dpsi) + sin(J) * sin(l - psi) * dtheta,
          of_five)


@section.equation("(A53)", "G delta g = -G cJ delta l - G cI delta h")
def eq_A53():
    """Set dphi = dtheta = dpsi = 0 in (A52)."""
    free = vg - cos(incl) * (0 - vh) + cos(J) * (vl - 0)
    equal(G * free, G * vg + G * cos(J) * vl + G * cos(incl) * vh)


fixed_orientation = {vg: -tilt(l, T, G) * vl - H / G * vh}


@section.misprint("(A54)", "delta S = -t delta T + h delta(G cI) + (g + int cJ dl) delta G"
                  " + G int delta(cJ) dl - G cJ delta l",
                  right="without - G cJ delta l")
def eq_A54():
    """Insert (A53) into the corrected (A51)."""
    right = -t * vT + h * vH + (g + W) * vG + G * vW
    differs(whole.subs(fixed_orientation), right - G * tilt(l, T, G) * vl)
    equal(whole.subs(fixed_orientation), right)


@section.equation("Binet", "alpha'^2/I1 + beta'^2/I2 + gamma'^2/I3 = 2 T/G^2")
def eq_Binet():
    """Combine (A10) and (A12). The direction cosines are those of (A9), and not of (A12)."""
    equal(binet.subs(of_plane), 2 * energy.subs(L, G * cos(J)) / G**2)


spread_3 = spread - 1 / I3
T_of_plane = energy.subs(L, G * cos(J))


@section.equation("(A55)", "(1 - gamma'^2)(sl^2/I1 + cl^2/I2 - 1/I3) = 2 T/G^2 - 1/I3")
def eq_A55():
    """So is the equation before it, sJ^2 (sl^2/I1 + cl^2/I2) + cJ^2/I3 = 2 T/G^2."""
    equal(sin(J) ** 2 * spread + cos(J) ** 2 / I3, 2 * T_of_plane / G**2)
    equal((1 - cos(J) ** 2) * spread_3, 2 * T_of_plane / G**2 - 1 / I3)


# T as a function of G, gamma', l, and its differential
T_of_gamma = G**2 / 2 * ((1 - gamma**2) * spread_3 + 1 / I3)
dG, d_gamma = symbols("dG dgamma")
dT = along(T_of_gamma, {G: dG, gamma: d_gamma, l: dl})


def product():
    """alpha' beta' = (1 - gamma'^2) sl cl."""
    equal(of_plane[alpha] * of_plane[beta], (1 - cos(J) ** 2) * sin(l) * cos(l))
    return (1 - gamma**2) * sin(l) * cos(l)


@section.equation("(A56)", "2 dT/G^2 - 4 T dG/G^3 = -2 gamma' dgamma' (sl^2/I1 + cl^2/I2 - 1/I3)"
                  " + 2 alpha' beta' (1/I1 - 1/I2) dl")
def eq_A56():
    """Differentiate (A55)."""
    equal(2 * dT / G**2 - 4 * T_of_gamma * dG / G**3,
          -2 * gamma * d_gamma * spread_3 + 2 * product() * (1 / I1 - 1 / I2) * dl)


square_bracket = cos(l) ** 2 * (1 / I2 - 1 / I1) + (1 / I1 - 1 / I3)


@section.equation("(A57)", "(delta T - 2 T delta G/G) dt = -G^2 dt gamma' delta gamma'"
                  " [cl^2 (1/I2 - 1/I1)"
                  " + (1/I1 - 1/I3)] + G^2 dt alpha' beta' (1/I1 - 1/I2) delta l")
def eq_A57():
    """Multiply (A56) by G^2 dt/2. The square bracket is sl^2/I1 + cl^2/I2 - 1/I3."""
    equal(spread_3, square_bracket)
    equal(dT - 2 * T_of_gamma * dG / G,
          -(G**2) * gamma * d_gamma * square_bracket
          + G**2 * product() * (1 / I1 - 1 / I2) * dl)


@section.equation("(A58)", "G dt alpha' beta' (1/I1 - 1/I2) = -dgamma'")
def eq_A58():
    """It is (A30)."""
    equal(G * alpha * beta * (1 / I1 - 1 / I2), -cosine_rates[2])


@section.equation("(A59)", "G^2 dt alpha' beta' (1/I1 - 1/I2) delta l = -G dgamma' delta l")
def eq_A59():
    """Multiply (A58) by G delta l."""
    equal(G**2 * alpha * beta * (1 / I1 - 1 / I2) * vl, -G * cosine_rates[2] * vl)


def rates_per_dt():
    """dbeta'/dt and dgamma'/dt."""
    return cosine_rates[1], cosine_rates[2]


@section.equation("(A60)", "the first term of (A57) = ... = -G delta gamma' [beta' gamma' dgamma'"
                  " + (1 - gamma'^2) dbeta']/[alpha' (1 - gamma'^2)]")
def eq_A60():
    """All four forms agree, by (A61) and with dbeta', dgamma' of (A29), (A30)."""
    d_beta, d_gamma_ = rates_per_dt()
    variation_, rest = symbols("vgamma"), 1 - gamma**2
    first = -(G**2) * gamma * variation_ * square_bracket
    forms = [
        -(G**2) * gamma * variation_ * (beta**2 / rest * (1 / I2 - 1 / I1) + (1 / I1 - 1 / I3)),
        -G * gamma * variation_ * (beta**2 / rest * d_gamma_ / (alpha * beta)
                                   + d_beta / (alpha * gamma)),
        -G * variation_ / alpha * (beta * gamma / rest * d_gamma_ + d_beta),
        -G * variation_ / (alpha * rest) * (beta * gamma * d_gamma_ + rest * d_beta),
    ]
    for form in forms:
        equal(first.subs(of_plane), form.subs(of_plane))


@section.equation("(A61)", "cl^2 = beta'^2/(alpha'^2 + beta'^2) = beta'^2/(1 - gamma'^2)")
def eq_A61():
    equal(cos(l) ** 2, (beta**2 / (alpha**2 + beta**2)).subs(of_plane))
    equal(cos(l) ** 2, (beta**2 / (1 - gamma**2)).subs(of_plane))


@section.equation("(A62)", "dbeta' = -gamma' beta' dgamma'/(1 - gamma'^2) - alpha' dl")
def eq_A62():
    """Differentiate sJ cl. In the middle forms sJ stands for sqrt(1 - gamma'^2)."""
    change = {J: dJ, l: dl}
    d_gamma_ = along(of_plane[gamma], change)
    d_beta = along(of_plane[beta], change)
    equal(d_beta, -cos(J) * d_gamma_ * cos(l) / sin(J) - sin(J) * sin(l) * dl)
    last = -gamma * beta * symbols("x") / (1 - gamma**2) - alpha * dl
    equal(d_beta, last.subs({**of_plane, symbols("x"): d_gamma_}))


@section.equation("(A63)", "the first term of (A57) is G delta(cJ) dl")
def eq_A63():
    """Insert (A62) into (A60)."""
    d_gamma_, variation_ = symbols("x vgamma")
    rest = 1 - gamma**2
    d_beta = -gamma * beta * d_gamma_ / rest - alpha * dl
    equal(-G * variation_ / (alpha * rest) * (beta * gamma * d_gamma_ + rest * d_beta),
          G * dl * variation_)


@section.equation("(A64)", "(delta T - 2 T delta G/G) dt = G delta(cJ) dl - G d(cJ) delta l")
def eq_A64():
    """The variations of cJ, l and G are arbitrary; dl and d(cJ) are those of free rotation."""
    varied = along(T_of_gamma, {G: vG, gamma: v_cJ, l: vl}).subs(gamma, cos(J))
    l_rate_ = G * cos(J) * (1 / I3 - spread)
    equal(varied - 2 * T_of_plane * vG / G,
          G * v_cJ * l_rate_ - G * cosine_rates[2].subs(of_plane) * vl)


@section.misprint("(A65)", "G int delta(cJ) dl = (delta T - 2 T delta G/G) u/n + G cJ delta l",
                  right="G int delta(cJ) dl = (delta T - 2 T delta G/G) u/n")
def eq_A65():
    """Differentiate under the integral sign at fixed l: G d(cJ)/dT dl = dt and G d(cJ)/dG dl =
    -(2 T/G) dt. The slips of (A51), (A54) and (A65) cancel."""
    cJ = L_of / G
    speed = l_rate.subs(L, L_of)
    integrand = G * (diff(cJ, T) * vT + diff(cJ, G) * vG) * speed
    right = vT - 2 * T * vG / G
    equal(integrand, right)
    differs(right * u / n + G * cos(J) * vl, right * u / n)


@section.equation("(A66)", "delta S = (u/n - t) delta T + h delta(G cI)"
                  " + (g + int cJ dl - 2 (T/G) u/n) delta G")
def eq_A66():
    """Insert (A53) and the corrected (A65) into the corrected (A51)."""
    by_T, by_G = u / n / G, -2 * T / G**2 * u / n  # (A65), by the coefficients of vT and vG
    equal(whole.subs(fixed_orientation).subs({diff(W, T): by_T, diff(W, G): by_G}),
          (u / n - t) * vT + h * vH + (g + W - 2 * T / G * u / n) * vG)
