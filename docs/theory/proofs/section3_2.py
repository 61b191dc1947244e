# SPDX-License-Identifier: MIT
"""Section 3.2 of the paper: Andoyer's variables."""

from proof import R1, R3, Section, along, differs, equal, hat
from section2 import (
    G_I,
    I1,
    I2,
    I3,
    G,
    J,
    R,
    b3,
    five,
    g,
    g_B,
    g_of_plane,
    h,
    half,
    hamiltonian,
    incl,
    l,
    node,
    of_five,
    psi,
    q,
    s3,
)
from section2 import p as momenta
from section3_1 import (
    H,
    L,
    dg,
    dh,
    dI,
    dJ,
    dl,
    energy,
    momenta_of_plane,
    moving,
    one_form,
)
from sympy import Matrix, cos, diff, sin, sqrt, symbols

section = Section("3.2", "Andoyer, Deprit and Elipe")

# J and I when the momenta are the variables
sqrt_L, sqrt_H = sqrt(G**2 - L**2), sqrt(G**2 - H**2)
of_momenta = {J: (sqrt_L / G, L / G), incl: (sqrt_H / G, H / G)}
direction = Matrix([sin(incl) * sin(h), -sin(incl) * cos(h), cos(incl)])  # of G, inertial
node_i = Matrix([cos(h), sin(h), 0])  # of the invariable plane, inertial
node_j = Matrix([cos(l), -sin(l), 0])  # of the body's equator, in body components


@section.equation("Rnew", "R = R(l, b3) R(J, j) R(g, G/G) R(I, i) R(h, s3)")
def eq_Rnew():
    """Read the factors as passive matrices. Each rotation keeps its axis and takes the axes s3,
    G/G, b3 and i, j, b1 into one another. R(l, b3) is printed with a Polish l."""
    first, second = R3(h), R1(incl) * R3(h)
    third, fourth = R3(g) * R1(incl) * R3(h), R1(J) * R3(g) * R1(incl) * R3(h)
    equal(first * node_i, Matrix([1, 0, 0]))
    equal(second * node_i, Matrix([1, 0, 0]))
    equal(second * direction, Matrix([0, 0, 1]))
    equal(third * direction, Matrix([0, 0, 1]))
    equal(third * five.T * node_j, Matrix([1, 0, 0]))
    equal(fourth * five.T * node_j, Matrix([1, 0, 0]))
    equal(fourth * five.T * b3, Matrix([0, 0, 1]))
    equal(five * five.T * b3, Matrix([0, 0, 1]))


# The expressions inside the brackets of v1, v2, v3
along_j1 = cos(l) * cos(g) - sin(l) * cos(J) * sin(g)
along_j2 = -sin(l) * cos(g) - cos(l) * cos(J) * sin(g)
across1 = cos(l) * sin(g) + sin(l) * cos(J) * cos(g)
across2 = -sin(l) * sin(g) + cos(l) * cos(J) * cos(g)
up1, up2 = sin(l) * sin(J), cos(l) * sin(J)
sI, cI, sh, ch = sin(incl), cos(incl), sin(h), cos(h)


@section.misprint("v1", "row 1: (cl cg - sl cJ sg) ch - (cl sg + sl cJ cg) cI - sl sJ sI sh; row 2:"
                  " -sl cg - cl cJ sg ch - (-sl sg + cl cJ cg) cI - cl sJ sI sh",
                  right="row 1: (cl cg - sl cJ sg) ch - [(cl sg + sl cJ cg) cI - sl sJ sI] sh;"
                  " row 2: (-sl cg - cl cJ sg) ch - [(-sl sg + cl cJ cg) cI"
                  " - cl sJ sI] sh")
def eq_v1():
    """Compare with the first column of the product Rnew. Row 3 is right as printed."""
    differs(five[0, 0], along_j1 * ch - across1 * cI - up1 * sI * sh)
    differs(five[1, 0], -sin(l) * cos(g) - cos(l) * cos(J) * sin(g) * ch
            - across2 * cI - up2 * sI * sh)
    equal(five[0, 0], along_j1 * ch - (across1 * cI - up1 * sI) * sh)
    equal(five[1, 0], along_j2 * ch - (across2 * cI - up2 * sI) * sh)
    equal(five[2, 0], sin(J) * sin(g) * ch + (sin(J) * cos(g) * cI + cos(J) * sI) * sh)


