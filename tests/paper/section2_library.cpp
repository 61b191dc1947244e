// SPDX-License-Identifier: MIT
// Section 2 of the paper in the library: attitudes, rates, momenta and Euler's equations, against
// the printed formulas (misprints corrected) with 50 digits.
#include <gtest/gtest.h>

#include <array>
#include <cstddef>

#include "budgets.hpp"
#include "paper/library.hpp"
#include "paper/support.hpp"
#include "polhode/perturb/user_terms.hpp"
#include "polhode/rotor/attitude.hpp"
#include "polhode/rotor/chart_jacobian.hpp"
#include "polhode/rotor/euler.hpp"
#include "polhode/system/system.hpp"

namespace polhode::paper {
namespace {

// Angles and rates of a case are doubles.
EulerRates euler_rates_of(const EulerCase& e) {
  const auto d = [](const Mp& x) { return static_cast<double>(x); };
  return {d(e.q[0]), d(e.q[1]), d(e.q[2]), d(e.rates[0]), d(e.rates[1]), d(e.rates[2])};
}

// [SA (1), (2)] the product of three rotations, and the angles of a matrix
TEST(PaperSection2, LibraryAttitude) {
  Gap matrix, angles;
  for (const EulerCase& e : euler_cases()) {
    const EulerRates a = euler_rates_of(e);
    const Quaternion q = attitude(EulerAngles{a.phi, a.theta, a.psi});
    matrix.add(exact(attitude_matrix(q)), R3(e.q[2]) * R1(e.q[1]) * R3(e.q[0]));
    const EulerAngles back = euler_angles(q);
    angles.add(Vec{Mp(back.phi), Mp(back.theta), Mp(back.psi)}, e.q);
  }
  EXPECT_LT(matrix.size(), budget::paper_library);
  EXPECT_LT(angles.size(), budget::paper_library);
}

// [SA (3), (4)] hat(omega) = -Rdot R^T for the rate of the quaternion
TEST(PaperSection2, LibraryHatOfBodyRate) {
  Gap rate, product;
  Random random(23);
  for (RotorState state : hub_states(23, 50)) {
    state.q = normalized(state.q);
    const Body body = body_of(random.moments());
    const Quaternion dq = rotor_rates(System(body), 0.0, state).q;
    const auto R = [&](const Mp& h) {
      const Quaternion& q = state.q;
      return matrix_of(q.w + h * dq.w, {q.x + h * dq.x, q.y + h * dq.y, q.z + h * dq.z});
    };
    const Mp step("1e-16");
    const Mat before = R(-step), after = R(step), transposed_R = transposed(R(Mp(0)));
    const Vec3 omega = angular_velocity(body, state);
    const Mat hat_omega = exact(hat(omega));
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec row = (-1 / (2 * step)) * (after[i] - before[i]);
      rate.add(transposed(transposed_R) * row, hat_omega[i]);
    }
    product.add(exact(hat(omega) * state.g), cross(exact(omega), exact(state.g)));
  }
  EXPECT_LT(rate.size(), budget::paper_library);
  EXPECT_LT(product.size(), budget::paper_library);
}

// [SA (5), (6), (7), (8), (9), (10), (11)]
TEST(PaperSection2, LibraryAngularVelocityOfRates) {
  Gap body_axes, inertial_axes;
  for (const EulerCase& e : euler_cases()) {
    const Body body = body_of(e.I);
    const RotorState state = to_rotor(body, euler_rates_of(e));
    const Mp &phid = e.rates[0], &thd = e.rates[1], &psid = e.rates[2];
    const Mp st = s(e.q[1]), ct = c(e.q[1]), sp = s(e.q[2]), cp = c(e.q[2]);
    const Vec omega{phid * st * sp + thd * cp, phid * cp * st - thd * sp, psid + phid * ct};
    body_axes.add(exact(angular_velocity(body, state)), omega);
    const Vec Omega = exact(inertial_angular_velocity(body, state));
    inertial_axes.add(Omega, transposed(e.R) * omega);
    const Mp sf = s(e.q[0]), cf = c(e.q[0]);
    inertial_axes.add(Omega,
                      {thd * cf + psid * st * sf, thd * sf - psid * st * cf, phid + psid * ct});
  }
  EXPECT_LT(body_axes.size(), budget::paper_library);
  EXPECT_LT(inertial_axes.size(), budget::paper_library);
}

// [SA (13), (16), (17), (18)] the Lagrangian, and its derivatives by the rates
TEST(PaperSection2, LibraryMomentaOfRates) {
  Gap momenta, energy;
  for (const EulerCase& e : euler_cases()) {
    const Body body = body_of(e.I);
    const RotorState state = to_rotor(body, euler_rates_of(e));
    const Mp &phid = e.rates[0], &thd = e.rates[1], &psid = e.rates[2];
    const Mp st = s(e.q[1]), ct = c(e.q[1]), sp = s(e.q[2]), cp = c(e.q[2]);
    const Mp first = phid * st * sp + thd * cp, second = phid * cp * st - thd * sp;
    const Mp third = phid * ct + psid;
    const EulerState found = to_euler(state);
    momenta.add(second_half(exact(found)),
                {e.I[0] * st * sp * first + e.I[1] * st * cp * second + e.I[2] * ct * third,
                 e.I[0] * cp * first - e.I[1] * sp * second, e.I[2] * third});
    const Vec omega{first, second, third};
    energy.add(Mp(kinetic_energy(body, state)), dot(omega, scaled(e.I, omega)) / 2);
  }
  EXPECT_LT(momenta.size(), budget::paper_library);
  EXPECT_LT(energy.size(), budget::paper_library);
}

// [SA (19), (20), (21)]
TEST(PaperSection2, LibraryRatesOfMomenta) {
  Gap gap;
  Random random(19);
  for (const RotorState& state : hub_states(19, 100)) {
    const Vec I = random.moments();
    const EulerState at = to_euler(state);
    const Phase x = exact(at);
    const Mp st = s(x[1]), ct = c(x[1]), sp = s(x[2]), cp = c(x[2]);
    const Mp &Phi = x[3], &Theta = x[4], &Psi = x[5], &I1 = I[0], &I2 = I[1], &I3 = I[2];
    const Mp phid = -(I1 * cp * (Psi * ct * cp - Phi * cp + Theta * st * sp) +
                      I2 * sp * (Psi * ct * sp - Phi * sp - Theta * cp * st)) /
                    (I1 * I2 * st * st);
    const Mp thd = (I2 * cp * (Phi * sp + Theta * st * cp - Psi * sp * ct) +
                    I1 * sp * (Psi * cp * ct - Phi * cp + Theta * st * sp)) /
                   (I1 * I2 * st);
    const Mp psid = -(I1 * I3 * cp * (Phi * ct * cp - Psi * cp * ct * ct - Theta * sp * st * ct) +
                      I3 * I2 * sp * (Phi * ct * sp - Psi * ct * ct * sp + Theta * cp * st * ct)) /
                        (I1 * I2 * I3 * st * st) +
                    Psi / I3;
    const EulerRates found = to_euler_rates(body_of(I), to_rotor(at));
    gap.add(Vec{Mp(found.phi_dot), Mp(found.theta_dot), Mp(found.psi_dot)}, Vec{phid, thd, psid});
  }
  EXPECT_LT(gap.size(), budget::paper_library);
}

// [SA (22), (23), "newhamil"] Legendre's transform, and the Hamiltonian in Euler's and in Andoyer's
// variables
TEST(PaperSection2, LibraryHamiltonian) {
  Gap legendre, euler, andoyer;
  Random random(24);
  for (const RotorState& start : hub_states(24, 100)) {
    const Vec I = random.moments();
    const Body body = body_of(I);
    const EulerState at = to_euler(start);
    const RotorState state = to_rotor(at);
    const Phase x = exact(at);
    const Mp H = energy(System(body), 0.0, state);
    const EulerRates r = to_euler_rates(body, state);
    legendre.add(H, x[3] * r.phi_dot + x[4] * r.theta_dot + x[5] * r.psi_dot -
                        Mp(kinetic_energy(body, state)));
    const Mp sp = s(x[2]), cp = c(x[2]), lean = (x[3] - x[5] * c(x[1])) / s(x[1]);
    euler.add(H, (sp * sp / I[0] + cp * cp / I[1]) * lean * lean / 2 + x[5] * x[5] / (2 * I[2]) +
                     (cp * cp / I[0] + sp * sp / I[1]) * x[4] * x[4] / 2 +
                     (1 / I[0] - 1 / I[1]) * lean * x[4] * sp * cp);
    const Phase a = exact(to_andoyer(state));
    const Mp sl = s(a[0]), cl = c(a[0]);
    andoyer.add(H, (sl * sl / I[0] + cl * cl / I[1]) * (squared(a[4]) - squared(a[3])) / 2 +
                       squared(a[3]) / (2 * I[2]));
  }
  EXPECT_LT(legendre.size(), budget::paper_library);
  EXPECT_LT(euler.size(), budget::paper_library);
  EXPECT_LT(andoyer.size(), budget::paper_library);
}

// [SA "symplecticRB", "brackets of G"] by the derivatives of the body momentum and of the attitude
TEST(PaperSection2, LibraryPoissonBrackets) {
  Gap body, inertial, mixed;
  for (const RotorState& start : hub_states(26, 20)) {
    const EulerState at = to_euler(start);
    const Matrix6 B = chart_jacobian(at);
    const Vec g = exact(to_rotor(at).g);
    const Mat to_inertial = transposed(euler_matrix(first_half(exact(at))));
    std::array<Phase, 3> dg, dG;
    for (int i = 0; i < 3; ++i) dg[static_cast<std::size_t>(i)] = exact_row(B, i + 3);
    for (std::size_t j = 0; j < 6; ++j) {
      const int column = static_cast<int>(j);
      const Vec turn{Mp(B(0, column)), Mp(B(1, column)), Mp(B(2, column))};
      const Vec change = to_inertial * (cross(turn, g) + Vec{dg[0][j], dg[1][j], dg[2][j]});
      for (std::size_t i = 0; i < 3; ++i) dG[i][j] = change[i];
    }
    const Vec G = to_inertial * g;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, m = (i + 2) % 3;
      body.add(bracket(dg[i], dg[j]), -g[m]);
      inertial.add(bracket(dG[i], dG[j]), G[m]);
      for (std::size_t n = 0; n < 3; ++n) mixed.add(bracket(dg[i], dG[n]), Mp(0));
    }
  }
  EXPECT_LT(body.size(), budget::paper_library);
  EXPECT_LT(inertial.size(), budget::paper_library);
  EXPECT_LT(mixed.size(), budget::paper_library);
}

