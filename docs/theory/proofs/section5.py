# SPDX-License-Identifier: MIT
"""Section 5 of the paper: Sadov's action and angle variables.

An elliptic integral is known by its integrand: two integrals from z = 0 are equal if their
integrands are. K, F and Pi are symbols in what follows from such equations. The second argument
of an elliptic integral is the modulus, and Pi(kappa^2, lambda) is the integral of
1/[(1 + kappa^2 sin^2 x) sqrt(1 - lambda^2 sin^2 x)]."""

import mpmath
from proof import Section, close, differs, equal
from section2 import I1, I2, I3, G, g, g_of_plane, h, half, l
from section3_1 import L, derivative_by_G, derivative_by_T, energy, spread, t
from section3_2 import of_momenta
from sympy import Function, atan, cos, diff, pi, sin, sqrt, symbols

section = Section("5", "Sadov's variables")

alpha1, alpha2, alpha3, z = symbols("alpha1 alpha2 alpha3 z")
kappa, lam = symbols("kappa lambda", positive=True)
U = Function("U")(l, alpha1, alpha2)
S = -alpha1 * t + alpha2 * g + alpha3 * h + U
slope = symbols("U_l")  # dU/dl

# (SadovPar): kappa^2 and lambda^2 of the moments, the energy and the length of G
kappa2 = I3 * (I2 - I1) / (I1 * (I3 - I2))
lambda2 = kappa2 * I1 / I3 * (2 * I3 * alpha1 - alpha2**2) / (alpha2**2 - 2 * I1 * alpha1)


def jacobi_left(S_g, S_l, S_t):
    return half * spread * (S_g**2 - S_l**2) + S_l**2 / (2 * I3) + S_t


@section.equation("HJ", "1/2 (sl^2/I1 + cl^2/I2)(S_g^2 - S_l^2) + S_l^2/(2 I3) + S_t = 0")
def eq_HJ():
    """Put S_g and S_l for G and L into (newhamil), with H* = 0."""
    S_g, S_l, S_t = symbols("S_g S_l S_t")
    equal(jacobi_left(S_g, S_l, S_t), energy.subs({G: S_g, L: S_l}) + S_t)


@section.equation("S", "S = -alpha1 t + alpha2 g + alpha3 h + U(l)")
def eq_S():
    """Neither t nor g nor h occurs in the equation."""
    for x, constant in ((t, -alpha1), (g, alpha2), (h, alpha3)):
        equal(diff(S, x), constant)
        equal(diff(energy, x))


@section.misprint("U2", "U_l^2 [(1/I3 - 1/I2) - (1/I1 - 1/I2) sl^2] = (2 alpha1^2 - alpha2^2/I2)"
                  " - alpha2^2 (1/I1 - 1/I2) sl^2",
                  right="2 alpha1 - alpha2^2/I2")
def eq_U2():
    """It is twice Jacobi's equation with the derivatives of S. alpha1 is the energy."""
    left = slope**2 * ((1 / I3 - 1 / I2) - (1 / I1 - 1 / I2) * sin(l) ** 2)
    tail = alpha2**2 * (1 / I1 - 1 / I2) * sin(l) ** 2
    twice = 2 * jacobi_left(alpha2, slope, -alpha1)
    differs(left - (2 * alpha1**2 - alpha2**2 / I2) + tail, twice)
    equal(left - (2 * alpha1 - alpha2**2 / I2) + tail, twice)


a, b = I1 * (alpha2**2 - 2 * alpha1 * I2), (I2 - I1) * alpha2**2
c, d = I1 * (I3 - I2), I3 * (I2 - I1)
slope_squared = I3 * (a + b * sin(l) ** 2) / (c + d * sin(l) ** 2)


@section.equation("abcd", "U_l^2 = I3 (a + b sl^2)/(c + d sl^2)")
def eq_abcd():
    """This U_l^2 solves Jacobi's equation; b, c, d > 0 since I1 < I2 < I3."""
    equal(jacobi_left(alpha2, sqrt(slope_squared), -alpha1))


