# SPDX-License-Identifier: MIT
"""Appendix A.4 and A.5 of the paper: rates of the node, and Andoyer's method."""

from proof import R1, R3, Section, along, differs, equal, hat
from section2 import (
    I1,
    I2,
    I3,
    G,
    J,
    five,
    g,
    g_of_plane,
    h,
    incl,
    inertia,
    l,
    omega,
    q,
    rate_matrix,
    rates,
    theta,
)
from section2 import T as T_of_rates
from section3_1 import L, dg, dh, dI, dJ, dl, energy, g_rate, of_five, one_form
from section3_2 import rotation_vector
from sympy import Function, Matrix, cos, diff, sin, symbols

section = Section("A.4-A.5", "Rates of the node, Andoyer's method")

# --- A.4

gd, Jd, ld = symbols("gd Jd ld")
node_rates = {g: gd, J: Jd, l: ld}
of_node = Matrix([
    gd * sin(J) * sin(l) + Jd * cos(l),
    gd * sin(J) * cos(l) - Jd * sin(l),
    ld + gd * cos(J),
])


def rate_of_three_rotations(i):
    three = R3(l) * R1(J) * R3(g)
    equal(-along(three, node_rates) * three.T, hat(of_node))
    equal(of_node[i], omega[i].subs(dict(zip((*q, *rates), (g, J, l, gd, Jd, ld)))))


@section.equation("(9995)", "omega1 = gdot sJ sl + Jdot cl")
def eq_9995():
    """It is (5) for the angles g, J, l from the invariable plane, which stands still."""
    rate_of_three_rotations(0)


@section.equation("(9996)", "omega2 = gdot sJ cl - Jdot sl")
def eq_9996():
    """It is (6) for the angles g, J, l from the invariable plane, which stands still."""
    rate_of_three_rotations(1)


@section.equation("(9997)", "omega3 = ldot + gdot cJ")
def eq_9997():
    """It is (7) for the angles g, J, l from the invariable plane, which stands still."""
    rate_of_three_rotations(2)


across = of_node[0] * sin(l) + of_node[1] * cos(l)


@section.equation("A.4, gdot", "gdot = (omega1 sl + omega2 cl)/sJ")
def eq_A4_g():
    """Insert (9995) and (9996)."""
    equal(across / sin(J), gd)


@section.misprint("A.4", "ldot cJ = omega3 cJ - cos^2 theta/sJ (omega1 sl + omega2 cl)",
                  right="cos^2 J/sJ")
def eq_A4():
    """Insert (9995) to (9997)."""
    differs(ld * cos(J), of_node[2] * cos(J) - cos(theta) ** 2 / sin(J) * across)
    equal(ld * cos(J), of_node[2] * cos(J) - cos(J) ** 2 / sin(J) * across)


@section.equation("A.4, sum", "gdot + ldot cJ = omega3 cJ + sJ (omega1 sl + omega2 cl)")
def eq_A4_sum():
    """With omega = I^-1 g and (32) this is 2 T/G, which is (52)."""
    total = of_node[2] * cos(J) + (1 - cos(J) ** 2) / sin(J) * across
    equal(gd + ld * cos(J), total)
    equal(total, of_node[2] * cos(J) + sin(J) * across)
    w = inertia.inv() * g_of_plane
    equal(w[2] * cos(J) + sin(J) * (w[0] * sin(l) + w[1] * cos(l)),
          2 * energy.subs(L, G * cos(J)) / G)


# --- A.5: three degrees of freedom; x, y, K are arbitrary functions of z1 to z6 and t

n = 3
t = symbols("t")
z = symbols("z1:7")
z_rates = symbols("zd1:7")
x = [Function(f"x{i}")(*z, t) for i in range(1, n + 1)]
y = [Function(f"y{i}")(*z, t) for i in range(1, n + 1)]
K = Function("K")(*z, t)


def lagrange_bracket(u, v):
    return sum(diff(a, u) * diff(b, v) - diff(b, u) * diff(a, v) for a, b in zip(x, y))


def J_(u):
    """(defJ)"""
    return diff(K, u) + sum(b * diff(a, u) for a, b in zip(x, y))


def whole_rate(f):
    return diff(f, t) + sum(diff(f, w) * v for w, v in zip(z, z_rates))


def H_by(u):
    """dH/du with H_x = -dy/dt and H_y = dx/dt, which is (eqHam)."""
    return sum(-whole_rate(b) * diff(a, u) + whole_rate(a) * diff(b, u) for a, b in zip(x, y))


section.definition("eqHam", "xdot = H_y, ydot = -H_x", "Hamilton's equations.")
section.definition("Lagrange brackets", "[u, v] = sum x_u y_v - y_u x_v", "Definition.")