// [SA (28), (29), (30), (31), "sphere"] R^T g, which is (R^T I R) Omega and not diag(I) Omega
TEST(PaperSection2, LibraryInertialMomentum) {
  Gap formula, tensor, size;
  Random random(28);
  for (const RotorState& start : hub_states(28, 100)) {
    const Vec I = random.moments();
    const EulerState at = to_euler(start);
    const RotorState state = to_rotor(at);
    const Phase x = exact(at);
    const Vec G = exact(inertial_momentum(state));
    const Mp st = s(x[1]), ct = c(x[1]), sf = s(x[0]), cf = c(x[0]);
    formula.add(G, {(x[5] * sf + x[4] * st * cf - x[3] * sf * ct) / st,
                    (x[3] * ct * cf - x[5] * cf + x[4] * sf * st) / st, x[3]});
    const Mat R = euler_matrix(first_half(x));
    const Vec Omega = exact(inertial_angular_velocity(body_of(I), state));
    tensor.add(G, transposed(R) * scaled(I, R * Omega));
    size.add(length(G), length(exact(state.g)));
  }
  EXPECT_LT(formula.size(), budget::paper_library);
  EXPECT_LT(tensor.size(), budget::paper_library);
  EXPECT_LT(size.size(), budget::paper_library);
}