@section.equation("SerTointerm", "L = sqrt(I3 (a + b sl^2)/(c + d sl^2)), G = alpha2, H = alpha3,"
                  " beta1 = -t + U_alpha1, beta2 = g + U_alpha2, beta3 = h")
def eq_SerTointerm():
    """Differentiate S. L has a sign of its own. With U = int L dl from l = pi/2 the betas
    are Serret's constants: L_alpha1 dl = dt and L_alpha2 dl = -gdot dt."""
    of_state = {alpha1: energy, alpha2: G}
    equal(slope_squared.subs(of_state, simultaneous=True), L**2)
    for x, value in ((g, alpha2), (h, alpha3)):
        equal(diff(S, x), value)
    equal(diff(S, alpha1), -t + diff(U, alpha1))
    equal(diff(S, alpha2), g + diff(U, alpha2))
    equal(diff(S, alpha3), h)
    derivative_by_T()
    derivative_by_G()


@section.equation("Haminterm", "H = -S_t = alpha1")
def eq_Haminterm():
    equal(-diff(S, t), alpha1)
    equal(jacobi_left(alpha2, sqrt(slope_squared), 0), alpha1)


@section.equation("SadovPar", "kappa^2 = I3 (I2 - I1)/[I1 (I3 - I2)] >= 0,"
                  " lambda^2 = kappa^2 (I1/I3) (2 I3 alpha1 - alpha2^2)"
                  "/(alpha2^2 - 2 I1 alpha1) >= 0")
def eq_SadovPar():
    """2 I3 T - G^2 and G^2 - 2 I1 T are sums of squares times differences of moments, and lambda
    is the modulus called kappa in (A20)."""
    square = [x**2 for x in g_of_plane]
    equal(2 * I3 * energy - G**2, square[0] * (I3 - I1) / I1 + square[1] * (I3 - I2) / I2,
          of_momenta)
    equal(G**2 - 2 * I1 * energy, square[1] * (I2 - I1) / I2 + square[2] * (I3 - I1) / I3,
          of_momenta)
    P2 = 2 * alpha1 / alpha2**2
    a2, b2 = (P2 - 1 / I3) / (1 / I1 - 1 / I3), (P2 - 1 / I3) / (1 / I2 - 1 / I3)
    equal(lambda2, (b2 - a2) / (1 - a2))


# (LSadov), in kappa and lambda
L_squared = (
    alpha2**2 * kappa**2 / (kappa**2 + lam**2)
    * (1 - lam**2 + (kappa**2 + lam**2) * sin(l) ** 2) / (1 + kappa**2 * sin(l) ** 2)
)
energy_of_lambda = (
    alpha2**2 / (2 * I1 * I3) * (I3 * lam**2 + I1 * kappa**2) / (kappa**2 + lam**2)
)


def of_body(expression):
    """With kappa^2 and lambda^2 of (SadovPar); only even powers occur."""
    return expression.subs({kappa: sqrt(kappa2), lam: sqrt(lambda2)})


@section.equation("LSadov", "L^2 = alpha2^2 kappa^2/(kappa^2 + lambda^2)"
                  " [1 - lambda^2 + (kappa^2 + lambda^2) sl^2]/(1 + kappa^2 sl^2)")
def eq_LSadov():
    """Insert (SadovPar); the result is (abcd)."""
    equal(of_body(L_squared), slope_squared)


@section.equation("Haminterm, second form", "H = alpha2^2/(2 I1 I3)"
                  " (I3 lambda^2 + I1 kappa^2)/(kappa^2 + lambda^2)")
def eq_Haminterm_2():
    """Insert (SadovPar)."""
    equal(of_body(energy_of_lambda), alpha1)


# --- numbers for the short-axis and the long-axis mode


def values(state, moments):
    """T, kappa, lambda for l, g, L, G."""
    (l_, _, L_, G_), (m1, m2, m3) = state, moments
    T_ = (mpmath.sin(l_) ** 2 / m1 + mpmath.cos(l_) ** 2 / m2) * (G_**2 - L_**2) / 2
    T_ += L_**2 / (2 * m3)
    k2 = m3 * (m2 - m1) / (m1 * (m3 - m2))
    return T_, mpmath.sqrt(k2), mpmath.sqrt(
        k2 * m1 / m3 * (2 * m3 * T_ - G_**2) / (G_**2 - 2 * m1 * T_))