@section.misprint("v2", "row 1: (cl cg - sl cJ sg) sh + (cl sg + sl cJ cg) cI - sl sJ sI ch; row 2:"
                  " -sl cg - cl cJ sg sh + (-sl sg + cl cJ cg) cI - cl sJ sI ch",
                  right="row 1: (cl cg - sl cJ sg) sh + [(cl sg + sl cJ cg) cI - sl sJ sI] ch;"
                  " row 2: (-sl cg - cl cJ sg) sh + [(-sl sg + cl cJ cg) cI"
                  " - cl sJ sI] ch")
def eq_v2():
    """Compare with the second column of the product Rnew. Row 3 is right as printed."""
    differs(five[0, 1], along_j1 * sh + across1 * cI - up1 * sI * ch)
    differs(five[1, 1], -sin(l) * cos(g) - cos(l) * cos(J) * sin(g) * sh
            + across2 * cI - up2 * sI * ch)
    equal(five[0, 1], along_j1 * sh + (across1 * cI - up1 * sI) * ch)
    equal(five[1, 1], along_j2 * sh + (across2 * cI - up2 * sI) * ch)
    equal(five[2, 1], sin(J) * sin(g) * sh + (-sin(J) * cos(g) * cI - cos(J) * sI) * ch)


@section.misprint("v3", "row 2: -sl sg + cl cJ cg sI + cl sJ cI",
                  right="row 2: (-sl sg + cl cJ cg) sI + cl sJ cI")
def eq_v3():
    """Compare with the third column of the product Rnew. Rows 1 and 3 are right as printed."""
    differs(five[1, 2], -sin(l) * sin(g) + cos(l) * cos(J) * cos(g) * sI + up2 * cI)
    equal(five[1, 2], across2 * sI + up2 * cI)
    equal(five[0, 2], across1 * sI + up1 * cI)
    equal(five[2, 2], -sin(J) * cos(g) * sI + cos(J) * cI)


@section.equation("cantran2", "Phi dphi + Theta dtheta + Psi dpsi = L dl + G dg + H dh")
def eq_cantran2():
    """Insert (33) to (35). The differentials of the five angles are arbitrary."""
    equal(one_form(), G * cos(J) * dl + G * dg + G * cos(incl) * dh, of_five)


@section.equation("dr1", "dR = s3 dphi + l dtheta + b3 dpsi")
def eq_dr1():
    """dR is the vector of the infinitesimal rotation: hat of its body components is -dR R^T of
    the matrix."""
    changes = Matrix(symbols("dphi dtheta dpsi"))
    vector = R * (s3 * changes[0] + node * changes[1]) + b3 * changes[2]
    equal(-along(R, dict(zip(q, changes))) * R.T, hat(vector))


@section.equation("(72)", "G . s3 = Phi, G . l = Theta, G . b3 = Psi")
def eq_72():
    equal(G_I.dot(s3), momenta[0])
    equal(G_I.dot(node), momenta[1])
    equal(g_B.dot(b3), momenta[2])


@section.equation("(73)", "Phi dphi + Theta dtheta + Psi dpsi = G . dR")
def eq_73():
    """Multiply (29) to (31) and (dr1), in inertial components."""
    changes = Matrix(symbols("dphi dtheta dpsi"))
    vector = s3 * changes[0] + node * changes[1] + R.T * b3 * changes[2]
    equal(G_I.dot(vector), Matrix(momenta).dot(changes))


def rotation_vector():
    """(dr2) in body components."""
    inertial = s3 * dh + node_i * dI + direction * dg
    return five * inertial + node_j * dJ + b3 * dl


@section.equation("dr2", "dR = s3 dh + i dI + (G/G) dg + j dJ + b3 dl")
def eq_dr2():
    """The proof is that of (dr1), for the product of five rotations."""
    equal(-along(five, moving) * five.T, hat(rotation_vector()))