@section.equation("linear", "H_zk + [z_k, t] + sum [z_k, z_l] zdot_l = 0")
def eq_linear():
    """x and y are arbitrary functions of z1 to z6 and t. The two equations of the footnote hold as
    well."""
    for u in z:
        equal(H_by(u) + lagrange_bracket(u, t)
              + sum(lagrange_bracket(u, w) * v for w, v in zip(z, z_rates)))
        equal(H_by(u) + sum(diff(a, u) * whole_rate(b) - diff(b, u) * whole_rate(a)
                            for a, b in zip(x, y)))


section.definition("defJ", "J_u = K_u + sum y x_u", "K is arbitrary.")


@section.equation("[u, v]", "[u, v] = dJ_u/dv - dJ_v/du")
def eq_brackets():
    """It holds for all 21 pairs of z1 to z6 and t."""
    variables = (*z, t)
    for i, u in enumerate(variables):
        for v in variables[:i]:
            equal(lagrange_bracket(u, v), diff(J_(u), v) - diff(J_(v), u))


@section.misprint("H'", "H' = H - t", right="H' = H - J_t, with J_t = K_t + sum y x_t")
def eq_H_prime():
    """Only with J_t is H'_zk + dJ_zk/dt + sum (dJ_zk/dz_l - dJ_zl/dz_k) zdot_l zero."""
    for u in z:
        rest = diff(J_(u), t) + sum((diff(J_(u), w) - diff(J_(w), u)) * v
                                    for w, v in zip(z, z_rates))
        differs(H_by(u) - diff(t, u) + rest)
        equal(H_by(u) - diff(J_(t), u) + rest)


section.definition("conditionJ", "J_qj = 0, J_pj = J_pj(q1, ..., qn; t)", "The hypothesis.")

# p_j, q_j with J_pj = star_j(q, t), and H' = E(p, star)
p_ = symbols("p1:4")
q_ = symbols("q1:4")
p_rates, q_rates = symbols("pd1:4"), symbols("qd1:4")
star = [Function(f"star{j}")(*q_, t) for j in range(1, n + 1)]
E_by_p, E_by_star = symbols("E_p1:4"), symbols("E_s1:4")


@section.equation("split system", "H'_pk + dJ_pk/dt + sum dJ_pk/dq_j qdot_j = 0,"
                  " H'_qk - sum dJ_pj/dq_k pdot_j = 0")
def eq_split():
    """Insert (conditionJ) into the system with H'."""
    J_of = {**dict(zip(p_, star)), **dict.fromkeys(q_, 0)}
    speed = {**dict(zip(p_, p_rates)), **dict(zip(q_, q_rates))}
    for k in range(n):
        for u, right in (
            (p_[k], diff(star[k], t) + along(star[k], dict(zip(q_, q_rates)))),
            (q_[k], -sum(diff(s, q_[k]) * v for s, v in zip(star, p_rates))),
        ):
            equal(diff(J_of[u], t) + sum((diff(J_of[u], w) - diff(J_of[w], u)) * speed[w]
                                         for w in (*p_, *q_)), right)


def by_q(k):
    """The derivative of E(p, star(q, t)) by q_k."""
    a, b, c = symbols("a b c")
    E = Function("E")(*star)
    inner = diff(Function("E")(a, b, c), a), diff(Function("E")(a, b, c), b), diff(
        Function("E")(a, b, c), c)
    at = dict(zip((a, b, c), star))
    names = {f.subs(at): s for f, s in zip(inner, E_by_star)}
    return diff(E, q_[k]).doit().subs(names)


@section.misprint("dH'/dq_k", "H'_qk = sum H'_q*k dq*_j/dq_k",
                  right="H'_qk = sum over j of H'_q*j dq*_j/dq_k")
def eq_chain_rule():
    """Use the chain rule. The printed sum takes the derivative of H' by q*_k in every term."""
    for k in range(n):
        slopes = [diff(s, q_[k]) for s in star]
        differs(by_q(k), sum(E_by_star[k] * s for s in slopes))
        equal(by_q(k), sum(e * s for e, s in zip(E_by_star, slopes)))


def new_rates(k):
    """dq*_k/dt by the first half of the split system."""
    return diff(star[k], t) + along(star[k], dict(zip(q_, q_rates)))


@section.equation("new canonical equations", "dp_j/dt = H'_q*j, dq*_j/dt = -H'_pj")
def eq_new_canonical():
    """The first half of the split system is dq*/dt = -H'_p; in the second half, with the chain
    rule, the sum over j of dq*_j/dq_k (H'_q*j - dp_j/dt) is zero for each k."""
    for k in range(n):
        half_ = E_by_p[k] + new_rates(k)
        equal(half_.subs(E_by_p[k], -new_rates(k)))
        slopes = [diff(s, q_[k]) for s in star]
        equal(by_q(k) - sum(s * v for s, v in zip(slopes, p_rates)),
              sum(s * (e - v) for s, e, v in zip(slopes, E_by_star, p_rates)))


