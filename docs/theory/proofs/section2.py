# SPDX-License-Identifier: MIT
"""Section 2 of the paper: the Eulerian variables, their momenta and the free Hamiltonian."""

from proof import R1, R3, Section, along, bracket, differs, equal, euler_angles, hat
from sympy import Matrix, Rational, cos, diag, diff, eye, sin, symbols

section = Section("2", "Eulerian variables")

half = Rational(1, 2)
phi, theta, psi = q = symbols("phi theta psi")
phid, thetad, psid = rates = symbols("phid thetad psid")
Phi, Theta, Psi = p = symbols("Phi Theta Psi")
I1, I2, I3 = symbols("I1 I2 I3")
G, J, l = symbols("G J l")
h, incl, g = symbols("h I g")
inertia = diag(I1, I2, I3)
pairs = list(zip(q, p))

s3, node, b3 = Matrix([0, 0, 1]), Matrix([cos(phi), sin(phi), 0]), Matrix([0, 0, 1])

# (2) as printed
R = Matrix([
    [cos(psi) * cos(phi) - sin(psi) * cos(theta) * sin(phi),
     cos(psi) * sin(phi) + sin(psi) * cos(theta) * cos(phi), sin(psi) * sin(theta)],
    [-sin(psi) * cos(phi) - cos(psi) * cos(theta) * sin(phi),
     -sin(psi) * sin(phi) + cos(psi) * cos(theta) * cos(phi), cos(psi) * sin(theta)],
    [sin(theta) * sin(phi), -sin(theta) * cos(phi), cos(theta)],
])

# (5) to (7), and as a matrix that acts on the rates
omega = Matrix([
    phid * sin(theta) * sin(psi) + thetad * cos(psi),
    phid * cos(psi) * sin(theta) - thetad * sin(psi),
    psid + phid * cos(theta),
])
rate_matrix = omega.jacobian(rates)
T = half * (omega.T * inertia * omega)[0]  # (13)

# (19) to (21)
rates_of_momenta = Matrix([
    -(I1 * cos(psi) * (Psi * cos(theta) * cos(psi) - Phi * cos(psi) + Theta * sin(theta) * sin(psi))
      + I2 * sin(psi)
      * (Psi * cos(theta) * sin(psi) - Phi * sin(psi) - Theta * cos(psi) * sin(theta)))
    / (I1 * I2 * sin(theta) ** 2),
    (I2 * cos(psi) * (Phi * sin(psi) + Theta * sin(theta) * cos(psi) - Psi * sin(psi) * cos(theta))
     + I1 * sin(psi)
     * (Psi * cos(psi) * cos(theta) - Phi * cos(psi) + Theta * sin(theta) * sin(psi)))
    / (I1 * I2 * sin(theta)),
    -(I1 * I3 * cos(psi)
      * (Phi * cos(theta) * cos(psi) - Psi * cos(psi) * cos(theta) ** 2
         - Theta * sin(psi) * sin(theta) * cos(theta))
      + I3 * I2 * sin(psi)
      * (Phi * cos(theta) * sin(psi) - Psi * cos(theta) ** 2 * sin(psi)
         + Theta * cos(psi) * sin(theta) * cos(theta)))
    / (I1 * I2 * I3 * sin(theta) ** 2) + Psi / I3,
])

# (23)
tilt = (Phi - Psi * cos(theta)) / sin(theta)
hamiltonian = (
    half * (sin(psi) ** 2 / I1 + cos(psi) ** 2 / I2) * tilt**2
    + Psi**2 / (2 * I3)
    + half * (cos(psi) ** 2 / I1 + sin(psi) ** 2 / I2) * Theta**2
    + (1 / I1 - 1 / I2) * tilt * Theta * sin(psi) * cos(psi)
)