// [SA (12), (14), (15), "firstg1", "firstg2", "firstg3", (A25), (A26), (A27), (A28), (A29), (A30)]
// free and under a torque
TEST(PaperSection2, LibraryEulersEquations) {
  Gap vectors, components, cosines;
  Random random(12);
  for (RotorState state : hub_states(12, 100)) {
    state.q = normalized(state.q);
    const Vec I = random.moments(), g = exact(state.g), omega = unscaled(I, g);
    const Body body = body_of(I);
    const Vec3 u{random.number(-1, 1), random.number(-1, 1), random.number(-1, 1)};
    const auto torque = [u]<class T>(const T&, const BasicRotorState<T>&) {
      return BasicVec3<T>{T(u.x), T(u.y), T(u.z)};
    };
    const System free(body),
        forced(body, Frame::inertial(), {AnyPerturbation("torque", TorqueTerm(torque))});
    const Vec rate = exact(rotor_rates(free, 0.0, state).g);
    vectors.add(rate + cross(omega, g), Vec{});
    vectors.add(exact(rotor_rates(forced, 0.0, state).g) + cross(omega, g), exact(u));
    const Mp G = length(g);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, m = (i + 2) % 3;
      components.add(rate[i], -(1 / I[j] - 1 / I[m]) * g[j] * g[m]);
      components.add(rate[i], omega[j] * omega[m] * (I[j] - I[m]));
      cosines.add(rate[i] / G, G * (g[j] / G) * (g[m] / G) * (1 / I[m] - 1 / I[j]));
    }
  }
  EXPECT_LT(vectors.size(), budget::paper_library);
  EXPECT_LT(components.size(), budget::paper_library);
  EXPECT_LT(cosines.size(), budget::paper_library);
}

