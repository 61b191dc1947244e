// SPDX-License-Identifier: MIT
// Appendix A.2 of the paper in the library: direction cosines of the momentum, their ellipse, and
// the elliptic functions of time.
#include <gtest/gtest.h>

#include <cstddef>

#include "budgets.hpp"
#include "paper/library.hpp"
#include "paper/support.hpp"
#include "polhode/elliptic/agm.hpp"
#include "polhode/elliptic/jacobi.hpp"
#include "polhode/elliptic/legendre.hpp"
#include "polhode/free/free_rotation.hpp"
#include "polhode/free/serret.hpp"
#include "polhode/system/system.hpp"

namespace polhode::paper {
namespace {

// [SA (A4), (A5), (A6), (A7), (A8), (A9), (A10), (A11), (A12), (A13), (A14), "Binet", (A55), "2T"]
TEST(PaperAppendix, LibraryDirectionCosines) {
  Gap momenta, energies, distances;
  for (const AndoyerCase& e : branches(5)) {
    const RotorState state = hub_state(e);
    const Body body = body_of(e.I);
    const FreeRotation motion(body, state);
    const Vec omega = exact(angular_velocity(body, state)), g = exact(state.g);
    const Mp T2 = 2 * Mp(kinetic_energy(body, state)), G = motion.momentum(), G2 = G * G;
    momenta.add(g, scaled(e.I, omega));
    momenta.add(G2, dot(scaled(e.I, omega), scaled(e.I, omega)));
    const Phase a = exact(to_andoyer(state));
    const Mp J = angle(root(squared(a[4]) - squared(a[3])), a[3]);
    const Vec cosines{s(J) * s(a[0]), s(J) * c(a[0]), c(J)};
    momenta.add((1 / G) * g, cosines);
    momenta.add(dot(g, g) / G2, Mp(1));
    energies.add(T2, dot(omega, scaled(e.I, omega)));
    const Vec squares{squared(cosines[0]), squared(cosines[1]), squared(cosines[2])};
    energies.add(T2 / G2, squares[0] / e.I[0] + squares[1] / e.I[1] + squares[2] / e.I[2]);
    const Mp spread = squared(s(a[0])) / e.I[0] + squared(c(a[0])) / e.I[1] - 1 / e.I[2];
    energies.add(T2 / G2 - 1 / e.I[2], (1 - squares[2]) * spread);
    energies.add(T2 / G2 - 1 / e.I[2],
                 (1 / e.I[0] - 1 / e.I[2]) * squares[0] + (1 / e.I[1] - 1 / e.I[2]) * squares[1]);
    // the same with the second moment in place of the third: G^2 - 2 T I2
    distances.add(-Mp(motion.separatrix_distance()) / (G2 * e.I[1]),
                  (1 / e.I[0] - 1 / e.I[1]) * squares[0] + (1 / e.I[2] - 1 / e.I[1]) * squares[2]);
  }
  EXPECT_LT(momenta.size(), budget::paper_library);
  EXPECT_LT(energies.size(), budget::paper_library);
  EXPECT_LT(distances.size(), budget::paper_library);
}

// [SA (A15), (A16), (A17), (A18), (A19), (A20), (A21), (A22), (A23), (A24)] the ellipse of a motion
// in short-axis mode; its sense is that of L
TEST(PaperAppendix, LibraryEllipseOfTheMomentum) {
  Gap modulus, ellipse, cosines;
  for (const int sign : {1, -1}) {
    for (const AndoyerCase& e : andoyer_cases(false, sign, 4)) {
      const FreeRotation motion(body_of(e.I), hub_state(e));
      const Mp G = motion.momentum(), P2 = 2 * Mp(motion.energy()) / squared(G);
      const Mp a2 = (P2 - 1 / e.I[2]) / (1 / e.I[0] - 1 / e.I[2]);
      const Mp b2 = (P2 - 1 / e.I[2]) / (1 / e.I[1] - 1 / e.I[2]);
      const Mp kappa2 = (b2 - a2) / (1 - a2);
      modulus.add(Mp(motion.modulus().m()), kappa2);
      for (const double t : {0.0, 1.3, -2.7}) {
        const Vec at = (1 / G) * exact(motion.at(t).g);
        ellipse.add(squared(at[0]) * b2 + squared(at[1]) * a2, a2 * b2);
        const Mp xi = angle(sign * at[1] / root(b2), at[0] / root(a2));
        const Mp Delta = root(1 - kappa2 * squared(s(xi)));
        cosines.add(at,
                    Vec{root(a2) * c(xi), sign * root(b2) * s(xi), sign * root(1 - a2) * Delta});
        cosines.add(squared(at[2]), (1 - a2) * (1 - (b2 - a2) / (1 - a2) * squared(s(xi))));
      }
    }
  }
  EXPECT_LT(modulus.size(), budget::paper_library);
  EXPECT_LT(ellipse.size(), budget::paper_library);
  EXPECT_LT(cosines.size(), budget::paper_library);
}

// [SA (A33), (A34), (A35), (A36), (A37), (A39), "dimensionless"] the amplitude at n Delta, and
// u = n (t - t0) as the integral F
TEST(PaperAppendix, LibraryAmplitudeOfTime) {
  Gap rate, frequency, time;
  for (const int sign : {1, -1}) {
    for (const AndoyerCase& e : andoyer_cases(false, sign, 4)) {
      const Body body = body_of(e.I);
      const FreeRotation motion(body, hub_state(e));
      const Mp G = motion.momentum(), P2 = 2 * Mp(motion.energy()) / squared(G);
      const Mp a2 = (P2 - 1 / e.I[2]) / (1 / e.I[0] - 1 / e.I[2]);
      const Mp b2 = (P2 - 1 / e.I[2]) / (1 / e.I[1] - 1 / e.I[2]);
      const Mp n = G * root((1 / e.I[0] - P2) * (1 / e.I[1] - 1 / e.I[2]));
      const Mp K = elliptic::complete_k(motion.modulus());
      frequency.add(4 * K / Mp(motion.polhode_period()), n);
      const double t0 = to_serret(motion, 0.0).t0;
      for (const double t : {0.4, -1.6}) {
        const RotorState at = motion.at(t);
        const Vec k = (1 / G) * exact(at.g);
        const Vec k_rate = (1 / G) * exact(rotor_rates(System(body), t, at).g);
        const Mp xi = angle(sign * k[1] / root(b2), k[0] / root(a2));
        const Mp xi_rate = c(xi) * sign * k_rate[1] / root(b2) - s(xi) * k_rate[0] / root(a2);
        const Mp Delta = root(1 - Mp(motion.modulus().m()) * squared(s(xi)));
        rate.add(xi_rate, n * Delta);
        rate.add(xi_rate, root(b2 / a2) * root(1 - a2) * (1 / e.I[1] - 1 / e.I[2]) * G * Delta);
        const Mp u = n * (Mp(t) - Mp(t0));
        const Mp F = elliptic::legendre_f(static_cast<double>(xi), motion.modulus());
        time.add(turned((u - F) * pi() / (2 * K)), Mp(0));  // modulo 4 K
      }
    }
  }
  EXPECT_LT(rate.size(), budget::paper_library);
  EXPECT_LT(frequency.size(), budget::paper_library);
  EXPECT_LT(time.size(), budget::paper_library);
}

// [SA (A38), (A40), (A41), (A42), (A43)] the second argument is the modulus
TEST(PaperAppendix, LibraryJacobiFunctions) {
  Gap functions, amplitudes, integrals;
  Random random(40);
  for (int i = 0; i < 40; ++i) {
    const double m = random.number(0.01, 0.95), u = random.number(-5, 5);
    const elliptic::Modulus modulus = elliptic::Modulus::from_pair(m, 1.0 - m);
    const Mp k = root(Mp(m));
    const Jacobi expected = jacobi(Mp(u), k);
    const auto found = elliptic::jacobi(u, modulus);
    functions.add(Vec{Mp(found.sn), Mp(found.cn), Mp(found.dn)},
                  Vec{expected.sn, expected.cn, expected.dn});
    const double xi = elliptic::amplitude(u, modulus);
    amplitudes.add(Mp(xi), expected.am);
    integrals.add(Mp(elliptic::legendre_f(xi, modulus)), ellint_F(Mp(xi), k));
  }
  EXPECT_LT(functions.size(), budget::paper_library);
  EXPECT_LT(amplitudes.size(), budget::paper_library);
  EXPECT_LT(integrals.size(), budget::paper_library);
}

}  // namespace
}  // namespace polhode::paper
