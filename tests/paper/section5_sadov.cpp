// SPDX-License-Identifier: MIT
// Section 5 of the paper: Sadov's action and angle variables.
#include <gtest/gtest.h>

#include <array>
#include <cstddef>

#include "budgets.hpp"
#include "paper/library.hpp"
#include "paper/support.hpp"
#include "polhode/free/free_rotation.hpp"
#include "polhode/free/sadov.hpp"

namespace polhode::paper {
namespace {

using budget::paper_derivative;
using budget::paper_exact;
using budget::paper_misprint;
using budget::paper_quadrature;

Mp sum2(const Polhode& p) { return squared(p.kappa) + squared(p.lambda); }
Mp one_plus(const Mp& kappa) { return 1 + squared(kappa); }

// Modulus and characteristic of the real form in either mode: with 1/lambda for lambda when that
// exceeds 1, Pi(kappa^2, lambda) becomes Pi(kappa^2/lambda^2, 1/lambda)/lambda.
struct Shape {
  Mp k, characteristic, scale;
};
Shape shape(const Mp& kappa, const Mp& lambda) {
  if (lambda < 1) return {lambda, squared(kappa), Mp(1)};
  return {1 / lambda, squared(kappa / lambda), 1 / lambda};
}

// I_l / I_g as printed in IellSadov, continued to lambda > 1.
Mp action_ratio(const Mp& kappa, const Mp& lambda) {
  const Shape w = shape(kappa, lambda);
  const Mp both = squared(kappa) + squared(lambda);
  return 2 * root(one_plus(kappa)) / (pi() * kappa * root(both)) *
         (both * w.scale * ellint_Pi(pi() / 2, w.characteristic, w.k) -
          squared(lambda) * w.scale * ellint_K(w.k));
}

// The amplitude of Sadov's formulas: z, or arcsin(lambda sin z) in the long-axis mode.
Mp amplitude(const Polhode& p, const Phase& a) {
  if (!p.long_axis) return angle(-c(a[0]) / root(one_plus(p.kappa)), s(a[0]));
  const Vec g = momentum_at(p, p.xi);
  return angle(-p.sign * g[1] / p.amplitude[1], g[2] / p.amplitude[2]);
}

// (phi_l, phi_g, phi_h, I_l, I_g, I_h)
Phase sadov(const Vec& moments, const Phase& a) {
  const Polhode p = polhode(moments, a);
  const Shape w = shape(p.kappa, p.lambda);
  const Mp sign = p.long_axis ? Mp(1) : p.sign, z = amplitude(p, a);
  const Mp K = ellint_K(w.k), F = ellint_F(z, w.k);
  const Mp swing =
      ellint_Pi(z, w.characteristic, w.k) - ellint_Pi(pi() / 2, w.characteristic, w.k) * F / K;
  return {pi() / 2 * F / K,
          a[1] + sign * w.scale / p.kappa * root(sum2(p) * one_plus(p.kappa)) * swing,
          a[2],
          sign * p.G * action_ratio(p.kappa, p.lambda),
          a[4],
          a[5]};
}

// L^2 of LSadov
Mp axial_squared(const Mp& G, const Mp& kappa, const Mp& lambda, const Mp& l) {
  const Mp k2 = squared(kappa), l2 = squared(lambda), q = squared(s(l));
  return squared(G) * k2 / (k2 + l2) * (1 - l2 + (k2 + l2) * q) / (1 + k2 * q);
}

// [SA "U2"] the line for the square of U': printed 2 alpha1^2, and alpha1 is the energy
TEST(PaperErrata, U2_AlphaNotSquared) {
  Gap printed, right;
  for (const AndoyerCase& e : andoyer_cases()) {
    const Mp &L = e.a[3], &G = e.a[4];
    const Mp T = kinetic(e.I, e.g_B), q = squared(s(e.a[0]));
    const Mp a = 1 / e.I[2] - 1 / e.I[1], b = 1 / e.I[0] - 1 / e.I[1];
    const Mp left = L * L * (a - b * q);
    printed.add(left, 2 * T * T - G * G / e.I[1] - G * G * b * q);
    right.add(left, 2 * T - G * G / e.I[1] - G * G * b * q);
  }
  EXPECT_GT(printed.size(), paper_misprint);
  EXPECT_LT(right.size(), paper_exact);
}

// [SA "abcd", "SerTointerm"] L = sign sqrt(I3 (a + b sin^2 l)/(c + d sin^2 l)); a > 0 only in the
// short-axis mode, and L has a sign of its own
TEST(PaperSadov, Abcd_MomentumAsFunctionOfAngle) {
  Gap gap;
  for (const AndoyerCase& e : branches(3)) {
    const Mp &I1 = e.I[0], &I2 = e.I[1], &I3 = e.I[2], &G = e.a[4];
    const Polhode p = polhode(e.I, e.a);
    const Mp a = I1 * (G * G - 2 * p.T * I2), b = (I2 - I1) * G * G;
    const Mp d = I1 * (I3 - I2), f = I3 * (I2 - I1);
    EXPECT_TRUE(b > 0 && d > 0 && f > 0 && (a > 0) == !p.long_axis);
    const Mp q = squared(s(e.a[0]));
    const Mp size = root(I3 * (a + b * q) / (d + f * q));
    gap.add(e.a[3], e.a[3] < 0 ? -size : size);
  }
  EXPECT_LT(gap.size(), paper_exact);
}

// [SA "HJ", "S", "Haminterm"] S = -T t + G g + H h + U(l) solves Jacobi's equation, and H = -dS/dt
// is T
TEST(PaperSadov, HJ_SeparatedSolution) {
  Gap jacobi_equation, energy;
  for (const AndoyerCase& e : andoyer_cases(false, 1, 2)) {
    const Polhode p = polhode(e.I, e.a);
    const auto S = [&](const Phase& x) {  // t, g, h, l
      const auto L = [&](const Mp& l) { return root(axial_squared(p.G, p.kappa, p.lambda, l)); };
      return -p.T * x[0] + p.G * x[1] + e.a[5] * x[2] + integral(L, pi() / 2, x[3]);
    };
    const Phase at{Mp("0.7"), e.a[1], e.a[2], e.a[0], Mp(0), Mp(0)}, d = gradient(S, at);
    const Mp spread = squared(s(e.a[0])) / e.I[0] + squared(c(e.a[0])) / e.I[1];
    jacobi_equation.add(
        spread * (squared(d[1]) - squared(d[3])) / 2 + squared(d[3]) / (2 * e.I[2]) + d[0], Mp(0));
    energy.add(-d[0], andoyer_energy(e.I, e.a));
  }
  EXPECT_LT(jacobi_equation.size(), paper_derivative);
  EXPECT_LT(energy.size(), paper_derivative);
}

// [SA "SerTointerm"] with U from l = pi/2, dU/dalpha1 and g + dU/dalpha2 are Serret's
// u/n and g_o
TEST(PaperSadov, SerTointerm_BetasAreSerretsConstants) {
  Gap time, node;
  for (const int sign : {1, -1}) {
    for (const AndoyerCase& e : andoyer_cases(false, sign, 2)) {
      const Polhode p = polhode(e.I, e.a);
      const auto U = [&](const Mp& T, const Mp& G) {
        return integral(
            [&](const Mp& l) {
              const Mp spread = s(l) * s(l) / e.I[0] + c(l) * c(l) / e.I[1];
              return sign * root((spread * G * G - 2 * T) / (spread - 1 / e.I[2]));
            },
            pi() / 2, e.a[0]);
      };
      // elapsed time and int cosJ dl since l = pi/2 on the branch of l in use
      const Mp turns = round((e.a[0] - pi() / 2 + p.sign * p.xi) / (2 * pi()));
      const Mp tau = (ellint_F(p.xi, p.k) - p.sign * turns * 4 * ellint_K(p.k)) / p.n;
      time.add(derivative([&](const Mp& T) { return U(T, p.G); }, p.T), tau);
      const Mp tilt = U(p.T, p.G) / p.G;
      node.add(derivative([&](const Mp& G) { return U(p.T, G); }, p.G), tilt - 2 * p.T / p.G * tau);
    }
  }
  EXPECT_LT(time.size(), paper_derivative);
  EXPECT_LT(node.size(), paper_derivative);
}

// [SA "SadovPar", "LSadov", "SadovH", "Haminterm, second form"] in both modes; lambda < 1 is the
// short-axis mode; lambda is the modulus of (A20)
TEST(PaperSadov, SadovPar_StateFunction) {
  Gap gap;
  for (const AndoyerCase& e : branches(3)) {
    const Polhode p = polhode(e.I, e.a);
    const Mp &I1 = e.I[0], &I2 = e.I[1], &I3 = e.I[2];
    const Mp kappa2 = I3 * (I2 - I1) / (I1 * (I3 - I2));
    gap.add(kappa2, squared(p.kappa));
    gap.add(squared(p.lambda),
            kappa2 * I1 / I3 * (2 * I3 * p.T - p.G * p.G) / (p.G * p.G - 2 * I1 * p.T));
    EXPECT_EQ(p.lambda<1, p.G * p.G> 2 * p.T * I2);
    gap.add(squared(e.a[3]), axial_squared(p.G, p.kappa, p.lambda, e.a[0]));
    gap.add(p.T, squared(p.G) / (2 * I1 * I3) * (I3 * squared(p.lambda) + I1 * kappa2) / sum2(p));
  }
  EXPECT_LT(gap.size(), paper_exact);
}

// [SA "changeAction"] l through z, and L = sign G kappa/sqrt(kappa^2 + lambda^2) sqrt(1 - lambda^2
// sin^2 z); around -b1 the sine and cosine of l both change sign
TEST(PaperSadov, ChangeAction_AngleThroughZ) {
  Gap gap;
  for (const AndoyerCase& e : branches(3)) {
    const Polhode p = polhode(e.I, e.a);
    const Mp lobe = p.long_axis ? p.sign : Mp(1), q = root(one_plus(p.kappa));
    const Mp z = angle(-lobe * c(e.a[0]) / q, lobe * s(e.a[0]));
    const Mp below = root(1 + squared(p.kappa * s(z)));
    gap.add(lobe * s(e.a[0]), c(z) / below);
    gap.add(lobe * c(e.a[0]), -q * s(z) / below);
    gap.add(magnitude(e.a[3]), p.G * p.kappa / root(sum2(p)) * root(1 - squared(p.lambda * s(z))));
  }
  EXPECT_LT(gap.size(), paper_exact);
}

// [SA "IellSadov", "actions"] against the loop integral of L dl. Pi(kappa^2, lambda) is Legendre's
// with 1 + kappa^2 sin^2 and modulus lambda; neither 1 - kappa^2 sin^2 nor parameter lambda will do
TEST(PaperSadov, IellSadov_ActionByQuadrature) {
  Gap gap, other_sign, other_modulus;
  for (const AndoyerCase& e : branches(2)) {
    const Polhode p = polhode(e.I, e.a);
    const Vec& A = p.amplitude;
    const Mp loop = integral(
        [&](const Mp& xi) {
          const Vec g = momentum_at(p, xi);
          const Mp fall = p.k * p.k * s(xi) * c(xi);
          const Mp d1 = p.long_axis ? -A[0] * A[0] * fall / g[0] : -A[0] * s(xi);
          const Mp d2 = p.sign * A[1] * c(xi);
          return -g[2] * (d1 * g[1] - g[0] * d2) / (squared(g[0]) + squared(g[1]));
        },
        Mp(0), 2 * pi());
    const Mp action = loop / (2 * pi());  // L > 0 where l increases
    gap.add(action, p.G * action_ratio(p.kappa, p.lambda));
    if (p.long_axis || p.kappa > Mp("0.95")) continue;
    const Mp front = 2 * p.G * root(one_plus(p.kappa)) / (pi() * p.kappa * root(sum2(p)));
    const auto other = [&](const Mp& n, const Mp& k) {
      return front * (sum2(p) * ellint_Pi(pi() / 2, n, k) - squared(p.lambda) * ellint_K(k));
    };
    other_sign.add(action, other(-squared(p.kappa), p.lambda));
    other_modulus.add(action, other(squared(p.kappa), root(p.lambda)));
  }
  EXPECT_LT(gap.size(), paper_quadrature);
  EXPECT_GT(other_sign.size(), paper_misprint);
  EXPECT_GT(other_modulus.size(), paper_misprint);
}

// [SA "IellSadov, range"] the range: I_l/I_g falls from 1 at lambda = 0 through (2/pi) arctan kappa
// at lambda = 1 towards 0
TEST(PaperSadov, IellSadov_Range) {
  Random random(17);
  for (int n = 0; n < 4; ++n) {
    const Mp kappa = random.number(0.3, 2.5);
    Gap ends;
    const Mp tiny("1e-14");
    const Mp first = root(one_plus(kappa)) / (2 * squared(kappa)) * squared(tiny);
    ends.add(action_ratio(kappa, tiny), 1 - first);
    ends.add(action_ratio(kappa, 1 / tiny), kappa * root(one_plus(kappa)) / 2 * squared(tiny));
    // on the separatrix the elliptic terms combine into an elementary integrand
    const Mp middle =
        integral([&](const Mp& z) { return squared(kappa) * c(z) / (1 + squared(kappa * s(z))); },
                 Mp(0), pi() / 2);
    ends.add(2 / (pi() * kappa) * middle, 2 / pi() * arctan(kappa));
    EXPECT_LT(ends.size(), paper_quadrature);
    Mp before = 1;
    for (const char* lambda : {"0.2", "0.5", "0.8", "0.95", "1.05", "1.4", "2", "4", "9"}) {
      const Mp now = action_ratio(kappa, Mp(lambda));
      EXPECT_TRUE(now < before && now > 0);
      before = now;
    }
  }
}

// [SA "dI_l/dlambda", "partialPhiU", "dlambda/dI_g"] for lambda > 1 the K stands
// for K(1/lambda)/lambda
TEST(PaperSadov, PartialPhiU_DerivativesOfLambda) {
  Gap slope, inverse, by_momentum;
  for (const AndoyerCase& e : branches(2)) {
    const Polhode p = polhode(e.I, e.a);
    const Shape w = shape(p.kappa, p.lambda);
    const Mp K = w.scale * ellint_K(w.k), kl = p.kappa * p.lambda, q = root(one_plus(p.kappa));
    const Mp cube = sum2(p) * root(sum2(p));
    const Mp by_lambda =
        derivative([&](const Mp& x) { return action_ratio(p.kappa, x); }, p.lambda);
    slope.add(by_lambda, -2 * kl * q / (pi() * cube) * K);
    inverse.add(1 / by_lambda, -pi() * cube / (2 * kl * q * K));
    const Mp ratio = action_ratio(p.kappa, p.lambda);  // I_l = ratio I_g
    const Mp first = ratio / p.G * pi() * cube / (2 * kl * q * K);
    const Mp Pi = w.scale * ellint_Pi(pi() / 2, w.characteristic, w.k);
    const Mp second =
        sum2(p) / (p.G * squared(p.kappa) * p.lambda * K) * (sum2(p) * Pi - squared(p.lambda) * K);
    by_momentum.add(first, -ratio / p.G / by_lambda);
    by_momentum.add(first, second);
  }
  EXPECT_LT(slope.size(), paper_derivative);
  EXPECT_LT(inverse.size(), paper_derivative);
  EXPECT_LT(by_momentum.size(), paper_derivative);
}

// [SA "dL/dlambda", "quad dL/dlambda"] for L > 0
TEST(PaperSadov, DerivativeOfMomentumByLambda) {
  Gap slope, quadrature;
  for (const AndoyerCase& e : andoyer_cases(false, 1, 4)) {
    const Polhode p = polhode(e.I, e.a);
    const Mp cube = sum2(p) * root(sum2(p));
    const auto printed = [&](const Mp& l) {
      const Mp q = squared(s(l));
      return -p.G * p.kappa * p.lambda * one_plus(p.kappa) / cube /
             (root(1 + squared(p.kappa) * q) * root(1 - squared(p.lambda) + sum2(p) * q));
    };
    const Mp& l = e.a[0];
    slope.add(
        derivative([&](const Mp& x) { return root(axial_squared(p.G, p.kappa, x, l)); }, p.lambda),
        printed(l));
    const Mp z = amplitude(p, e.a);
    const Mp end = pi() / 2 + z + turned(l - pi() / 2 - z);  // l next to pi/2 + z
    quadrature.add(
        integral(printed, pi() / 2, end),
        -p.G * p.kappa * p.lambda * root(one_plus(p.kappa)) / cube * ellint_F(z, p.lambda));
  }
  EXPECT_LT(slope.size(), paper_derivative);
  EXPECT_LT(quadrature.size(), paper_quadrature);
}

// [SA "quad L dl"] printed K(lambda) where the incomplete F(z, lambda) stands
TEST(PaperErrata, QuadratureLdl_IncompleteF) {
  Gap printed, right;
  for (const AndoyerCase& e : andoyer_cases(false, 1, 4)) {
    const Polhode p = polhode(e.I, e.a);
    const Mp z = amplitude(p, e.a);
    const Mp end = pi() / 2 + z + turned(e.a[0] - pi() / 2 - z);
    const Mp value = integral(
        [&](const Mp& l) { return root(axial_squared(p.G, p.kappa, p.lambda, l)); }, pi() / 2, end);
    const Mp front = p.G / p.kappa * root(one_plus(p.kappa) / sum2(p));
    const Mp third = sum2(p) * ellint_Pi(z, squared(p.kappa), p.lambda);
    printed.add(value, front * (third - squared(p.lambda) * ellint_K(p.lambda)));
    right.add(value, front * (third - squared(p.lambda) * ellint_F(z, p.lambda)));
  }
  EXPECT_GT(printed.size(), paper_misprint);
  EXPECT_LT(right.size(), paper_quadrature);
}

// [SA "transf. eqs", "V"] the angles are derivatives of W = I_g g + I_h h + V(l, I_l, I_g), with
// lambda as a function of I_l/I_g. The last one, dW/dI_h = h, is phi_h, printed phi_g
TEST(PaperErrata, Transformation_PhiHLabel) {
  Gap printed, right;
  for (const AndoyerCase& e : andoyer_cases(false, 1, 2)) {
    const Polhode p = polhode(e.I, e.a);
    const Phase Q = sadov(e.I, e.a);
    const Mp z = amplitude(p, e.a), end = pi() / 2 + z + turned(e.a[0] - pi() / 2 - z);
    const Mp slope = derivative([&](const Mp& x) { return action_ratio(p.kappa, x); }, p.lambda);
    const auto lambda_of = [&](const Mp& ratio) {
      Mp lambda = p.lambda;  // next to it
      for (int i = 0; i < 3; ++i) lambda -= (action_ratio(p.kappa, lambda) - ratio) / slope;
      return lambda;
    };
    const auto W = [&](const Phase& x) {  // I_l, I_g, I_h
      const Mp lambda = lambda_of(x[0] / x[1]);
      const auto L = [&](const Mp& l) { return root(axial_squared(x[1], p.kappa, lambda, l)); };
      return x[1] * e.a[1] + x[2] * e.a[2] + integral(L, pi() / 2, end);
    };
    const Phase d = gradient(W, {Q[3], Q[4], Q[5], Mp(0), Mp(0), Mp(0)});
    printed.add(d[2], Q[1]);
    right.add(Vec{d[0], d[1], d[2]}, Vec{Q[0], Q[1], Q[2]});
  }
  EXPECT_GT(printed.size(), paper_misprint);
  EXPECT_LT(right.size(), paper_derivative);
}

// [SA "phiSadovProv", "phiSadov"] the provisional form gives the final one
TEST(PaperSadov, PhiSadovProv_FinalForm) {
  Gap gap;
  for (const AndoyerCase& e : andoyer_cases(false, 1, 3)) {
    const Polhode p = polhode(e.I, e.a);
    const Phase Q = sadov(e.I, e.a);
    const Mp z = amplitude(p, e.a), end = pi() / 2 + z + turned(e.a[0] - pi() / 2 - z);
    const auto U = [&](const Mp& lambda) {
      return integral([&](const Mp& l) { return root(axial_squared(p.G, p.kappa, lambda, l)); },
                      pi() / 2, end);
    };
    const Mp by_lambda = derivative(U, p.lambda);
    const Mp slope =
        p.G * derivative([&](const Mp& x) { return action_ratio(p.kappa, x); }, p.lambda);
    gap.add(Q[0], by_lambda / slope);
    gap.add(Q[1], e.a[1] + U(p.lambda) / p.G - Q[3] / p.G / slope * by_lambda);
  }
  EXPECT_LT(gap.size(), paper_derivative);
}

// [SA "phiSadov", "ActioTransf"] canonical in all four branches; (phi, H) are the frequencies
// n_l = -sign pi n/(2K), n_g = G/I3 + G (1/I1 - 1/I3) Pi/K, and 2H = I_l n_l + I_g n_g
TEST(PaperSadov, PhiSadov_CanonicalWithFrequencies) {
  for (const AndoyerCase& e : branches(1)) {
    const auto rows = jacobian([&](const Phase& a) { return sadov(e.I, a); }, e.a);
    EXPECT_LT(symplectic_defect(rows), paper_derivative);
    const Phase dH = gradient([&](const Phase& a) { return andoyer_energy(e.I, a); }, e.a);
    const Polhode p = polhode(e.I, e.a);
    const Shape w = shape(p.kappa, p.lambda);
    const Mp sign = p.long_axis ? Mp(1) : p.sign, K = ellint_K(w.k);
    const Mp n_l = -sign * pi() * p.n / (2 * K);
    const Mp n_g = p.G / e.I[2] +
                   p.G * (1 / e.I[0] - 1 / e.I[2]) * ellint_Pi(pi() / 2, w.characteristic, w.k) / K;
    Gap rates;
    rates.add(bracket(rows[0], dH), n_l);
    rates.add(bracket(rows[1], dH), n_g);
    rates.add(bracket(rows[2], dH), Mp(0));
    const Phase Q = sadov(e.I, e.a);
    rates.add(2 * p.T, Q[3] * n_l + Q[4] * n_g);
    EXPECT_LT(rates.size(), paper_derivative);
  }
}

// [SA "phiSadov", (A35)] n_l and n_g through kappa and lambda, and their limits at the two ends
TEST(PaperSadov, PhiSadov_FrequencyLimits) {
  Gap limits;
  for (const AndoyerCase& e : branches(1)) {
    const Mp &I1 = e.I[0], &I2 = e.I[1], &I3 = e.I[2], &G = e.a[4];
    const Mp kappa = polhode(e.I, e.a).kappa, spread = 1 / I1 - 1 / I3;
    const auto n_l = [&](const Mp& lambda) {  // for L > 0
      const Shape w = shape(kappa, lambda);
      return -pi() * G * kappa * spread /
             (2 * root((squared(kappa) + squared(lambda)) * one_plus(kappa)) * w.scale *
              ellint_K(w.k));
    };
    const auto n_g = [&](const Mp& lambda) {
      const Shape w = shape(kappa, lambda);
      return G / I3 + G * spread * ellint_Pi(pi() / 2, w.characteristic, w.k) / ellint_K(w.k);
    };
    const Polhode p = polhode(e.I, e.a);
    const Mp K = ellint_K(p.k);
    limits.add(n_l(p.lambda), -pi() * p.n / (2 * K));
    const Mp tiny("1e-20");
    limits.add(n_l(tiny), -G * root(spread * (1 / I2 - 1 / I3)));
    limits.add(n_g(tiny) + n_l(tiny), G / I3);
    limits.add(n_l(1 / tiny), -G / I1 * root((I2 - I1) * (I3 - I1) / (I2 * I3)));
    limits.add(n_g(1 / tiny), G / I1);
  }
  EXPECT_LT(limits.size(), paper_quadrature);
}

// [SA "inversion"] z = am(2 phi_l K/pi), then g, l and L
TEST(PaperSadov, Inversion_RoundTrip) {
  Gap gap;
  for (const AndoyerCase& e : branches(2)) {
    const Polhode p = polhode(e.I, e.a);
    const Shape w = shape(p.kappa, p.lambda);
    const Phase Q = sadov(e.I, e.a);
    const Mp sign = p.long_axis ? Mp(1) : p.sign;
    const Jacobi j = jacobi(2 * Q[0] * ellint_K(w.k) / pi(), w.k);
    const Mp front = sign * w.scale / p.kappa * root(sum2(p) * one_plus(p.kappa));
    const Mp g = Q[1] + front * (2 / pi() * ellint_Pi(pi() / 2, w.characteristic, w.k) * Q[0] -
                                 ellint_Pi(j.am, w.characteristic, w.k));
    const Mp lobe = p.long_axis ? p.sign : Mp(1), q = root(one_plus(p.kappa));
    const Mp sz = p.long_axis ? j.sn / p.lambda : j.sn, cz = p.long_axis ? j.dn : j.cn;
    const Mp l = angle(lobe * cz, -lobe * q * sz);
    const Mp L = sign * p.G * p.kappa / root(sum2(p)) * (p.long_axis ? j.cn : j.dn);
    gap.add(turned(l - e.a[0]), Mp(0));
    gap.add(turned(g - e.a[1]), Mp(0));
    gap.add(L, e.a[3]);
  }
  EXPECT_LT(gap.size(), paper_quadrature);
}

// [SA "IellSadov"] the same action by Heuman's Lambda function, the form of Kinoshita's variables
TEST(PaperSadov, IellSadov_HeumanLambda) {
  Gap gap;
  for (const AndoyerCase& e : branches(2)) {
    const Polhode p = polhode(e.I, e.a);
    const Mp ratio = p.long_axis ? p.lambda / p.kappa : p.kappa / p.lambda;
    const Mp psi = arctan(ratio), k = p.k, kc = root(1 - k * k);
    const auto E = [](const Mp& x, const Mp& m) {
      return integral([&](const Mp& y) { return root(1 - squared(m * s(y))); }, Mp(0), x);
    };
    const Mp Lambda0 =
        2 / pi() *
        (E(pi() / 2, k) * ellint_F(psi, kc) + ellint_K(k) * (E(psi, kc) - ellint_F(psi, kc)));
    gap.add(action_ratio(p.kappa, p.lambda), p.long_axis ? 1 - Lambda0 : Lambda0);
  }
  EXPECT_LT(gap.size(), paper_quadrature);
}

// [SA "SadovPar", (A35)] the library's modulus, period and mean rates of precession:
// n_g for the short axis, n_g - pi n/(2K) for the long one
TEST(PaperSadov, LibraryFrequencies) {
  Gap modulus, rates;
  for (const AndoyerCase& e : branches(3)) {
    const RotorState s0 = hub_state(e);
    const Polhode p = polhode(e.I, andoyer_of_euler(exact_euler(s0)));
    const FreeRotation motion(body_of(e.I), s0);
    modulus.add(Mp(motion.modulus().m()), p.k * p.k);
    modulus.add(Mp(motion.modulus().m1()), 1 - p.k * p.k);
    const Shape w = shape(p.kappa, p.lambda);
    const Mp K = ellint_K(w.k);
    const Mp n_g = p.G / e.I[2] +
                   p.G * (1 / e.I[0] - 1 / e.I[2]) * ellint_Pi(pi() / 2, w.characteristic, w.k) / K;
    const Mp period = 4 * K / p.n;
    rates.add(Mp(motion.polhode_period()) / period, Mp(1));
    rates.add(Mp(motion.precession_rate_short()), n_g);
    rates.add(Mp(motion.precession_rate_long()), n_g - 2 * pi() / period);
  }
  EXPECT_LT(modulus.size(), budget::paper_library);
  EXPECT_LT(rates.size(), budget::free_attitude);
}

// [SA "IellSadov", "phiSadov", "quad L dl", "inversion"] the library's Sadov variables, its
// frequencies, and the way back to the hub
TEST(PaperSadov, LibrarySadovState) {
  Gap forth, frequencies, back;
  for (const AndoyerCase& e : branches(3)) {
    const RotorState s0 = hub_state(e);
    const Body body = body_of(e.I);
    const FreeRotation motion(body, s0);
    const Phase a = andoyer_of_euler(exact_euler(s0)), Q = sadov(e.I, a);
    const Polhode p = polhode(e.I, a);
    const auto compare = [](Gap& gap, const SadovState& s, const Phase& x) {
      gap.add(turned(Mp(s.phi_l) - x[0]), Mp(0));
      gap.add(turned(Mp(s.phi_g) - x[1]), Mp(0));
      gap.add(turned(Mp(s.phi_h) - x[2]), Mp(0));
      gap.add(Vec{Mp(s.I_l), Mp(s.I_g), Mp(s.I_h)}, Vec{x[3], x[4], x[5]});
    };
    const SadovState s = to_sadov(motion, 0.0);
    EXPECT_EQ(s.region == SadovRegion::long_axis, p.long_axis);
    EXPECT_EQ(Mp(s.lobe), p.long_axis ? p.sign : Mp(1));
    compare(forth, s, Q);
    const Shape w = shape(p.kappa, p.lambda);
    const Mp K = ellint_K(w.k), sign = p.long_axis ? Mp(1) : p.sign;
    const SadovFrequencies n = sadov_frequencies(motion);
    frequencies.add(Mp(n.n_l), -sign * pi() * p.n / (2 * K));
    frequencies.add(Mp(n.n_g), p.G / e.I[2] + p.G * (1 / e.I[0] - 1 / e.I[2]) *
                                                  ellint_Pi(pi() / 2, w.characteristic, w.k) / K);
    compare(back, s, sadov(e.I, andoyer_of_euler(exact_euler(to_rotor(body, s)))));
  }
  EXPECT_LT(forth.size(), budget::paper_library_adapted);
  EXPECT_LT(frequencies.size(), budget::paper_library);
  EXPECT_LT(back.size(), budget::paper_library_adapted);
}

}  // namespace
}  // namespace polhode::paper