# (25) to (27), body momentum; (29) to (31), inertial momentum
g_B = Matrix([
    (Phi * sin(psi) + Theta * sin(theta) * cos(psi) - Psi * sin(psi) * cos(theta)) / sin(theta),
    (Phi * cos(psi) - Theta * sin(psi) * sin(theta) - Psi * cos(psi) * cos(theta)) / sin(theta),
    Psi,
])
G_I = Matrix([
    (Psi * sin(phi) + Theta * sin(theta) * cos(phi) - Phi * sin(phi) * cos(theta)) / sin(theta),
    (Phi * cos(theta) * cos(phi) - Psi * cos(phi) + Theta * sin(phi) * sin(theta)) / sin(theta),
    Phi,
])

# Andoyer's five rotations, and the Euler angles of the same attitude
five = R3(l) * R1(J) * R3(g) * R1(incl) * R3(h)
of_five = euler_angles(five, phi, theta, psi)
# (32): body momentum through the invariable plane
g_of_plane = G * Matrix([sin(J) * sin(l), sin(J) * cos(l), cos(J)])


def with_rates(expression):
    """The expression with the rates of (19) to (21)."""
    return expression.subs(dict(zip(rates, rates_of_momenta)))


@section.equation("(1)", "R = R(psi, b3) R(theta, l) R(phi, s3)")
def eq_1():
    """Read the factors as passive matrices. Each rotation keeps its axis, and the columns of the
    transposed product are b1, b2, b3. A product of active matrices in this order is the transpose
    of R."""
    product = R3(psi) * R1(theta) * R3(phi)
    equal(R3(phi) * node, Matrix([1, 0, 0]))
    equal(product.T * b3, R3(phi).T * R1(theta).T * b3)
    equal(R1(theta) * R3(phi) * node, Matrix([1, 0, 0]))  # the second rotation is about the node
    equal(product * product.T, eye(3))
    equal(R3(-psi) * R1(-theta) * R3(-phi), (R3(phi) * R1(theta) * R3(psi)).T)


@section.equation("(2)", "R = [cpsi cphi - spsi ctheta sphi, cpsi sphi + spsi ctheta cphi,"
                  " spsi stheta;"
                  " -spsi cphi - cpsi ctheta sphi, -spsi sphi + cpsi ctheta cphi, cpsi stheta;"
                  " stheta sphi, -stheta cphi, ctheta]")
def eq_2():
    """Multiply the three matrices of (1)."""
    equal(R, R3(psi) * R1(theta) * R3(phi))


@section.equation("(3)", "hat(omega) = -Rdot R^T")
def eq_3():
    """omega is the sum of the three rates about s3, the node and b3, in body components."""
    total = R * (s3 * phid + node * thetad) + b3 * psid
    equal(-along(R, dict(zip(q, rates))) * R.T, hat(total))


@section.equation("(4)", "hat(omega) v = omega x v")
def eq_4():
    w, v = Matrix(symbols("w1:4")), Matrix(symbols("v1:4"))
    equal(hat(w) * v, w.cross(v))


def component_of_body_rate(i):
    equal(-along(R, dict(zip(q, rates))) * R.T, hat(omega))
    equal((R * (s3 * phid + node * thetad) + b3 * psid)[i], omega[i])


@section.equation("(5)", "omega1 = phid stheta spsi + thetad cpsi")
def eq_5():
    component_of_body_rate(0)


@section.equation("(6)", "omega2 = phid cpsi stheta - thetad spsi")
def eq_6():
    component_of_body_rate(1)


@section.equation("(7)", "omega3 = psid + phid ctheta")
def eq_7():
    component_of_body_rate(2)


@section.equation("(8)", "Omega = R^T omega")
def eq_8():
    """The sum of the three rates in inertial components."""
    equal(R.T * omega, s3 * phid + node * thetad + R.T * b3 * psid)


@section.equation("(9)", "Omega1 = thetad cphi + psid stheta sphi")
def eq_9():
    equal((R.T * omega)[0], thetad * cos(phi) + psid * sin(theta) * sin(phi))


@section.misprint("(10)", "Omega2 = thetad sphi + psid stheta cphi",
                  right="Omega2 = thetad sphi - psid stheta cphi")
