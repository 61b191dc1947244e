// SPDX-License-Identifier: MIT
// Section 5 of the paper in the library: L as a function of l, the energy, actions by quadrature,
// frequencies, and the brackets of Sadov's variables.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "budgets.hpp"
#include "paper/library.hpp"
#include "paper/support.hpp"
#include "polhode/free/free_rotation.hpp"
#include "polhode/free/sadov.hpp"
#include "polhode/free/serret.hpp"
#include "polhode/system/canonical_rates.hpp"

namespace polhode::paper {
namespace {

// A free motion, and Sadov's kappa^2 and lambda^2 by its modulus.
struct SadovMotion {
  explicit SadovMotion(const AndoyerCase& e)
      : start(hub_state(e)),
        body(body_of(e.I)),
        motion(body, start),
        kappa2(e.I[2] * (e.I[1] - e.I[0]) / (e.I[0] * (e.I[2] - e.I[1]))),
        lambda2(motion.circulates_long_axis() ? 1 / Mp(motion.modulus().m())
                                              : Mp(motion.modulus().m())),
        G(motion.momentum()),
        T(motion.energy()) {}
  RotorState start;
  Body body;
  FreeRotation motion;
  Mp kappa2, lambda2, G, T;
};

// [SA "U2", "abcd", "SerTointerm", "LSadov", "changeAction"] along a motion, from its energy and
// its momentum, and from its modulus
TEST(PaperSadov, LibraryMomentumAsFunctionOfTheAngle) {
  Gap by_energy, by_modulus, by_z;
  for (const AndoyerCase& e : branches(3)) {
    const SadovMotion k(e);
    const Mp &I1 = e.I[0], &I2 = e.I[1], &I3 = e.I[2], G2 = k.G * k.G;
    for (const double t : {0.0, 0.9, -2.3, 4.1}) {
      const Phase a = exact(to_andoyer(k.motion.at(t)));
      const Mp q = squared(s(a[0])), L2 = squared(a[3]);
      by_energy.add(L2 * (1 / I3 - 1 / I2 - (1 / I1 - 1 / I2) * q),
                    2 * k.T - G2 / I2 - G2 * (1 / I1 - 1 / I2) * q);
      by_energy.add(L2, I3 * (I1 * (G2 - 2 * k.T * I2) + (I2 - I1) * G2 * q) /
                            (I1 * (I3 - I2) + I3 * (I2 - I1) * q));
      const Mp sum = k.kappa2 + k.lambda2;
      by_modulus.add(L2, G2 * k.kappa2 / sum * (1 - k.lambda2 + sum * q) / (1 + k.kappa2 * q));
      // sin^2 z of the angle z
      const Mp z2 = (1 - q) / (1 + k.kappa2 * q);
      by_z.add(q * (1 + k.kappa2 * z2), 1 - z2);
      by_z.add(L2, G2 * k.kappa2 / sum * (1 - k.lambda2 * z2));
    }
  }
  EXPECT_LT(by_energy.size(), budget::paper_library);
  EXPECT_LT(by_modulus.size(), budget::paper_library);
  EXPECT_LT(by_z.size(), budget::paper_library);
}

// [SA "Haminterm", "Haminterm, second form", "SadovH", "SadovPar"]
TEST(PaperSadov, LibraryEnergyByTheModulus) {
  Gap constant, modulus, energy;
  for (const AndoyerCase& e : branches(3)) {
    const SadovMotion k(e);
    constant.add(Mp(to_serret(k.motion, 0.5).T), kinetic(e.I, exact(k.motion.at(0.5).g)));
    const Mp &I1 = e.I[0], &I3 = e.I[2], T = kinetic(e.I, exact(k.start.g));
    const Mp G2 = dot(exact(k.start.g), exact(k.start.g));
    modulus.add(k.lambda2 * I3 * (G2 - 2 * I1 * T), k.kappa2 * I1 * (2 * I3 * T - G2));
    energy.add(k.T, squared(k.G) / (2 * I1 * I3) * (I3 * k.lambda2 + I1 * k.kappa2) /
                        (k.kappa2 + k.lambda2));
  }
  EXPECT_LT(constant.size(), budget::paper_library);
  EXPECT_LT(modulus.size(), budget::paper_library);
  EXPECT_LT(energy.size(), budget::paper_library);
}

// [SA "actions", "IellSadov", "IellSadov, lambda > 1"] the loop integral of L dl over a period, by
// the rates of Andoyer's variables
TEST(PaperSadov, LibraryActionByQuadrature) {
  Gap gap;
  constexpr int nodes = 400;
  for (const AndoyerCase& e : branches(3)) {
    const SadovMotion k(e);
    Mp loop = 0;
    for (int n = 0; n < nodes; ++n) {
      const double t = k.motion.polhode_period() * n / nodes;
      const RotorState at = k.motion.at(t);
      loop += Mp(at.g.z) * Mp(rates::andoyer_rates(System(k.body), t, at).l);
    }
    loop *= Mp(k.motion.polhode_period()) / nodes;
    // l falls where L > 0; the action has the sign of L around b3, -b3
    const SadovState found = to_sadov(k.motion, 0.0);
    const bool falls = k.motion.circulates_long_axis() || k.start.g.z > 0.0;
    gap.add(Mp(found.I_l), (falls ? -1 : 1) * loop / (2 * pi()));
    gap.add(Mp(found.I_g), length(exact(k.start.g)));
    gap.add(Mp(found.I_h), exact(inertial_momentum(k.start))[2]);
  }
  EXPECT_LT(gap.size(), budget::paper_library);
}

// [SA "Hamilton" in section 5, "transf. eqs", "phiSadov"] the angles move at dT/dI, and phi_h = h
TEST(PaperSadov, LibraryAnglesMoveAtTheFrequencies) {
  Gap angles, node, slopes, sum;
  constexpr std::array<double, 4> weights{672.0 / 840, -168.0 / 840, 32.0 / 840, -3.0 / 840};
  for (const AndoyerCase& e : branches(3)) {
    const SadovMotion k(e);
    const SadovFrequencies n = sadov_frequencies(k.motion);
    const SadovState start = to_sadov(k.motion, 0.0);
    for (const double t : {0.7, -2.0, 5.0}) {
      const SadovState later = to_sadov(k.motion, t);
      angles.add(turned(Mp(later.phi_l) - Mp(start.phi_l) - Mp(n.n_l) * Mp(t)), Mp(0));
      angles.add(turned(Mp(later.phi_g) - Mp(start.phi_g) - Mp(n.n_g) * Mp(t)), Mp(0));
      node.add(turned(Mp(later.phi_h) - exact(to_andoyer(k.motion.at(t)))[2]), Mp(0));
    }
    const auto energy_at = [&](double by_l, double by_g) {
      SadovState moved = start;
      moved.I_l += by_l;
      moved.I_g += by_g;
      return Mp(kinetic_energy(k.body, to_rotor(k.body, moved)));
    };
    const double h = 5e-4 * start.I_g;
    Mp by_l = 0, by_g = 0;
    for (int i = 1; i <= 4; ++i) {
      const Mp w = weights[static_cast<std::size_t>(i - 1)] / h;
      by_l += w * (energy_at(i * h, 0.0) - energy_at(-i * h, 0.0));
      by_g += w * (energy_at(0.0, i * h) - energy_at(0.0, -i * h));
    }
    slopes.add(by_l, Mp(n.n_l));
    slopes.add(by_g, Mp(n.n_g));
    sum.add(2 * k.T, Mp(start.I_l) * n.n_l + Mp(start.I_g) * n.n_g);
  }
  EXPECT_LT(angles.size(), budget::paper_library_adapted);
  EXPECT_LT(node.size(), budget::paper_library_adapted);
  EXPECT_LT(slopes.size(), budget::paper_library_slopes);
  EXPECT_LT(sum.size(), budget::paper_library_adapted);
}

// [SA "ActioTransf", "partialPhiU"] d(theta_B, g_B)/d(phi_l, phi_g, phi_h, I_l, I_g, I_h) brings
// the standard brackets to those of the hub
TEST(PaperSadov, LibrarySadovIsCanonical) {
  Gap gap;
  for (const AndoyerCase& e : branches(3)) {
    const SadovMotion k(e);
    const SadovState at = to_sadov(k.motion, 0.0);
    add_poisson_defect(gap, chart_jacobian(k.body, at), exact(to_rotor(k.body, at).g));
  }
  EXPECT_LT(gap.size(), budget::paper_library_brackets);
}

}  // namespace
}  // namespace polhode::paper