@section.misprint("p and q*", "p_j are the conjugate momenta of q*_j",
                  right="q*_j = J_pj are the momenta, p_j the coordinates")
def eq_p_and_star():
    """Coordinates have the rate +H'_momentum. For the pair l, L = J_l the rates are ldot = +H_L
    and Ldot = -H_l: l, which is p here, is the coordinate."""
    body = inertia.inv() * g_of_plane
    l_rate = body[2] - g_rate * cos(J)  # (9997)
    L_rate = g_of_plane.cross(body)[2]  # third component of gdot = g x omega
    by_L, by_l = (diff(energy, v).subs(L, G * cos(J)) for v in (L, l))
    equal(l_rate, by_L)
    equal(L_rate, -by_l)
    differs(L_rate, by_l)
    differs(l_rate, -by_L)


variables = {l: dl, g: dg, h: dh, incl: dI, J: dJ}
virtual = Matrix(symbols("w1a w2a w3a"))  # omega of a virtual rotation
virtual_rates = Matrix(symbols("phia thetaa psia"))


@section.equation("J_alpha, first form", "J_alpha = Phi phi_alpha + Theta theta_alpha"
                  " + Psi psi_alpha = T_phid phid_alpha + ...")
def eq_J_alpha_first():
    """Insert the momenta as derivatives of T into (defJ) with K = 0. It is the polar form of T."""
    momenta_of_rates = Matrix([diff(T_of_rates, v) for v in rates])
    polar = (rate_matrix * Matrix(rates)).T * inertia * (rate_matrix * virtual_rates)
    equal(momenta_of_rates.dot(virtual_rates), polar[0])


@section.misprint("J_alpha", "J_alpha = I1 omega1 omega1a + I2 omega2 omega2a + I2 omega3 omega3a",
                  right="I3 omega3 omega3a")
def eq_J_alpha():
    """The polar form of T is G . omega_alpha. alpha is any of the six new variables."""
    w = symbols("omega1:4")
    first = I1 * w[0] * virtual[0] + I2 * w[1] * virtual[1]
    whole = (inertia * Matrix(w)).dot(virtual)
    differs(whole, first + I2 * w[2] * virtual[2])
    equal(whole, first + I3 * w[2] * virtual[2])
    eq_J_alpha_first()


@section.misprint("2T", "2 T = I1 omega1^2 + I2 omega2^2 + I2 omega3^2", right="I3 omega3^2")
def eq_2T():
    """Insert (24) into G . omega."""
    w = Matrix(symbols("omega1:4"))
    first = I1 * w[0] ** 2 + I2 * w[1] ** 2
    differs((inertia * w).dot(w), first + I2 * w[2] ** 2)
    equal((inertia * w).dot(w), first + I3 * w[2] ** 2)


def virtual_rotation(which):
    """omega_alpha in body components for one of the five angles."""
    return rotation_vector().subs({d: int(d == which) for d in (dh, dI, dg, dJ, dl)})


@section.misprint("J_l", "J_l = G . omega_J = G cJ", right="J_l = G . omega_l = G cJ")
def eq_J_l():
    """omega_J points to the node of the equator, so that G . omega_J = 0."""
    equal(-diff(five, l) * five.T, hat(virtual_rotation(dl)))
    differs(g_of_plane.dot(virtual_rotation(dJ)), G * cos(J))
    equal(g_of_plane.dot(virtual_rotation(dl)), G * cos(J))


@section.equation("J of the other variables", "J_G = J_I = J_J = 0, J_g = G, J_h = G cI")
def eq_J_others():
    """Evaluate G . omega_alpha for the angles, and (defJ) with K = 0 for all differentials at
    once. The Euler angles do not depend on G."""
    for which, angle, value in ((dI, incl, 0), (dJ, J, 0), (dg, g, G), (dh, h, G * cos(incl))):
        equal(-diff(five, angle) * five.T, hat(virtual_rotation(which)))
        equal(g_of_plane.dot(virtual_rotation(which)), value)
    equal(one_form(), G * (cos(J) * dl + dg + cos(incl) * dh), of_five)


@section.equation("L, G, H", "L = J_l = G cJ, G = J_g, H = J_h = G cI")
def eq_L_G_H():
    """These three are not zero. With l, g, h they obey (conditionJ)."""
    for which, value in ((dl, G * cos(J)), (dg, G), (dh, G * cos(incl))):
        equal(g_of_plane.dot(virtual_rotation(which)), value)