def action_ratio(k, w):
    """I_l/I_g of (IellSadov); for lambda > 1 with K(1/lambda)/lambda for K and
    Pi(kappa^2/lambda^2, 1/lambda)/lambda for Pi."""
    if w < 1:
        K, Pi = mpmath.ellipk(w**2), mpmath.ellippi(-(k**2), w**2)
    else:
        K, Pi = mpmath.ellipk(w**-2) / w, mpmath.ellippi(-((k / w) ** 2), w**-2) / w
    front = 2 * mpmath.sqrt(1 + k**2) / (mpmath.pi * k * mpmath.sqrt(k**2 + w**2))
    return front * ((k**2 + w**2) * Pi - w**2 * K)


def sadov(state, moments):
    """(phi_l, phi_g, I_l, I_g) for l, g, L, G in either mode."""
    (l_, g_, L_, G_), (m1, m2, m3) = state, moments
    T_, k, w = values(state, moments)
    front = mpmath.sqrt((k**2 + w**2) * (1 + k**2)) / k
    if w < 1:
        sign, m, n, scale = mpmath.sign(L_), w**2, -(k**2), 1
        amplitude = mpmath.atan2(-mpmath.cos(l_) / mpmath.sqrt(1 + k**2), mpmath.sin(l_))
    else:
        sign, m, n, scale = 1, w**-2, -((k / w) ** 2), 1 / w
        D = G_**2 - 2 * T_ * m1
        g2 = mpmath.sqrt(G_**2 - L_**2) * mpmath.cos(l_)
        amplitude = mpmath.atan2(-mpmath.sign(mpmath.sin(l_)) * g2
                                 / mpmath.sqrt(m2 * D / (m2 - m1)),
                                 L_ / mpmath.sqrt(m3 * D / (m3 - m1)))
    turn = mpmath.ellipf(amplitude, m) / mpmath.ellipk(m)
    swing = mpmath.ellippi(n, amplitude, m) - mpmath.ellippi(n, m) * turn
    return [mpmath.pi / 2 * turn, g_ + sign * scale * front * swing,
            sign * G_ * action_ratio(k, w), G_]


MOMENTS = [mpmath.mpf(x) for x in ("1", "1.7", "2.1")]
# l, g, L, G around b3, -b3, b1 and -b1
ROWS = ("0.7 0.4 1.9 2", "0.7 0.4 -1.9 2", "1.4 0.4 0.3 2", "-1.4 0.4 0.3 2")
STATES = [[mpmath.mpf(x) for x in row.split()] for row in ROWS]


@section.equation("ActioTransf", "(l, g, h, L, G, H) -> (phi_l, phi_g, phi_h, I_l, I_g, I_h)"
                  " is canonical", slow=True)
def eq_ActioTransf():
    """Evaluate the Poisson brackets of phi_l, phi_g, I_l, I_g in (l, g; L, G) by differences,
    around b3, -b3, b1 and -b1."""
    step, weights = mpmath.mpf(10) ** -12, (-1, 9, -45, 45, -9, 1)
    with mpmath.workdps(80):
        for state in STATES:
            rows = []
            for i in range(4):
                ends = [sadov([x + k * step * (i == j) for j, x in enumerate(state)], MOMENTS)
                        for k in (-3, -2, -1, 1, 2, 3)]
                rows.append([sum(w * e[j] for w, e in zip(weights, ends)) / (60 * step)
                             for j in range(4)])
            for i in range(4):
                for j in range(i):
                    found = sum(rows[k][i] * rows[k + 2][j] - rows[k + 2][i] * rows[k][j]
                                for k in range(2))
                    close(found, -1 if i == j + 2 else 0)


