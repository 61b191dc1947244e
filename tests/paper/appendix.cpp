// SPDX-License-Identifier: MIT
// Appendix A.1 to A.3 of the paper: the spherical triangle, the elliptic solution, variations of S.
#include <gtest/gtest.h>

#include <array>
#include <cstddef>

#include "budgets.hpp"
#include "paper/support.hpp"

namespace polhode::paper {
namespace {

using budget::paper_derivative;
using budget::paper_exact;
using budget::paper_misprint;
using budget::paper_quadrature;

// The triangle between the three nodes: sides phi - h, psi - l, g.
struct Triangle {
  explicit Triangle(const AndoyerCase& e) : x(e.q[0] - e.a[2]), y(e.q[2] - e.a[0]), theta(e.q[1]) {}
  Mp x, y, theta;
};
Mp cos_g(const Mp& x, const Mp& y, const Mp& theta) { return c(x) * c(y) - s(x) * s(y) * c(theta); }

// Ordered moments, modulus and amplitude of (A15)-(A24), short-axis mode, sign of L = sign.
struct Ellipse {
  explicit Ellipse(const AndoyerCase& e)
      : P2(2 * kinetic(e.I, e.g_B) / squared(e.a[4])),
        a2((P2 - 1 / e.I[2]) / (1 / e.I[0] - 1 / e.I[2])),
        b2((P2 - 1 / e.I[2]) / (1 / e.I[1] - 1 / e.I[2])),
        kappa2((b2 - a2) / (1 - a2)) {}
  Mp P2, a2, b2, kappa2;
};

// cosJ > 0 as a function of l, T and G, from (A55).
Mp cos_J(const Vec& I, const Mp& l, const Mp& T, const Mp& G) {
  const Mp spread = squared(s(l)) / I[0] + squared(c(l)) / I[1] - 1 / I[2];
  return root(1 - (2 * T / squared(G) - 1 / I[2]) / spread);
}
// Time from l = pi/2 to l, by the rate of l.
Mp time_of_l(const Vec& I, const Mp& l, const Mp& T, const Mp& G) {
  return integral(
      [&](const Mp& x) {
        const Mp spread = squared(s(x)) / I[0] + squared(c(x)) / I[1] - 1 / I[2];
        return -1 / (G * cos_J(I, x, T, G) * spread);
      },
      pi() / 2, l);
}

// [SA (A1)]
TEST(PaperAppendix, A1_CosG) {
  Gap gap;
  for (const AndoyerCase& e : andoyer_cases()) {
    const Triangle k(e);
    gap.add(c(e.a[1]), cos_g(k.x, k.y, k.theta));
  }
  EXPECT_LT(gap.size(), paper_exact);
}

// [SA (A2)] each of the three coefficients of sin g dg differs from its printed form
TEST(PaperErrata, A2_DifferentialOfCosG) {
  Gap printed_x, printed_y, printed_theta, right;
  for (const AndoyerCase& e : andoyer_cases()) {
    const Triangle k(e);
    const Mp by_x = -derivative([&](const Mp& v) { return cos_g(v, k.y, k.theta); }, k.x);
    const Mp by_y = -derivative([&](const Mp& v) { return cos_g(k.x, v, k.theta); }, k.y);
    const Mp by_theta = -derivative([&](const Mp& v) { return cos_g(k.x, k.y, v); }, k.theta);
    const Mp ct = c(k.theta), st = s(k.theta);
    printed_x.add(by_x, s(k.x) * c(k.y) - s(k.x) * s(k.y) * ct);
    printed_y.add(by_y, c(k.x) * s(k.y) - s(k.x) * c(k.y) * ct);
    printed_theta.add(by_theta, s(e.q[0] - e.a[0]) * s(k.y) * st);  // phi - l, and +
    right.add(by_x, s(k.x) * c(k.y) + c(k.x) * s(k.y) * ct);
    right.add(by_y, c(k.x) * s(k.y) + s(k.x) * c(k.y) * ct);
    right.add(by_theta, -s(k.x) * s(k.y) * st);
  }
  EXPECT_GT(printed_x.size(), paper_misprint);
  EXPECT_GT(printed_y.size(), paper_misprint);
  EXPECT_GT(printed_theta.size(), paper_misprint);
  EXPECT_LT(right.size(), paper_derivative);
}

// [SA (A3)] the term in dtheta is negative in both lines
TEST(PaperErrata, A3_SignOfThetaTerm) {
  Gap printed1, printed2, right;
  Random random(3);
  for (const AndoyerCase& e : andoyer_cases()) {
    const Triangle k(e);
    const Phase d = direction(random);
    const Mp dx = rate(e, d, [](const AndoyerCase& z) { return z.q[0]; }) - d[2];
    const Mp dy = rate(e, d, [](const AndoyerCase& z) { return z.q[2]; }) - d[0];
    const Mp dtheta = rate(e, d, [](const AndoyerCase& z) { return z.q[1]; });
    const Mp sg = s(e.a[1]);
    const Mp turn = sg * c(e.incl) * dx + sg * c(e.J) * dy;
    const Mp line1 = s(k.x) * s(k.y) * s(k.theta) * dtheta, line2 = s(k.y) * s(e.J) * sg * dtheta;
    printed1.add(sg * d[1], turn + line1);
    printed2.add(sg * d[1], turn + line2);
    right.add(sg * d[1], turn - line1);
    right.add(sg * d[1], turn - line2);
  }
  EXPECT_GT(printed1.size(), paper_misprint);
  EXPECT_GT(printed2.size(), paper_misprint);
  EXPECT_LT(right.size(), paper_derivative);
}

// [SA (A4), (A5), (A6), (A7), (A8), (A9), (A10), (A11), (A12), (A13), (A14)]
TEST(PaperAppendix, A4_A14_DirectionCosines) {
  Gap gap;
  for (const AndoyerCase& e : andoyer_cases()) {
    const Mp &G = e.a[4], T2 = 2 * kinetic(e.I, e.g_B);
    const Vec omega = unscaled(e.I, e.g_B);
    const Vec cosines = (1 / G) * e.g_B;
    const Vec squares{squared(cosines[0]), squared(cosines[1]), squared(cosines[2])};
    gap.add(T2, dot(omega, scaled(e.I, omega)));
    gap.add(squared(G), dot(scaled(e.I, omega), scaled(e.I, omega)));
    const Mp P2 = squares[0] / e.I[0] + squares[1] / e.I[1] + squares[2] / e.I[2];
    gap.add(squared(G) * P2, T2);
    gap.add(squares[0] + squares[1] + squares[2], Mp(1));
    gap.add(P2 - 1 / e.I[2],
            (1 / e.I[0] - 1 / e.I[2]) * squares[0] + (1 / e.I[1] - 1 / e.I[2]) * squares[1]);
    gap.add(cosines, Vec{s(e.J) * s(e.a[0]), s(e.J) * c(e.a[0]), c(e.J)});
  }
  EXPECT_LT(gap.size(), paper_exact);
}

// [SA (A15), (A16), (A17), (A18), (A19), (A20), (A21), (A22), (A23), (A24)] the modulus is Sadov's
// lambda; (A24) with the sign of L, and the amplitude carries it too
TEST(PaperAppendix, A15_A24_EllipseAndModulus) {
  Gap gap;
  for (const int sign : {1, -1}) {
    for (const AndoyerCase& e : andoyer_cases(false, sign, 4)) {
      const Ellipse w(e);
      const Polhode p = polhode(e.I, e.a);
      const Vec cosines = (1 / e.a[4]) * e.g_B;
      gap.add(squared(cosines[0]) / w.a2 + squared(cosines[1]) / w.b2, Mp(1));
      gap.add(w.kappa2, squared(p.lambda));
      gap.add(squared(cosines[2]), (1 - w.a2) * (1 - w.kappa2 * squared(s(p.xi))));
      const Mp Delta = root(1 - w.kappa2 * squared(s(p.xi)));
      gap.add(cosines, Vec{root(w.a2) * c(p.xi), sign * root(w.b2) * s(p.xi),
                           sign * root(1 - w.a2) * Delta});
      EXPECT_TRUE(w.b2 < 1);
    }
  }
  for (const AndoyerCase& e : andoyer_cases(true, 1, 4)) {
    EXPECT_TRUE(Ellipse(e).b2 > 1);  // the long-axis mode needs the reciprocal modulus
    gap.add(Ellipse(e).kappa2, squared(polhode(e.I, e.a).lambda));
  }
  EXPECT_LT(gap.size(), paper_exact);
}

// [SA (A15), (A16), (A20)] the three distances that decide the regime, as sums of squares
TEST(PaperAppendix, A15_A20_DistancesWithoutCancellation) {
  Gap gap;
  for (const AndoyerCase& e : andoyer_cases()) {
    const Mp &I1 = e.I[0], &I2 = e.I[1], &I3 = e.I[2];
    const Mp g1 = squared(e.g_B[0]), g2 = squared(e.g_B[1]), g3 = squared(e.g_B[2]);
    const Mp G2 = squared(e.a[4]), T = kinetic(e.I, e.g_B);
    gap.add(G2 - 2 * T * I1, g2 * (I2 - I1) / I2 + g3 * (I3 - I1) / I3);
    gap.add(G2 - 2 * T * I2, g3 * (I3 - I2) / I3 - g1 * (I2 - I1) / I1);
    gap.add(2 * T * I3 - G2, g1 * (I3 - I1) / I1 + g2 * (I3 - I2) / I2);
  }
  EXPECT_LT(gap.size(), paper_exact);
}

// [SA (A25), (A26), (A27), (A28), (A29), (A30)] by the flow in Andoyer's variables
TEST(PaperAppendix, A25_A30_EulerEquations) {
  Gap gap;
  for (const AndoyerCase& e : andoyer_cases()) {
    const Phase dH = gradient([&](const Phase& a) { return andoyer_energy(e.I, a); }, e.a);
    const Vec w = unscaled(e.I, e.g_B), k = (1 / e.a[4]) * e.g_B;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, m = (i + 2) % 3;
      const Mp flow =
          bracket(gradient([&](const Phase& a) { return andoyer_case(e.I, a).g_B[i]; }, e.a), dH);
      gap.add(flow, w[j] * w[m] * (e.I[j] - e.I[m]));
      gap.add(flow / e.a[4], e.a[4] * k[j] * k[m] * (1 / e.I[m] - 1 / e.I[j]));
    }
  }
  EXPECT_LT(gap.size(), paper_derivative);
}

// [SA (A33), (A34), (A35), (A36), (A37), (A38), (A39)] dxi/dt = n Delta
TEST(PaperAppendix, A33_A39_RateOfAmplitude) {
  Gap rate_gap, n_gap;
  for (const int sign : {1, -1}) {
    for (const AndoyerCase& e : andoyer_cases(false, sign, 3)) {
      const Ellipse w(e);
      const Mp G = e.a[4], split = 1 / e.I[1] - 1 / e.I[2];
      const Polhode p = polhode(e.I, e.a);
      const Mp n = G * root((1 / e.I[0] - w.P2) * split);
      n_gap.add(n, root(w.b2 / w.a2) * root(1 - w.a2) * split * G);
      n_gap.add(n, p.n);
      const Field xi = [&](const Phase& a) { return polhode(e.I, a).xi; };
      const Field energy = [&](const Phase& a) { return andoyer_energy(e.I, a); };
      rate_gap.add(bracket(xi, energy, e.a), n * root(1 - w.kappa2 * squared(s(p.xi))));
    }
  }
  EXPECT_LT(n_gap.size(), paper_exact);
  EXPECT_LT(rate_gap.size(), paper_derivative);
}

// [SA (A40), (A41), (A42), (A43)] the second argument is the modulus
TEST(PaperAppendix, A40_A43_JacobiFunctions) {
  Gap gap;
  for (const AndoyerCase& e : andoyer_cases(false, 1, 4)) {
    const Polhode p = polhode(e.I, e.a);
    const Jacobi j = jacobi(ellint_F(p.xi, p.k), p.k);
    gap.add(j.am, p.xi);
    gap.add(Vec{j.sn, j.cn, j.dn}, Vec{s(p.xi), c(p.xi), root(1 - p.k * p.k * squared(s(p.xi)))});
  }
  EXPECT_LT(gap.size(), paper_quadrature);
}

// [SA (A44), (A45)]
TEST(PaperAppendix, A44_A45_CosI) {
  Gap gap;
  for (const AndoyerCase& e : andoyer_cases(false, 1, 6)) {
    const Polhode p = polhode(e.I, e.a);
    const Ellipse w(e);
    const Mp lean = s(e.J) * c(e.q[2] - e.a[0]);
    gap.add(c(e.incl), c(e.q[1]) * c(e.J) + s(e.q[1]) * lean);
    gap.add(lean, root(w.a2) * s(e.q[2]) * c(p.xi) + root(w.b2) * c(e.q[2]) * s(p.xi));
  }
  EXPECT_LT(gap.size(), paper_exact);
}

// [SA (A46)] sin theta lost in the last term
TEST(PaperErrata, A46_SinThetaInLastTerm) {
  Gap printed, right;
  for (const AndoyerCase& e : andoyer_cases(false, 1, 6)) {
    const Polhode p = polhode(e.I, e.a);
    const Ellipse w(e);
    const Mp Delta = root(1 - w.kappa2 * squared(s(p.xi)));
    const Mp first =
        c(e.q[1]) * root(1 - w.a2) * Delta + root(w.a2) * s(e.q[1]) * s(e.q[2]) * c(p.xi);
    const Mp last = root(w.b2) * c(e.q[2]) * s(p.xi);
    printed.add(c(e.incl), first + last);
    right.add(c(e.incl), first + s(e.q[1]) * last);
  }
  EXPECT_GT(printed.size(), paper_misprint);
  EXPECT_LT(right.size(), paper_exact);
}

// What the variations of S need: a state, a direction in (l, g, h, T, G, H), the terms of dS.
struct Variation {
  Vec I;
  Mp l, T, G, t;  // the state, short-axis mode with L > 0
  Mp dl, dg, dh, dT, dG, dH;
  Mp g, h, H;
  Mp cosJ, tilt, dtilt;  // cosJ, int cosJ dl, int delta(cosJ) dl at fixed l
  Mp elapsed;            // u/n
};
std::vector<Variation> variations() {
  Random random(51);
  std::vector<Variation> all;
  for (const AndoyerCase& e : andoyer_cases(false, 1, 4)) {
    Variation v;
    v.I = e.I;
    v.l = e.a[0];
    v.g = e.a[1];
    v.h = e.a[2];
    v.T = kinetic(e.I, e.g_B);
    v.G = e.a[4];
    v.H = e.a[5];
    v.t = random.number(-2, 2);
    for (Mp* x : {&v.dl, &v.dg, &v.dh, &v.dT, &v.dG, &v.dH}) *x = random.number(-0.5, 0.5);
    v.cosJ = cos_J(v.I, v.l, v.T, v.G);
    v.tilt = integral([&](const Mp& x) { return cos_J(v.I, x, v.T, v.G); }, pi() / 2, v.l);
    v.dtilt = derivative(
        [&](const Mp& x) {
          return integral(
              [&](const Mp& y) { return cos_J(v.I, y, v.T + x * v.dT, v.G + x * v.dG); }, pi() / 2,
              v.l);
        },
        Mp(0));
    v.elapsed = time_of_l(v.I, v.l, v.T, v.G);
    all.push_back(v);
  }
  return all;
}
// The variation of S of (51), (A47), all six quantities moving.
Mp total_variation(const Variation& v) {
  return derivative(
      [&](const Mp& x) {
        const Mp T = v.T + x * v.dT, G = v.G + x * v.dG;
        return -v.t * T + (v.H + x * v.dH) * (v.h + x * v.dh) + G * (v.g + x * v.dg) +
               G * integral([&](const Mp& y) { return cos_J(v.I, y, T, G); }, pi() / 2,
                            v.l + x * v.dl);
      },
      Mp(0));
}

// [SA (A47), (A48), (A51)] with delta(cosJ) at fixed l the upper limit adds G cosJ delta l
TEST(PaperErrata, A51_UpperLimitOfIntegral) {
  Gap printed, right;
  for (const Variation& v : variations()) {
    const Mp sum =
        -v.t * v.dT + v.H * v.dh + v.h * v.dH + (v.g + v.tilt) * v.dG + v.G * v.dg + v.G * v.dtilt;
    printed.add(total_variation(v), sum);
    right.add(total_variation(v), sum + v.G * v.cosJ * v.dl);
  }
  EXPECT_GT(printed.size(), paper_misprint);
  EXPECT_LT(right.size(), paper_derivative);
}

// [SA (A53)] at fixed orientation of the body G dg = -G cosJ dl - G cosI dh
TEST(PaperAppendix, A53_FixedOrientation) {
  Gap gap;
  Random random(53);
  for (std::size_t n = 0; n < 4; ++n) {
    const AndoyerCase& e = andoyer_cases()[n];
    const Vec dp{Mp(random.number(-1, 1)), Mp(random.number(-1, 1)), Mp(random.number(-1, 1))};
    const auto change = [&](std::size_t i) {
      return derivative(
          [&](const Mp& t) {
            return andoyer_of_euler({e.q[0], e.q[1], e.q[2], e.p[0] + t * dp[0], e.p[1] + t * dp[1],
                                     e.p[2] + t * dp[2]})[i];
          },
          Mp(0));
    };
    gap.add(change(1), -c(e.J) * change(0) - c(e.incl) * change(2));
  }
  EXPECT_LT(gap.size(), paper_derivative);
}

// [SA (A54)] the compensating term -G cosJ delta l does not belong there: with dg from (A53) the
// variation of S has no term in delta l left
TEST(PaperErrata, A54_NoTermInDeltaL) {
  Gap printed, right;
  for (Variation v : variations()) {
    v.dg = -v.cosJ * v.dl - v.H / v.G * v.dh;  // (A53)
    const Mp sum = -v.t * v.dT + v.h * v.dH + (v.g + v.tilt) * v.dG + v.G * v.dtilt;
    printed.add(total_variation(v), sum - v.G * v.cosJ * v.dl);
    right.add(total_variation(v), sum);
  }
  EXPECT_GT(printed.size(), paper_misprint);
  EXPECT_LT(right.size(), paper_derivative);
}

// [SA "Binet", (A55), (A64)] the Binet ellipsoid in J and l, and its variation: (dT - 2T dG/G) dt =
// G delta(cosJ) dl - G d(cosJ) delta l
TEST(PaperAppendix, A55_A64_BinetAndItsVariation) {
  Gap binet, variation;
  Random random(64);
  for (const AndoyerCase& e : andoyer_cases()) {
    const Mp &l = e.a[0], &G = e.a[4], T = kinetic(e.I, e.g_B);
    const Mp spread = squared(s(l)) / e.I[0] + squared(c(l)) / e.I[1];
    binet.add(squared(s(e.J)) * (spread - 1 / e.I[2]), 2 * T / squared(G) - 1 / e.I[2]);
    const Phase d = direction(random);
    const Mp dT = rate(e, d, [](const AndoyerCase& x) { return kinetic(x.I, x.g_B); });
    const Mp delta_cosJ = rate(e, d, [](const AndoyerCase& x) { return c(x.J); });
    const Phase dH = gradient([&](const Phase& a) { return andoyer_energy(e.I, a); }, e.a);
    const Mp& l_rate = dH[3];  // per unit of t
    const Mp cosJ_rate = -dH[0] / G;
    variation.add(dT - 2 * T * d[4] / G, G * delta_cosJ * l_rate - G * cosJ_rate * d[0]);
  }
  EXPECT_LT(binet.size(), paper_exact);
  EXPECT_LT(variation.size(), paper_derivative);
}

// [SA (A56), (A57), (A58), (A59), (A60), (A61), (A62), (A63)] the steps from (A55) to (A64), per
// dt: delta is any variation, the rates are those of free rotation
TEST(PaperAppendix, A56_A63_StepsOfTheVariation) {
  Gap variation, rates, first_term;
  Random random(63);
  for (const AndoyerCase& e : andoyer_cases()) {
    const Mp &l = e.a[0], &G = e.a[4], T = kinetic(e.I, e.g_B);
    const Vec k = (1 / G) * e.g_B;
    const Mp split = 1 / e.I[0] - 1 / e.I[1], rest = 1 - squared(k[2]);
    const Mp spread = squared(s(l)) / e.I[0] + squared(c(l)) / e.I[1] - 1 / e.I[2];
    const Phase d = direction(random);
    const Mp dT = rate(e, d, [](const AndoyerCase& x) { return kinetic(x.I, x.g_B); });
    const Mp dk3 = rate(e, d, [](const AndoyerCase& x) { return x.g_B[2] / x.a[4]; });
    variation.add(2 * dT / squared(G) - 4 * T * d[4] / (G * G * G),
                  -2 * k[2] * dk3 * spread + 2 * k[0] * k[1] * split * d[0]);
    const Mp bracketed = squared(c(l)) * -split + (1 / e.I[0] - 1 / e.I[2]);
    const Mp term = -squared(G) * k[2] * dk3 * bracketed;
    variation.add(dT - 2 * T * d[4] / G, term + squared(G) * k[0] * k[1] * split * d[0]);
    const Phase dH = gradient([&](const Phase& a) { return andoyer_energy(e.I, a); }, e.a);
    const auto flow = [&](std::size_t i) {
      const auto cosine = [&](const Phase& a) { return andoyer_case(e.I, a).g_B[i] / a[4]; };
      return bracket(gradient(cosine, e.a), dH);
    };
    const Mp rate2 = flow(1), rate3 = flow(2);
    rates.add(G * k[0] * k[1] * split, -rate3);
    rates.add(squared(G) * k[0] * k[1] * split * d[0], -G * rate3 * d[0]);
    rates.add(squared(c(l)), squared(k[1]) / (squared(k[0]) + squared(k[1])));
    rates.add(squared(c(l)), squared(k[1]) / rest);
    rates.add(rate2, -k[2] * k[1] * rate3 / rest - k[0] * dH[3]);
    first_term.add(term, -G * dk3 * (k[1] * k[2] * rate3 + rest * rate2) / (k[0] * rest));
    first_term.add(term, G * dk3 * dH[3]);
  }
  EXPECT_LT(variation.size(), paper_derivative);
  EXPECT_LT(rates.size(), paper_derivative);
  EXPECT_LT(first_term.size(), paper_derivative);
}

// [SA (A65)] at fixed l the integral of delta(cosJ) is (dT - 2T dG/G) u/n; the printed G cosJ delta
// l belongs to the total variation
TEST(PaperErrata, A65_IntegralAtFixedL) {
  Gap printed, right;
  for (const Variation& v : variations()) {
    const Mp value = (v.dT - 2 * v.T * v.dG / v.G) * v.elapsed;
    printed.add(v.G * v.dtilt, value + v.G * v.cosJ * v.dl);
    right.add(v.G * v.dtilt, value);
  }
  EXPECT_GT(printed.size(), paper_misprint);
  EXPECT_LT(right.size(), paper_derivative);
}

// [SA (A66)] the slips of (A51), (A54) and (A65) cancel
TEST(PaperAppendix, A66_FinalVariation) {
  Gap gap;
  for (Variation v : variations()) {
    v.dg = -v.cosJ * v.dl - v.H / v.G * v.dh;
    gap.add(total_variation(v), (v.elapsed - v.t) * v.dT + v.h * v.dH +
                                    (v.g + v.tilt - 2 * v.T / v.G * v.elapsed) * v.dG);
  }
  EXPECT_LT(gap.size(), paper_derivative);
}

}  // namespace
}  // namespace polhode::paper