// [SA (32), (33), (34), (35), (72), (76), "Theta", (84), (128)] momenta by the angles of the
// invariable plane, and as projections on the axes of rotation
TEST(PaperSection2, LibraryMomentaThroughInvariablePlane) {
  Gap body, momenta, projections, cosines;
  for (const RotorState& start : hub_states(32, 100)) {
    const AndoyerState a = to_andoyer(start);
    const RotorState state = to_rotor(a);
    const AndoyerCase e = andoyer_case({Mp(1), Mp(1), Mp(1)}, exact(a));
    const Mp &l = e.a[0], &G = e.a[4];
    const Phase x = exact(to_euler(state));
    const Mp &theta = x[1], &psi = x[2], sJ = s(e.J), cJ = c(e.J);
    const Vec g{G * sJ * s(l), G * sJ * c(l), G * cJ};
    body.add(exact(state.g), g);
    const Mp st = s(theta), ct = c(theta), sp = s(psi), cp = c(psi);
    momenta.add(second_half(x),
                {g[0] * st * sp + g[1] * st * cp + g[2] * ct, g[0] * cp - g[1] * sp, g[2]});
    momenta.add(second_half(x),
                {G * (ct * cJ + st * sJ * c(psi - l)), G * sJ * s(l - psi), G * cJ});
    momenta.add(second_half(x), {e.a[5], root(G * G - squared(e.a[3])) * s(l - psi), e.a[3]});
    const Vec G_I = exact(inertial_momentum(state));
    const Vec node{c(x[0]), s(x[0]), Mp(0)}, b3 = e.R[2];
    projections.add(second_half(x), {G_I[2], dot(G_I, node), dot(G_I, b3)});
    const Phase direct = exact(to_andoyer(state));
    cosines.add(direct[5] / direct[4], G_I[2] / length(G_I));
    cosines.add(direct[3] / direct[4], dot(G_I, b3) / length(G_I));
  }
  EXPECT_LT(body.size(), budget::paper_library);
  EXPECT_LT(momenta.size(), budget::paper_library);
  EXPECT_LT(projections.size(), budget::paper_library);
  EXPECT_LT(cosines.size(), budget::paper_library);
}

}  // namespace
}  // namespace polhode::paper
