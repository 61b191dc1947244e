// SPDX-License-Identifier: MIT
// Section 2 of the paper: Euler's angles, their rates and momenta, and the momentum vector.
#include <gtest/gtest.h>

#include <cstddef>

#include "budgets.hpp"
#include "paper/library.hpp"
#include "paper/support.hpp"
#include "polhode/rotor/attitude.hpp"
#include "polhode/rotor/euler.hpp"

namespace polhode::paper {
namespace {

using budget::paper_derivative;
using budget::paper_exact;
using budget::paper_misprint;

const Vec e1{Mp(1), Mp(0), Mp(0)};
const Vec e3{Mp(0), Mp(0), Mp(1)};

// Turns v actively by an angle about a unit axis.
Vec turned_about(const Vec& axis, const Mp& a, const Vec& v) {
  return c(a) * v + s(a) * cross(axis, v) + ((1 - c(a)) * dot(axis, v)) * axis;
}

Phase phase(const EulerCase& e) { return {e.q[0], e.q[1], e.q[2], e.p[0], e.p[1], e.p[2]}; }

// Components of the momentum as functions on phase space, without any formula of the paper.
Field body_component(std::size_t i) {
  return [i](const Phase& x) { return euler_body_momentum(x)[i]; };
}
Field inertial_component(std::size_t i) {
  return [i](const Phase& x) {
    return (transposed(euler_matrix({x[0], x[1], x[2]})) * euler_body_momentum(x))[i];
  };
}

// [SA (1)] R = R(psi, b3) R(theta, l) R(phi, s3): with passive matrices the rows of R are s1, s2,
// s3 carried actively through the same three turns. As active operators the product is R^T.
TEST(PaperSection2, Eq1_ProductOfPassiveRotations) {
  Gap rows;
  for (const EulerCase& e : euler_cases()) {
    const Vec node = turned_about(e3, e.q[0], e1);
    const Vec b3 = turned_about(node, e.q[1], e3);
    const Vec b1 = turned_about(b3, e.q[2], node);
    rows.add(R3(e.q[2]) * R1(e.q[1]) * R3(e.q[0]), Mat{b1, cross(b3, b1), b3});
  }
  EXPECT_LT(rows.size(), paper_exact);
}

// [SA (2)]
TEST(PaperSection2, Eq2_AttitudeMatrix) {
  Gap gap;
  for (const EulerCase& e : euler_cases()) {
    const Mp sf = s(e.q[0]), cf = c(e.q[0]), st = s(e.q[1]), ct = c(e.q[1]), sp = s(e.q[2]),
             cp = c(e.q[2]);
    gap.add(e.R, Mat{{{cp * cf - sp * ct * sf, cp * sf + sp * ct * cf, sp * st},
                      {-sp * cf - cp * ct * sf, -sp * sf + cp * ct * cf, cp * st},
                      {st * sf, -st * cf, ct}}});
  }
  EXPECT_LT(gap.size(), paper_exact);
}

// [SA (2)] the quaternion of the same attitude, active from body to inertial axes
TEST(PaperSection2, Eq2_Quaternion) {
  Gap gap;
  Random random(22);
  for (int i = 0; i < 20; ++i) {
    const double phi = random.number(-3, 3), theta = random.number(0, 3),
                 psi = random.number(-3, 3);
    const Quaternion q = rotation_z(phi) * rotation_x(theta) * rotation_z(psi);
    gap.add(exact(q), euler_matrix({Mp(phi), Mp(theta), Mp(psi)}));
    const Mp c2 = c(Mp(theta) / 2), s2 = s(Mp(theta) / 2), sum = (Mp(phi) + psi) / 2;
    const Mp difference = (Mp(phi) - psi) / 2;
    gap.add(Mp(q.w), c2 * c(sum));
    gap.add(Vec{Mp(q.x), Mp(q.y), Mp(q.z)},
            Vec{s2 * c(difference), s2 * s(difference), c2 * s(sum)});
  }
  EXPECT_LT(gap.size(), budget::paper_library);
}

// [SA (3), (4)] hat(omega) = -Rdot R^T; the opposite sign of Rdot is wrong.
TEST(PaperSection2, Eq3_Eq4_HatOfBodyRate) {
  Gap gap, other_sign;
  for (const EulerCase& e : euler_cases()) {
    const Mp step("1e-16");
    const Mat after = euler_matrix(e.q + step * e.rates);
    const Mat before = euler_matrix(e.q - step * e.rates);
    Mat rate;
    for (std::size_t i = 0; i < 3; ++i) rate[i] = (1 / (2 * step)) * (after[i] - before[i]);
    const Mat product = rate * transposed(e.R);
    const Mat& w = hat(e.omega);
    gap.add(w, Mat{Mp(-1) * product[0], Mp(-1) * product[1], Mp(-1) * product[2]});
    other_sign.add(w, product);
  }
  EXPECT_LT(gap.size(), paper_derivative);
  EXPECT_GT(other_sign.size(), paper_misprint);
}

// [SA (5), (6), (7), (8)] against the rates of turn of the body axes themselves.
TEST(PaperSection2, Eq5_Eq8_AngularVelocity) {
  Gap body, inertial;
  for (const EulerCase& e : euler_cases()) {
    const Mp &phid = e.rates[0], &thd = e.rates[1], &psid = e.rates[2];
    const Mp st = s(e.q[1]), ct = c(e.q[1]), sp = s(e.q[2]), cp = c(e.q[2]);
    const Vec turn = inertial_rate([&](const Mp& t) { return euler_matrix(e.q + t * e.rates); });
    const Vec printed{phid * st * sp + thd * cp, phid * cp * st - thd * sp, psid + phid * ct};
    body.add(e.R * turn, printed);
    inertial.add(turn, transposed(e.R) * printed);
  }
  EXPECT_LT(body.size(), paper_derivative);
  EXPECT_LT(inertial.size(), paper_derivative);
}

// [SA (9), (11)]
TEST(PaperSection2, Eq9_Eq11_InertialRate) {
  Gap gap;
  for (const EulerCase& e : euler_cases()) {
    gap.add(e.Omega[0], e.rates[1] * c(e.q[0]) + e.rates[2] * s(e.q[1]) * s(e.q[0]));
    gap.add(e.Omega[2], e.rates[0] + e.rates[2] * c(e.q[1]));
  }
  EXPECT_LT(gap.size(), paper_exact);
}

// [SA (10)] printed + in front of psi_dot
TEST(PaperErrata, Eq10_Omega2Sign) {
  Gap printed, right;
  for (const EulerCase& e : euler_cases()) {
    const Mp first = e.rates[1] * s(e.q[0]), second = e.rates[2] * s(e.q[1]) * c(e.q[0]);
    printed.add(e.Omega[1], first + second);
    right.add(e.Omega[1], first - second);
  }
  EXPECT_GT(printed.size(), paper_misprint);
  EXPECT_LT(right.size(), paper_exact);
}

// [SA (12), (14), (15)] Hamilton's equations with generalised forces Q give I omegadot + omega x I
// omega = u, where u follows from Q by the formulas (25)-(27) that give g from the momenta.
TEST(PaperSection2, Eq12_Eq14_EulerPoinsot) {
  Gap free, forced;
  Random random(12);
  for (const EulerCase& e : euler_cases()) {
    const Phase x = phase(e);
    const Vec Q{Mp(random.number(-1, 1)), Mp(random.number(-1, 1)), Mp(random.number(-1, 1))};
    const Phase dH = gradient([&](const Phase& y) { return euler_energy(e.I, y); }, x);
    Vec flow, push;
    for (std::size_t i = 0; i < 3; ++i) {
      const Phase dg = gradient(body_component(i), x);
      flow[i] = bracket(dg, dH);
      push[i] = dg[3] * Q[0] + dg[4] * Q[1] + dg[5] * Q[2];
    }
    free.add(flow + cross(e.omega, e.g), Vec{});
    forced.add(push, euler_body_momentum({x[0], x[1], x[2], Q[0], Q[1], Q[2]}));
  }
  EXPECT_LT(free.size(), paper_derivative);
  EXPECT_LT(forced.size(), paper_derivative);
}

// [SA (13), (16), (18)] momenta as derivatives of the kinetic energy by the rates
TEST(PaperSection2, Eq16_Eq18_Momenta) {
  Gap by_rates, phi, psi;
  for (const EulerCase& e : euler_cases()) {
    const Mp st = s(e.q[1]), ct = c(e.q[1]), sp = s(e.q[2]), cp = c(e.q[2]);
    const Mp &phid = e.rates[0], &thd = e.rates[1], &psid = e.rates[2];
    for (std::size_t i = 0; i < 3; ++i) {
      by_rates.add(e.p[i], derivative(
                               [&](const Mp& v) {
                                 Vec rates = e.rates;
                                 rates[i] = v;
                                 return kinetic(e.I, scaled(e.I, body_rate(e.q, rates)));
                               },
                               e.rates[i]));
    }
    phi.add(e.p[0], e.I[0] * st * sp * (phid * sp * st + thd * cp) +
                        e.I[1] * st * cp * (phid * cp * st - thd * sp) +
                        e.I[2] * ct * (phid * ct + psid));
    psi.add(e.p[2], e.I[2] * (phid * ct + psid));
  }
  EXPECT_LT(by_rates.size(), paper_derivative);
  EXPECT_LT(phi.size(), paper_exact);
  EXPECT_LT(psi.size(), paper_exact);
}

// [SA (17)] printed c_phi in the second bracket
TEST(PaperErrata, Eq17_ThetaMomentumCosPsi) {
  Gap printed, right;
  for (const EulerCase& e : euler_cases()) {
    const Mp st = s(e.q[1]), sp = s(e.q[2]), cp = c(e.q[2]);
    const Mp &phid = e.rates[0], &thd = e.rates[1];
    const Mp first = e.I[0] * cp * (phid * st * sp + thd * cp);
    printed.add(e.p[1], first - e.I[1] * sp * (phid * c(e.q[0]) * st - thd * sp));
    right.add(e.p[1], first - e.I[1] * sp * (phid * cp * st - thd * sp));
  }
  EXPECT_GT(printed.size(), paper_misprint);
  EXPECT_LT(right.size(), paper_exact);
}

// [SA (19), (20), (21)]
TEST(PaperSection2, Eq19_Eq21_RatesFromMomenta) {
  Gap gap;
  for (const EulerCase& e : euler_cases()) {
    const Mp st = s(e.q[1]), ct = c(e.q[1]), sp = s(e.q[2]), cp = c(e.q[2]);
    const Mp &Phi = e.p[0], &Theta = e.p[1], &Psi = e.p[2];
    const Mp &I1 = e.I[0], &I2 = e.I[1], &I3 = e.I[2];
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
    gap.add(e.rates, Vec{phid, thd, psid});
  }
  EXPECT_LT(gap.size(), paper_exact);
}

// [SA (22), (23)] the Hamiltonian, from Legendre's transformation and through its own derivatives
TEST(PaperSection2, Eq22_Eq23_Hamiltonian) {
  Gap value, rates;
  for (const EulerCase& e : euler_cases()) {
    const Field printed = [&](const Phase& x) {
      const Mp sp = s(x[2]), cp = c(x[2]), lean = (x[3] - x[5] * c(x[1])) / s(x[1]);
      return (sp * sp / e.I[0] + cp * cp / e.I[1]) * lean * lean / 2 + x[5] * x[5] / (2 * e.I[2]) +
             (cp * cp / e.I[0] + sp * sp / e.I[1]) * x[4] * x[4] / 2 +
             (1 / e.I[0] - 1 / e.I[1]) * lean * x[4] * sp * cp;
    };
    value.add(printed(phase(e)), dot(e.p, e.rates) - kinetic(e.I, e.g));
    const Phase d = gradient(printed, phase(e));
    rates.add(Vec{d[3], d[4], d[5]}, e.rates);
    rates.add(d[0], Mp(0));  // phi is cyclic
  }
  EXPECT_LT(value.size(), paper_exact);
  EXPECT_LT(rates.size(), paper_derivative);
}

// [SA (24), (25), (26), (27)]
TEST(PaperSection2, Eq24_Eq27_BodyMomentum) {
  Gap gap;
  for (const EulerCase& e : euler_cases()) {
    const Mp st = s(e.q[1]), ct = c(e.q[1]), sp = s(e.q[2]), cp = c(e.q[2]);
    const Mp &Phi = e.p[0], &Theta = e.p[1], &Psi = e.p[2];
    gap.add(e.g, Vec{(Phi * sp + Theta * st * cp - Psi * sp * ct) / st,
                     (Phi * cp - Theta * sp * st - Psi * cp * ct) / st, Psi});
  }
  EXPECT_LT(gap.size(), paper_exact);
}

// [SA "symplecticRB"] (g1, g2) = -g3 and cyclic; (G1, G2) = +G3 and cyclic; (g_i, G_j) = 0
TEST(PaperSection2, PoissonBracketsOfMomentum) {
  Gap body, inertial, mixed;
  for (std::size_t k = 0; k < 4; ++k) {
    const EulerCase& e = euler_cases()[k];
    std::array<Phase, 3> dg, dG;
    for (std::size_t i = 0; i < 3; ++i) {
      dg[i] = gradient(body_component(i), phase(e));
      dG[i] = gradient(inertial_component(i), phase(e));
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, m = (i + 2) % 3;
      body.add(bracket(dg[i], dg[j]), -e.g[m]);
      inertial.add(bracket(dG[i], dG[j]), e.G[m]);
      for (std::size_t n = 0; n < 3; ++n) mixed.add(bracket(dg[i], dG[n]), Mp(0));
    }
  }
  EXPECT_LT(body.size(), paper_derivative);
  EXPECT_LT(inertial.size(), paper_derivative);
  EXPECT_LT(mixed.size(), paper_derivative);
}

// [SA (28)] with I = diag(I1, I2, I3) the product I Omega mixes axes; the momentum is R^T g
TEST(PaperErrata, Eq28_InertialMomentum) {
  Gap printed, right;
  for (const EulerCase& e : euler_cases()) {
    // The true momentum has Phi along s3 and Theta along the node of the two equators.
    const Vec node{c(e.q[0]), s(e.q[0]), Mp(0)};
    const auto projections = [&](const Vec& G) { return Vec{G[2], dot(G, node), dot(e.R[2], G)}; };
    printed.add(e.p, projections(scaled(e.I, e.Omega)));
    right.add(e.p, projections(transposed(e.R) * e.g));
    right.add(e.p, projections(transposed(e.R) * scaled(e.I, e.R * e.Omega)));
  }
  EXPECT_GT(printed.size(), paper_misprint);
  EXPECT_LT(right.size(), paper_exact);
}

// [SA (29), (30), (31)]
TEST(PaperSection2, Eq29_Eq31_InertialMomentum) {
  Gap gap;
  for (const EulerCase& e : euler_cases()) {
    const Mp st = s(e.q[1]), ct = c(e.q[1]), sf = s(e.q[0]), cf = c(e.q[0]);
    const Mp &Phi = e.p[0], &Theta = e.p[1], &Psi = e.p[2];
    gap.add(e.G, Vec{(Psi * sf + Theta * st * cf - Phi * sf * ct) / st,
                     (Phi * ct * cf - Psi * cf + Theta * sf * st) / st, Phi});
  }
  EXPECT_LT(gap.size(), paper_exact);
}

// [SA "firstg1"] the first two of Euler's equations for the momentum, as Poisson brackets
TEST(PaperSection2, FirstTwoEulerEquations) {
  Gap gap;
  for (const EulerCase& e : euler_cases()) {
    const Phase dH = gradient([&](const Phase& y) { return euler_energy(e.I, y); }, phase(e));
    gap.add(bracket(gradient(body_component(0), phase(e)), dH),
            -(1 / e.I[1] - 1 / e.I[2]) * e.g[1] * e.g[2]);
    gap.add(bracket(gradient(body_component(1), phase(e)), dH),
            -(1 / e.I[2] - 1 / e.I[0]) * e.g[2] * e.g[0]);
  }
  EXPECT_LT(gap.size(), paper_derivative);
}

// [SA "firstg3"] printed g1dot = (g2, H) = -(1/I1 - 1/I1) g1 g2: three slips in one line
TEST(PaperErrata, Firstg3_ThirdEulerEquation) {
  Gap printed_left, printed_bracket, printed_right, right;
  for (const EulerCase& e : euler_cases()) {
    const Phase dH = gradient([&](const Phase& y) { return euler_energy(e.I, y); }, phase(e));
    const auto flow = [&](std::size_t i) {
      return bracket(gradient(body_component(i), phase(e)), dH);
    };
    const Mp value = -(1 / e.I[0] - 1 / e.I[1]) * e.g[0] * e.g[1];
    printed_left.add(flow(0), value);
    printed_bracket.add(flow(1), value);
    printed_right.add(flow(2), Mp(0));  // 1/I1 - 1/I1
    right.add(flow(2), value);
  }
  EXPECT_GT(printed_left.size(), paper_misprint);
  EXPECT_GT(printed_bracket.size(), paper_misprint);
  EXPECT_GT(printed_right.size(), paper_misprint);
  EXPECT_LT(right.size(), paper_derivative);
}

// [SA "sphere", "kinetic"] like components only: body omega with inertial G is wrong
TEST(PaperSection2, SphereAndKineticEnergy) {
  Gap gap, mixed;
  for (const EulerCase& e : euler_cases()) {
    gap.add(dot(e.g, e.g), dot(e.G, e.G));
    const Mp T = kinetic(e.I, e.g);
    gap.add(T, dot(e.omega, e.g) / 2);
    gap.add(T, dot(e.Omega, e.G) / 2);
    gap.add(T, dot(e.omega, scaled(e.I, e.omega)) / 2);
    mixed.add(T, dot(e.omega, e.G) / 2);
  }
  EXPECT_LT(gap.size(), paper_exact);
  EXPECT_GT(mixed.size(), paper_misprint);
}

// [SA (32), (33), (34), (35)] momenta through the angles of the invariable plane
TEST(PaperSection2, Eq32_Eq35_MomentaThroughInvariablePlane) {
  Gap body, Phi, Theta, Psi;
  for (const AndoyerCase& e : andoyer_cases()) {
    const Mp &l = e.a[0], &G = e.a[4];
    const Mp &th = e.q[1], &psi = e.q[2];
    body.add(e.g_B, Vec{G * s(e.J) * s(l), G * s(e.J) * c(l), G * c(e.J)});
    Phi.add(e.p[0], e.g_B[0] * s(th) * s(psi) + e.g_B[1] * s(th) * c(psi) + e.g_B[2] * c(th));
    Phi.add(e.p[0], G * (c(th) * c(e.J) + s(th) * s(e.J) * c(psi - l)));
    Phi.add(e.p[0], G * c(e.incl));
    Theta.add(e.p[1], e.g_B[0] * c(psi) - e.g_B[1] * s(psi));
    Theta.add(e.p[1], G * s(e.J) * s(l - psi));
    Psi.add(e.p[2], e.g_B[2]);
    Psi.add(e.p[2], G * c(e.J));
  }
  EXPECT_LT(body.size(), paper_exact);
  EXPECT_LT(Phi.size(), paper_exact);
  EXPECT_LT(Theta.size(), paper_exact);
  EXPECT_LT(Psi.size(), paper_exact);
}

// [SA (33), (34), (35)] the library from the hub to Euler's canonical set
TEST(PaperSection2, LibraryToEuler) {
  Gap gap;
  for (const RotorState& state : hub_states(2, 200)) {
    const EulerState e = to_euler(state);
    const Phase x = exact_euler(state);
    gap.add(turned(Mp(e.phi) - x[0]), Mp(0));
    gap.add(Mp(e.theta), x[1]);
    gap.add(turned(Mp(e.psi) - x[2]), Mp(0));
    gap.add(Vec{Mp(e.Phi), Mp(e.Theta), Mp(e.Psi)}, Vec{x[3], x[4], x[5]});
  }
  EXPECT_LT(gap.size(), budget::paper_library);
}

// [SA (2), (25), (26), (27)] and back
TEST(PaperSection2, LibraryFromEuler) {
  Gap attitude, momentum;
  for (const RotorState& state : hub_states(3, 200)) {
    const EulerState e = to_euler(state);
    const Phase x{Mp(e.phi), Mp(e.theta), Mp(e.psi), Mp(e.Phi), Mp(e.Theta), Mp(e.Psi)};
    const RotorState back = to_rotor(e);
    attitude.add(exact(back.q), euler_matrix({x[0], x[1], x[2]}));
    momentum.add(exact(back.g), euler_body_momentum(x));
  }
  EXPECT_LT(attitude.size(), budget::paper_library);
  EXPECT_LT(momentum.size(), budget::paper_library);
}

// [SA (5), (6), (7), (8), (24), "kinetic"] the library's rates, angular velocities and energy
TEST(PaperSection2, LibraryRatesAndEnergy) {
  Gap rates, velocity, energy, inertial;
  Random random(4);
  for (const RotorState& state : hub_states(4, 200)) {
    const Vec I = random.moments();
    const Body body = body_of(I);
    const Vec omega = unscaled(I, exact(state.g));
    const EulerRates e = to_euler_rates(body, state);
    rates.add(omega, body_rate({Mp(e.phi), Mp(e.theta), Mp(e.psi)},
                               {Mp(e.phi_dot), Mp(e.theta_dot), Mp(e.psi_dot)}));
    velocity.add(exact(angular_velocity(body, state)), omega);
    inertial.add(exact(inertial_angular_velocity(body, state)), transposed(exact(state.q)) * omega);
    energy.add(Mp(kinetic_energy(body, state)), kinetic(I, exact(state.g)));
    inertial.add(exact(inertial_momentum(state)), transposed(exact(state.q)) * exact(state.g));
  }
  EXPECT_LT(rates.size(), budget::paper_library);
  EXPECT_LT(velocity.size(), budget::paper_library);
  EXPECT_LT(inertial.size(), budget::paper_library);
  EXPECT_LT(energy.size(), budget::paper_library);
}

}  // namespace
}  // namespace polhode::paper
