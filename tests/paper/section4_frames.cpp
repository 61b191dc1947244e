// SPDX-License-Identifier: MIT
// Section 4 of the paper: its misprints, and the momenta and Hamiltonian in a precessing frame.
#include <gtest/gtest.h>

#include <cstddef>

#include "budgets.hpp"
#include "paper/support.hpp"

namespace polhode::paper {
namespace {

using budget::paper_derivative;
using budget::paper_exact;
using budget::paper_misprint;

Vec random_rate(Random& random) {
  return {Mp(random.number(-1, 1)), Mp(random.number(-1, 1)), Mp(random.number(-1, 1))};
}

// Momenta of a body whose axes turn at omega relative to a frame that itself turns at mu (body
// components of both): derivatives of T = (1/2) sum I_i (omega_i + mu_i)^2 by the Euler rates.
Vec momenta(const EulerCase& e, const Vec& mu) {
  Vec p;
  for (std::size_t i = 0; i < 3; ++i) {
    p[i] = derivative(
        [&](const Mp& v) {
          Vec rates = e.rates;
          rates[i] = v;
          return kinetic(e.I, scaled(e.I, body_rate(e.q, rates) + mu));
        },
        e.rates[i]);
  }
  return p;
}

// [SA (96)] footnote: with the mean anomaly in place of its initial value, Delaunay's Hamiltonian
// gets mu^2/(2 L^2), printed mu^2/(2L); mu is the gravitational parameter
TEST(PaperErrata, Eq96_DelaunayFootnote) {
  Gap printed, right;
  Random random(96);
  for (int i = 0; i < 8; ++i) {
    const Mp mu = random.number(0.5, 2), a = random.number(0.6, 3), ecc = random.number(0, 0.9);
    const Mp near = a * (1 - ecc), speed2 = mu * (1 + ecc) / near;
    const Mp energy = speed2 / 2 - mu / near, L = root(mu * a);
    printed.add(energy, -mu * mu / (2 * L));
    right.add(energy, -mu * mu / (2 * L * L));
  }
  EXPECT_GT(printed.size(), paper_misprint);
  EXPECT_LT(right.size(), paper_exact);
}

// [SA (112), (113)]
TEST(PaperFrames, Eq112_Eq113_PhiMomentum) {
  Gap gap;
  Random random(113);
  for (const EulerCase& e : euler_cases()) {
    const Vec mu = random_rate(random), g = scaled(e.I, e.omega + mu);
    gap.add(momenta(e, mu)[0],
            g[0] * s(e.q[1]) * s(e.q[2]) + g[1] * s(e.q[1]) * c(e.q[2]) + g[2] * c(e.q[1]));
  }
  EXPECT_LT(gap.size(), paper_derivative);
}

// [SA (114), (115)] the two right-hand sides are swapped in print
TEST(PaperErrata, Eq114_Eq115_SwappedMomenta) {
  Gap printed_theta, printed_psi, right;
  Random random(114);
  for (const EulerCase& e : euler_cases()) {
    const Vec mu = random_rate(random), g = scaled(e.I, e.omega + mu), p = momenta(e, mu);
    const Mp cross_axis = g[0] * c(e.q[2]) - g[1] * s(e.q[2]);
    printed_theta.add(p[1], g[2]);
    printed_psi.add(p[2], cross_axis);
    right.add(p[1], cross_axis);
    right.add(p[2], g[2]);
  }
  EXPECT_GT(printed_theta.size(), paper_misprint);
  EXPECT_GT(printed_psi.size(), paper_misprint);
  EXPECT_LT(right.size(), paper_derivative);
}

// [SA (116), (117), (118)] H = T + DeltaH, DeltaH = -mu.g, also in Andoyer's l, L, G with mu_i body
// components
TEST(PaperFrames, Eq116_Eq118_FrameHamiltonian) {
  Gap legendre, printed, andoyer;
  Random random(118);
  for (const EulerCase& e : euler_cases()) {
    const Vec mu = random_rate(random), g = scaled(e.I, e.omega + mu);
    const Vec p = euler_momenta(e.q, g);
    const Mp drag = dot(mu, g);
    legendre.add(dot(p, e.rates) - kinetic(e.I, g), kinetic(e.I, g) - drag);
    const Mp lean = (p[0] - p[2] * c(e.q[1])) / s(e.q[1]), sp = s(e.q[2]), cp = c(e.q[2]);
    printed.add(-drag,
                -mu[0] * (sp * lean + p[1] * cp) - mu[1] * (cp * lean - p[1] * sp) - mu[2] * p[2]);
    const Phase a = andoyer_of_euler({e.q[0], e.q[1], e.q[2], p[0], p[1], p[2]});
    const Mp side = root(a[4] * a[4] - a[3] * a[3]);
    andoyer.add(-drag, -mu[0] * side * s(a[0]) - mu[1] * side * c(a[0]) - mu[2] * a[3]);
  }
  EXPECT_LT(legendre.size(), paper_exact);
  EXPECT_LT(printed.size(), paper_exact);
  EXPECT_LT(andoyer.size(), paper_exact);
}

// [SA (119), (120), (121), (122), (123), (124)] convective terms; the rates of the unperturbed
// expressions give the inertial angular velocity
TEST(PaperFrames, Eq119_Eq124_ConvectiveTerms) {
  Gap terms, velocity;
  Random random(124);
  for (const EulerCase& e : euler_cases()) {
    const Vec mu = random_rate(random), g = scaled(e.I, e.omega + mu);
    const Vec p = euler_momenta(e.q, g);
    const Phase x{e.q[0], e.q[1], e.q[2], p[0], p[1], p[2]};
    const Phase d = gradient([&](const Phase& y) { return -dot(mu, euler_body_momentum(y)); }, x);
    const Mp st = s(e.q[1]), sp = s(e.q[2]), cp = c(e.q[2]);
    terms.add(Vec{d[3], d[4], d[5]}, Vec{-(mu[0] * sp + mu[1] * cp) / st, -mu[0] * cp + mu[1] * sp,
                                         (mu[0] * sp + mu[1] * cp) * c(e.q[1]) / st - mu[2]});
    const Phase dT = gradient([&](const Phase& y) { return euler_energy(e.I, y); }, x);
    velocity.add(body_rate(e.q, {dT[3], dT[4], dT[5]}), e.omega + mu);
  }
  EXPECT_LT(terms.size(), paper_derivative);
  EXPECT_LT(velocity.size(), paper_derivative);
}

// [SA (4448)] third line of the summary: the convective term carries -mu, printed +mu
TEST(PaperErrata, Eq4448_ConvectiveSign) {
  Gap printed, right;
  Random random(4448);
  for (const EulerCase& e : euler_cases()) {
    const Vec mu = random_rate(random);
    const Phase x{e.q[0], e.q[1], e.q[2], e.p[0], e.p[1], e.p[2]};
    const Phase d = gradient([&](const Phase& y) { return -dot(mu, euler_body_momentum(y)); }, x);
    const Vec convective = body_rate(e.q, {d[3], d[4], d[5]});
    printed.add(convective, mu);
    right.add(convective, Mp(-1) * mu);
  }
  EXPECT_GT(printed.size(), paper_misprint);
  EXPECT_LT(right.size(), paper_derivative);
}

// [SA (118)] mu_i are body components: they move with the angles. The momentum seen from the frame
// then obeys dG/dt + mu x G = 0; with mu_i held fixed it does not.
TEST(PaperFrames, Eq118_BodyComponentsAreDifferentiated) {
  Gap right, held;
  Random random(1180);
  for (std::size_t n = 0; n < 4; ++n) {
    const AndoyerCase& e = andoyer_cases()[n];
    const Vec mu_S = random_rate(random), mu_B = e.R * mu_S;
    const auto momentum = [&](const Phase& a) { return andoyer_case(e.I, a).G_vec; };
    const auto term = [&](bool follow) {
      return gradient(
          [&](const Phase& a) {
            const AndoyerCase x = andoyer_case(e.I, a);
            return andoyer_energy(e.I, a) - dot(follow ? x.R * mu_S : mu_B, x.g_B);
          },
          e.a);
    };
    Vec rate, rate_held;
    for (std::size_t i = 0; i < 3; ++i) {
      const Phase dG = gradient([&](const Phase& a) { return momentum(a)[i]; }, e.a);
      rate[i] = bracket(dG, term(true));
      rate_held[i] = bracket(dG, term(false));
    }
    const Vec turning = cross(mu_S, e.G_vec);
    right.add(rate + turning, Vec{});
    held.add(rate_held + turning, Vec{});
  }
  EXPECT_LT(right.size(), paper_derivative);
  EXPECT_GT(held.size(), paper_misprint);
}

}  // namespace
}  // namespace polhode::paper