def eq_10():
    differs((R.T * omega)[1], thetad * sin(phi) + psid * sin(theta) * cos(phi))
    equal((R.T * omega)[1], thetad * sin(phi) - psid * sin(theta) * cos(phi))


@section.equation("(11)", "Omega3 = phid + psid ctheta")
def eq_11():
    equal((R.T * omega)[2], phid + psid * cos(theta))


def lagrange(accelerations):
    """Left-hand sides of Lagrange's equations of T."""
    moving = {**dict(zip(q, rates)), **dict(zip(rates, accelerations))}
    return Matrix([along(diff(T, v), moving) - diff(T, x) for x, v in zip(q, rates)])


def euler_poinsot(accelerations):
    moving = {**dict(zip(q, rates)), **dict(zip(rates, accelerations))}
    return inertia * along(omega, moving) + omega.cross(inertia * omega)


@section.equation("(12)", "I omegadot + omega x I omega = 0")
def eq_12():
    """Lagrange's equations are B^T (I omegadot + omega x I omega) = 0, where omega = B qdot."""
    accelerations = symbols("phidd thetadd psidd")
    equal(lagrange(accelerations), rate_matrix.T * euler_poinsot(accelerations))
    equal(rate_matrix.det(), -sin(theta))


section.definition("(13)", "L = 1/2 omega . I omega", "Lagrangian of free rotation.")


@section.equation("(14)", "I omegadot + omega x I omega = u")
def eq_14():
    """With generalised forces Q on the right of Lagrange's equations, B^T u = Q: u has the
    components (25) to (27) with Q in place of the momenta."""
    equal(rate_matrix.T * g_B, Matrix(p))


section.definition("(15)", "I = diag(I1, I2, I3)", "Principal axes of inertia.")


@section.equation("(16)", "Phi = dL/dphid = I1 stheta spsi (phid spsi stheta + thetad cpsi)"
                  " + I2 stheta cpsi (phid cpsi stheta - thetad spsi)"
                  " + I3 ctheta (phid ctheta + psid)")
def eq_16():
    equal(
        diff(T, phid),
        I1 * sin(theta) * sin(psi) * (phid * sin(psi) * sin(theta) + thetad * cos(psi))
        + I2 * sin(theta) * cos(psi) * (phid * cos(psi) * sin(theta) - thetad * sin(psi))
        + I3 * cos(theta) * (phid * cos(theta) + psid),
    )


@section.misprint("(17)", "Theta = dL/dthetad = I1 cpsi (phid stheta spsi + thetad cpsi)"
                  " - I2 spsi (phid cphi stheta - thetad spsi)",
                  right="last bracket (phid cpsi stheta - thetad spsi)")
def eq_17():
    first = I1 * cos(psi) * (phid * sin(theta) * sin(psi) + thetad * cos(psi))
    printed = phid * cos(phi) * sin(theta) - thetad * sin(psi)
    right = phid * cos(psi) * sin(theta) - thetad * sin(psi)
    differs(diff(T, thetad), first - I2 * sin(psi) * printed)
    equal(diff(T, thetad), first - I2 * sin(psi) * right)


@section.equation("(18)", "Psi = dL/dpsid = I3 (phid ctheta + psid)")
def eq_18():
    equal(diff(T, psid), I3 * (phid * cos(theta) + psid))


def rate_of_momenta(i):
    momenta = {P: diff(T, v) for P, v in zip(p, rates)}
    equal(rates_of_momenta[i].subs(momenta), rates[i])


@section.equation("(19)", "phid = -[I1 cpsi (Psi ctheta cpsi - Phi cpsi + Theta stheta spsi)"
                  " + I2 spsi (Psi ctheta spsi - Phi spsi - Theta cpsi stheta)]"
                  "/(I1 I2 stheta^2)")
def eq_19():
    """Insert (16) to (18)."""
    rate_of_momenta(0)