section.definition("actions", "I_l = 1/(2 pi) oint L dl, I_g = G, I_h = H",
                   "Around b3 or -b3, l goes over a turn and I_l has the sign of L. Around b1 or"
                   " -b1 it is one loop, and I_l > 0.")

below = sqrt(1 + kappa**2 * sin(z) ** 2)
root_kappa, root_both = sqrt(1 + kappa**2), sqrt(kappa**2 + lam**2)
delta = sqrt(1 - lam**2 * sin(z) ** 2)
through_z = {l: (cos(z) / below, -root_kappa * sin(z) / below)}
l_by_z = root_kappa / below**2
L_of_z = alpha2 * kappa / root_both * delta  # L > 0
# Integrands of F(z, lambda) and of Pi(z, kappa^2, lambda)
of_F, of_Pi = 1 / delta, 1 / (below**2 * delta)
front = alpha2 * root_kappa / (kappa * root_both)


@section.equation("changeAction", "sl = cz/sqrt(1 + kappa^2 sz^2),"
                  " cl = -sqrt(1 + kappa^2) sz/sqrt(1 + kappa^2 sz^2)")
def eq_changeAction():
    """The squares add to 1; dl/dz = sqrt(1 + kappa^2)/(1 + kappa^2 sz^2); and L = alpha2 kappa
    sqrt(1 - lambda^2 sz^2)/sqrt(kappa^2 + lambda^2). z = 0 is l = pi/2."""
    sine, cosine = through_z[l]
    equal(sine**2 + cosine**2, 1)
    equal(diff(sine, z), cosine * l_by_z)
    equal(diff(cosine, z), -sine * l_by_z)
    equal(L_squared, L_of_z**2, through_z)


def quadrature_of_L(third, first):
    """L dl/dz against the derivative of front [(kappa^2 + lambda^2) Pi - lambda^2 F]."""
    return L_of_z * l_by_z, front * ((kappa**2 + lam**2) * third - lam**2 * first)


@section.equation("IellSadov", "I_l = 2 alpha2 sqrt(1 + kappa^2)/[pi kappa"
                  " sqrt(kappa^2 + lambda^2)] [(kappa^2 + lambda^2) Pi - lambda^2 K]")
def eq_IellSadov():
    """The integrands of L dl and of the right-hand side agree; a turn is four quarters."""
    equal(*quadrature_of_L(of_Pi, of_F))


# Long-axis mode, lambda > 1: sz = sx/lambda, where x goes over a turn
x = symbols("x")
cos_z = sqrt(1 - sin(x) ** 2 / lam**2)
through_x = {z: (sin(x) / lam, cos_z)}
z_by_x = cos(x) / (lam * cos_z)
loop = alpha2 * kappa / root_both * cos(x) * l_by_z * z_by_x  # L dl/dx: delta is cx
of_K_long = 1 / (lam * cos_z)  # K(1/lambda)/lambda
of_Pi_long = of_K_long / (1 + (kappa / lam) ** 2 * sin(x) ** 2)


@section.equation("IellSadov, lambda > 1", "with K(1/lambda)/lambda for K and"
                  " Pi(kappa^2/lambda^2, 1/lambda)/lambda for Pi")
def eq_IellSadov_long():
    """With sz = sx/lambda, L is proportional to cx, and the integrands by x agree."""
    equal(1 - lam**2 * sin(z) ** 2, cos(x) ** 2, through_x)
    equal(cos_z * z_by_x, diff(sin(x) / lam, x))
    equal(loop, front * ((kappa**2 + lam**2) * of_Pi_long - lam**2 * of_K_long), through_x)


@section.equation("IellSadov, range", "I_l/I_g falls from 1 at lambda = 0 through"
                  " (2/pi) arctan kappa at lambda = 1 to 0")