@section.equation("(74)", "G . dR = Phi dh + G dg + Psi dl")
def eq_74():
    """Multiply (32) and (dr2): G . i = G . j = 0. Here Phi = G cI and Psi = G cJ."""
    equal(five * direction * G, g_of_plane)
    equal(direction.dot(node_i))
    equal(g_of_plane.dot(node_j))
    equal(g_of_plane.dot(rotation_vector()), G * (cos(incl) * dh + dg + cos(J) * dl))


@section.equation("(75)", "Phi dphi + Theta dtheta + Psi dpsi = G . dR = Phi dh + G dg + Psi dl")
def eq_75():
    equal(one_form(), g_of_plane.dot(rotation_vector()), of_five)
    Phi, _, Psi = (momenta_of_plane[p] for p in momenta)
    equal(one_form(), Phi * dh + G * dg + Psi * dl, of_five)


@section.equation("(76)", "Phi = H, Psi = L")
def eq_76():
    """Compare the coefficients of dh and dl in (75), with G cI = H and G cJ = L."""
    equal(momenta_of_plane[momenta[0]], G * cos(incl), of_five)
    equal(momenta_of_plane[momenta[2]], G * cos(J))


@section.equation("(84)", "cI = H/G, cJ = L/G")
def eq_84():
    """Project G on s3 and b3."""
    equal((G * direction).dot(s3), G * cos(incl))
    equal(g_of_plane.dot(b3), G * cos(J))


@section.equation("(78)", "ctheta = L H/G^2 - (cg/G^2) sqrt((G^2 - L^2)(G^2 - H^2))")
def eq_78():
    """Compare with the entry (3, 3) of Rnew."""
    equal(five[2, 2], L * H / G**2 - cos(g) / G**2 * sqrt_L * sqrt_H, of_momenta)


@section.misprint("(79)", "tan psi = [sqrt(G^2 - H^2) (G sg cl + L sl cg) + H sl sqrt(G^2 - L^2)]"
                  "/[-sqrt(G^2 - H^2) (G sg sl + L cl cg) + H cl sqrt(G^2 - L^2)]",
                  right="denominator -sqrt(G^2 - H^2) (G sg sl - L cl cg)"
                  " + H cl sqrt(G^2 - L^2)")
def eq_79():
    """Compare with the entries (1, 3) and (2, 3) of Rnew: numerator and denominator are G^2
    stheta times spsi and cpsi."""
    above = sqrt_H * (G * sin(g) * cos(l) + L * sin(l) * cos(g)) + H * sin(l) * sqrt_L
    printed = -sqrt_H * (G * sin(g) * sin(l) + L * cos(l) * cos(g)) + H * cos(l) * sqrt_L
    right = -sqrt_H * (G * sin(g) * sin(l) - L * cos(l) * cos(g)) + H * cos(l) * sqrt_L
    differs(five[0, 2] / five[1, 2], above / printed, of_momenta)
    equal(five[0, 2], above / G**2, of_momenta)
    equal(five[1, 2], right / G**2, of_momenta)


@section.equation("(80)", "tan phi = -[sqrt(G^2 - L^2) (G sg ch + H sh cg) + L sh sqrt(G^2 - H^2)]"
                  "/[sqrt(G^2 - L^2) (G sg sh - H ch cg) - L ch sqrt(G^2 - H^2)]")
def eq_80():
    """Compare with the entries (3, 1) and (3, 2) of Rnew. N and D, of the printed -N/D, are G^2
    stheta times sphi and -cphi, so that phi = atan2(N, -D)."""
    above = sqrt_L * (G * sin(g) * ch + H * sh * cos(g)) + L * sh * sqrt_H
    below = sqrt_L * (G * sin(g) * sh - H * ch * cos(g)) - L * ch * sqrt_H
    equal(five[2, 0], above / G**2, of_momenta)
    equal(-five[2, 1], -below / G**2, of_momenta)
    equal(five[2, 0] / -five[2, 1], -above / below, of_momenta)


@section.misprint("Theta", "Theta = G sJ s(psi - l) = sqrt(G^2 - L^2) s(psi - l)",
                  right="Theta = sqrt(G^2 - L^2) s(l - psi)")