@section.equation("(20)", "thetad = [I2 cpsi (Phi spsi + Theta stheta cpsi - Psi spsi ctheta)"
                  " + I1 spsi (Psi cpsi ctheta - Phi cpsi + Theta stheta spsi)]"
                  "/(I1 I2 stheta)")
def eq_20():
    """Insert (16) to (18)."""
    rate_of_momenta(1)


@section.equation("(21)", "psid = -[I1 I3 cpsi (Phi ctheta cpsi - Psi cpsi ctheta^2"
                  " - Theta spsi stheta ctheta) + I3 I2 spsi (Phi ctheta spsi"
                  " - Psi ctheta^2 spsi + Theta cpsi stheta ctheta)]/(I1 I2 I3 stheta^2) + Psi/I3")
def eq_21():
    """Insert (16) to (18)."""
    rate_of_momenta(2)


section.definition("(22)", "H = Phi phid + Theta thetad + Psi psid - L", "Legendre transform.")


@section.equation("(23)", "H = 1/2 (spsi^2/I1 + cpsi^2/I2) [(Phi - Psi ctheta)/stheta]^2"
                  " + Psi^2/(2 I3) + 1/2 (cpsi^2/I1 + spsi^2/I2) Theta^2"
                  " + (1/I1 - 1/I2) [(Phi - Psi ctheta)/stheta] Theta spsi cpsi")
def eq_23():
    """Insert (19) to (21) into (22); its derivatives by the momenta are (19) to (21)."""
    equal(with_rates(sum(P * v for P, v in zip(p, rates)) - T), hamiltonian)
    equal(Matrix([diff(hamiltonian, P) for P in p]), rates_of_momenta)


section.definition("(24)", "g = I omega", "Body angular momentum.")


def component_of_body_momentum(i):
    equal(with_rates((inertia * omega)[i]), g_B[i])


@section.equation("(25)", "g1 = (Phi spsi + Theta stheta cpsi - Psi spsi ctheta)/stheta")
def eq_25():
    """Insert (19) to (21) into (24)."""
    component_of_body_momentum(0)


@section.equation("(26)", "g2 = (Phi cpsi - Theta spsi stheta - Psi cpsi ctheta)/stheta")
def eq_26():
    """Insert (19) to (21) into (24)."""
    component_of_body_momentum(1)


@section.equation("(27)", "g3 = Psi")
def eq_27():
    """Insert (19) to (21) into (24)."""
    component_of_body_momentum(2)


@section.equation("symplecticRB", "(g1, g2) = -g3, (g2, g3) = -g1, (g3, g1) = -g2")
def eq_symplectic():
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        equal(bracket(g_B[i], g_B[j], pairs), -g_B[k])


@section.misprint("(28)", "G = I Omega with I = diag(I1, I2, I3)",
                  right="G = R^T g = (R^T I R) Omega")
def eq_28():
    """The tensor is diagonal in body axes only."""
    momentum = R.T * inertia * omega
    differs(momentum, inertia * R.T * omega)
    equal(momentum, (R.T * inertia * R) * (R.T * omega))


def component_of_inertial_momentum(i):
    equal((R.T * g_B)[i], G_I[i])


@section.equation("(29)", "G1 = (Psi sphi + Theta stheta cphi - Phi sphi ctheta)/stheta")
def eq_29():
    """Insert (25) to (27) into G = R^T g."""
    component_of_inertial_momentum(0)


@section.equation("(30)", "G2 = (Phi ctheta cphi - Psi cphi + Theta sphi stheta)/stheta")
def eq_30():
    """Insert (25) to (27) into G = R^T g."""
    component_of_inertial_momentum(1)


@section.equation("(31)", "G3 = Phi")
def eq_31():
    """Insert (25) to (27) into G = R^T g."""
    component_of_inertial_momentum(2)