def eq_IellSadov_range():
    """The integrand by z is dl/dz at lambda = 0 and the derivative of arctan(kappa sz) at lambda
    = 1. The integrand by x is of order 1/lambda^2 as lambda grows. The text has all values >= 0
    for the range, and "or" between the two conditions for analyticity, which must be "and"."""
    by_z = kappa / root_both * delta * l_by_z
    equal(by_z.subs(lam, 0), l_by_z)
    equal(by_z.subs(delta, cos(z)).subs(lam, 1), diff(atan(kappa * sin(z)), z))
    tends_to_1 = (1 + (kappa / lam) ** 2 * sin(x) ** 2) * cos_z
    equal(loop * lam * root_both * tends_to_1, alpha2 * kappa * root_kappa * cos(x) ** 2, through_x)


@section.equation("SadovH", "H = I_g^2/(2 I1 I3) (I3 lambda^2 + I1 kappa^2)/(kappa^2 + lambda^2)")
def eq_SadovH():
    """Insert (SadovPar), with I_g = alpha2."""
    equal(of_body(energy_of_lambda), alpha1)


section.definition("Hamilton", "phidot = H_I", "Hamilton's equations of the angles.")

I_l, I_g, I_h = symbols("I_l I_g I_h")
W = I_g * g + I_h * h + Function("V")(l, I_l, I_g)


@section.misprint("transf. eqs", "last line: phi_g = W_Ih = h", right="phi_h = W_Ih = h")
def eq_transf():
    """Differentiate W. Its derivative by I_g is phi_g, and contains g."""
    differs(diff(W, I_h), diff(W, I_g))
    equal(diff(W, I_h), h)
    equal(diff(W, I_g), g + diff(Function("V")(l, I_l, I_g), I_g))
    equal(diff(W, g), I_g)
    equal(diff(W, h), I_h)


section.definition("V", "V = int L dl from l_o", "l_o = pi/2, where z = 0.")

# K, Pi, F(z), Pi(z) from here on
K, Pi, F_z, Pi_z, f = symbols("K Pi F_z Pi_z f")
action = 2 * front / pi * ((kappa**2 + lam**2) * Pi - lam**2 * K)
slope_of_action = -2 * alpha2 * kappa * lam * root_kappa / (pi * root_both**3) * K
by_lambda = -alpha2 * kappa * lam * root_kappa / root_both**3  # of int dL/dlambda dl, times F


@section.equation("dI_l/dlambda", "dI_l/dlambda = -2 I_g kappa lambda sqrt(1 + kappa^2) K"
                  "/[pi (kappa^2 + lambda^2)^(3/2)]")
def eq_slope_of_action():
    """Differentiate under the integral sign. At fixed l, dL/dlambda dl/dz is a constant times the
    integrand of K. The printed loop integral lacks its dl."""
    equal(diff(L_squared, lam) / (2 * L_of_z) * l_by_z, by_lambda * of_F, through_z)
    equal(4 / (2 * pi) * by_lambda * K, slope_of_action)


@section.equation("partialPhiU", "dphi/du = I_g/(dI_l/dlambda)"
                  " = -pi (kappa^2 + lambda^2)^(3/2)/[2 kappa lambda sqrt(1 + kappa^2)"
                  " K]")
def eq_partialPhiU():
    """Differentiate the inverse function."""
    equal(alpha2 / slope_of_action, -pi * root_both**3 / (2 * kappa * lam * root_kappa * K))


lambda_by_Ig = (kappa**2 + lam**2) / (alpha2 * kappa**2 * lam * K) * (
    (kappa**2 + lam**2) * Pi - lam**2 * K)


@section.equation("dlambda/dI_g", "dlambda/dI_g = (I_l/I_g^2) pi (kappa^2 + lambda^2)^(3/2)"
                  "/[2 kappa lambda sqrt(1 + kappa^2) K]"
                  " = (kappa^2 + lambda^2)/(I_g kappa^2 lambda K)"
                  " [(kappa^2 + lambda^2) Pi - lambda^2 K]")
def eq_lambda_by_Ig():
    """The derivative of u = I_l/I_g by I_g is -I_l/I_g^2. Then insert (IellSadov)."""
    by_u = -pi * root_both**3 / (2 * kappa * lam * root_kappa * K)
    equal(by_u * diff(I_l / I_g, I_g), I_l / I_g**2 * (-by_u))
    equal(action / alpha2**2 * (-by_u), lambda_by_Ig)