def eq_Theta():
    """Insert (32) into Theta = g1 cpsi - g2 spsi, which follows from (25) and (26)."""
    projection = g_of_plane[0] * cos(psi) - g_of_plane[1] * sin(psi)
    differs(projection, sqrt_L * sin(psi - l), of_momenta)
    equal(projection, sqrt_L * sin(l - psi), of_momenta)
    equal(g_B[0] * cos(psi) - g_B[1] * sin(psi), momenta[1])


@section.equation("newhamil", "H = 1/2 (sl^2/I1 + cl^2/I2)(G^2 - L^2) + L^2/(2 I3)")
def eq_newhamil():
    """Insert (33) to (35) into (23), or (1490) to (1492) into (kinetic)."""
    equal(hamiltonian.subs(momenta_of_plane), energy, of_momenta)
    kinetic = half * sum(x**2 / m for x, m in zip(g_of_plane, (I1, I2, I3)))
    equal(kinetic, energy, of_momenta)


@section.equation("(1490)", "g1 = G sJ sl = sqrt(G^2 - L^2) sl")
def eq_1490():
    equal(g_of_plane[0], sqrt_L * sin(l), of_momenta)


@section.equation("(1491)", "g2 = G sJ cl = sqrt(G^2 - L^2) cl")
def eq_1491():
    equal(g_of_plane[1], sqrt_L * cos(l), of_momenta)


@section.equation("(1492)", "g3 = L")
def eq_1492():
    equal(g_of_plane[2], L, of_momenta)


@section.equation("constraint", "-G <= L <= G")
def eq_constraint():
    """G^2 - L^2 is G^2 sJ^2 = g1^2 + g2^2, which is not negative."""
    equal(G**2 - (G * cos(J)) ** 2, (G * sin(J)) ** 2)
    equal((G * sin(J)) ** 2, g_of_plane[0] ** 2 + g_of_plane[1] ** 2)


@section.equation("hge0", "H >= 0")
def eq_hge0():
    """H is a sum of squares over moments. It even lies between G^2/(2 I3) and G^2/(2 I1): the
    differences are sums of squares over moments times I3 - I1, I3 - I2 and I2 - I1."""
    square = [x**2 for x in g_of_plane]
    equal(energy, half * sum(x / m for x, m in zip(square, (I1, I2, I3))), of_momenta)
    equal(
        energy - G**2 / (2 * I3),
        half * (square[0] * (I3 - I1) / (I1 * I3) + square[1] * (I3 - I2) / (I2 * I3)),
        of_momenta,
    )
    equal(
        G**2 / (2 * I1) - energy,
        half * (square[1] * (I2 - I1) / (I1 * I2) + square[2] * (I3 - I1) / (I1 * I3)),
        of_momenta,
    )


section.definition("Hamilton", "qdot = H_p, pdot = -H_q", "Hamilton's equations without torque.")


@section.equation("dot_g", "gdot = H_G = G (sl^2/I1 + cl^2/I2)")
def eq_dot_g():
    equal(diff(energy, G), G * (sin(l) ** 2 / I1 + cos(l) ** 2 / I2))


@section.equation("dot_h", "hdot = H_H = 0")
def eq_dot_h():
    equal(diff(energy, H))


@section.equation("dot_l", "ldot = H_L = L (1/I3 - sl^2/I1 - cl^2/I2)")
def eq_dot_l():
    equal(diff(energy, L), L * (1 / I3 - sin(l) ** 2 / I1 - cos(l) ** 2 / I2))


@section.equation("dot_G", "Gdot = -H_g = 0")
def eq_dot_G():
    equal(-diff(energy, g))


@section.equation("dot_H", "Hdot = -H_h = 0")
def eq_dot_H():
    equal(-diff(energy, h))


@section.equation("dot_L", "Ldot = -H_l = (L^2 - G^2) sl cl (1/I1 - 1/I2)")
def eq_dot_L():
    equal(-diff(energy, l), (L**2 - G**2) * sin(l) * cos(l) * (1 / I1 - 1 / I2))