@section.equation("brackets of G", "(G1, G2) = G3, (G2, G3) = G1, (G3, G1) = G2")
def eq_brackets_of_G():
    """All nine brackets (g_i, G_j) are zero as well."""
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        equal(bracket(G_I[i], G_I[j], pairs), G_I[k])
        equal(Matrix([bracket(g_B[i], other, pairs) for other in G_I]), Matrix([0, 0, 0]))


def rate_of_body_momentum(i):
    return bracket(g_B[i], hamiltonian, pairs)


@section.equation("firstg1", "g1dot = (g1, H) = -(1/I2 - 1/I3) g2 g3")
def eq_firstg1():
    equal(rate_of_body_momentum(0), -(1 / I2 - 1 / I3) * g_B[1] * g_B[2])


@section.equation("firstg2", "g2dot = (g2, H) = -(1/I3 - 1/I1) g3 g1")
def eq_firstg2():
    equal(rate_of_body_momentum(1), -(1 / I3 - 1 / I1) * g_B[2] * g_B[0])


@section.misprint("firstg3", "g1dot = (g2, H) = -(1/I1 - 1/I1) g1 g2",
                  right="g3dot = (g3, H) = -(1/I1 - 1/I2) g1 g2")
def eq_firstg3():
    printed = -(1 / I1 - 1 / I1) * g_B[0] * g_B[1]
    differs(rate_of_body_momentum(1), printed)
    differs(rate_of_body_momentum(0), printed)
    equal(rate_of_body_momentum(2), -(1 / I1 - 1 / I2) * g_B[0] * g_B[1])


@section.equation("sphere", "g1^2 + g2^2 + g3^2 = G^2")
def eq_sphere():
    """The length of g is that of G, and (g.g, H) = 0."""
    equal(g_B.dot(g_B), G_I.dot(G_I))
    equal(bracket(g_B.dot(g_B), hamiltonian, pairs))


@section.equation("kinetic", "T = 1/2 omega . G = 1/2 sum I_i omega_i^2 = 1/2 sum g_i^2/I_i")
def eq_kinetic():
    """Both factors of omega . G need the same axes: omega . g or Omega . G."""
    g = inertia * omega
    equal(T, half * omega.dot(g))
    equal(T, half * (R.T * omega).dot(R.T * g))
    equal(T, half * sum(x**2 / m for x, m in zip(g, (I1, I2, I3))))
    equal(hamiltonian, half * sum(x**2 / m for x, m in zip(g_B, (I1, I2, I3))))
    differs(T, half * omega.dot(R.T * g))


@section.equation("(32)", "g1 = G sJ sl, g2 = G sJ cl, g3 = G cJ")
def eq_32():
    """Rotate the momentum from the third axis of the invariable plane to the body axes."""
    equal(R3(l) * R1(J) * Matrix([0, 0, G]), g_of_plane)


@section.equation("(33)", "Phi = g1 stheta spsi + g2 stheta cpsi + g3 ctheta"
                  " = G (ctheta cJ + stheta sJ c(psi - l)) = G cI")
def eq_33():
    """Insert (25) to (27) and (32). The last equality is that of the third inertial component."""
    axis = Matrix([sin(theta) * sin(psi), sin(theta) * cos(psi), cos(theta)])
    second = cos(theta) * cos(J) + sin(theta) * sin(J) * cos(psi - l)
    equal(axis.dot(g_B), Phi)
    equal(axis.dot(g_of_plane), G * second)
    equal(second, cos(incl), of_five)


@section.equation("(34)", "Theta = g1 cpsi - g2 spsi = G sJ s(l - psi)")
def eq_34():
    """Insert (25), (26) and (32). The equation has no number of its own in the paper."""
    equal(g_B[0] * cos(psi) - g_B[1] * sin(psi), Theta)
    equal(g_of_plane[0] * cos(psi) - g_of_plane[1] * sin(psi), G * sin(J) * sin(l - psi))


@section.equation("(35)", "Psi = g3 = G cJ")
def eq_35():
    equal(g_B[2], Psi)
    equal(g_of_plane[2], G * cos(J))