@section.equation("phiSadovProv", "phi_l = dlambda/dI_l int dL/dlambda dl,"
                  " phi_g = g + (1/I_g) int L dl + dlambda/dI_g int dL/dlambda dl")
def eq_phiSadovProv():
    """Use the chain rule for V(l, lambda(I_l/I_g), I_g). V is proportional to I_g, as L is."""
    v, inverse = Function("v"), Function("lambda")(I_l / I_g)
    V = I_g * v(l, inverse)
    x = symbols("x")
    slope_v = diff(v(l, x), x).subs(x, inverse)
    equal(diff(V, I_l), I_g * slope_v * diff(inverse, I_l))
    equal(diff(V, I_g), V / I_g + I_g * slope_v * diff(inverse, I_g))
    equal(alpha2 * diff(L_squared, alpha2), 2 * L_squared)


@section.equation("dL/dlambda", "dL/dlambda = -I_g kappa lambda (1 + kappa^2)/(kappa^2"
                  " + lambda^2)^(3/2)/[sqrt(1 + kappa^2 sl^2)"
                  " sqrt(1 - lambda^2 + (kappa^2 + lambda^2) sl^2)]")
def eq_dL_dlambda():
    """Differentiate the root of (LSadov), for L > 0."""
    first = sqrt(1 + kappa**2 * sin(l) ** 2)
    second = sqrt(1 - lam**2 + (kappa**2 + lam**2) * sin(l) ** 2)
    equal(
        diff(alpha2 * kappa * second / (root_both * first), lam),
        -alpha2 * kappa * lam * (1 + kappa**2) / root_both**3 / (first * second),
    )


@section.equation("quad dL/dlambda", "int dL/dlambda dl = -I_g kappa lambda sqrt(1 + kappa^2)"
                  "/(kappa^2 + lambda^2)^(3/2) F(z, lambda)")
def eq_quad_dL():
    """The integrands agree, and both sides are zero at z = 0."""
    equal(diff(L_squared, lam) / (2 * L_of_z) * l_by_z, by_lambda * of_F, through_z)


@section.misprint("quad L dl", "int L dl = (I_g/kappa) sqrt((1 + kappa^2)/(kappa^2 + lambda^2))"
                  " [(kappa^2 + lambda^2) Pi(z) - lambda^2 K(lambda)]",
                  right="... - lambda^2 F(z, lambda)")
def eq_quad_L():
    """The integrands agree, and both sides are zero at z = 0. K does not depend on z, so that
    its derivative is zero."""
    differs(*quadrature_of_L(of_Pi, 0))
    equal(*quadrature_of_L(of_Pi, of_F))


@section.equation("phiSadov", "phi_l = (pi/2) F(z)/K, phi_g = g + (1/kappa) sqrt((kappa^2"
                  " + lambda^2)(1 + kappa^2)) [Pi(z) - Pi F(z)/K]")
def eq_phiSadov():
    """Insert the two integrals into (phiSadovProv)."""
    growth = by_lambda * F_z
    equal(growth / slope_of_action, pi / 2 * F_z / K)
    integral = front * ((kappa**2 + lam**2) * Pi_z - lam**2 * F_z)
    equal(g + integral / alpha2 + lambda_by_Ig * growth,
          g + root_both * root_kappa / kappa * (Pi_z - Pi * F_z / K))


@section.equation("inversion", "z = am(2 phi_l K/pi, lambda), g = phi_g + (1/kappa) sqrt((kappa^2"
                  " + lambda^2)(1 + kappa^2)) [(2/pi) Pi phi_l - Pi(z)]")
def eq_inversion():
    """am(., lambda) is the inverse of F(., lambda), and 2 phi_l K/pi = F(z)."""
    phi_l = pi / 2 * F_z / K
    equal(2 * phi_l * K / pi, F_z)
    phi_g = g + root_both * root_kappa / kappa * (Pi_z - Pi * F_z / K)
    equal(g, phi_g + root_both * root_kappa / kappa * (2 / pi * Pi * phi_l - Pi_z))
