// SPDX-License-Identifier: MIT
// Section 3 of the paper in the library, with appendices A.1 and A.4: one-forms, infinitesimal
// rotations, the spherical triangle between the nodes, and the generating function.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>

#include "budgets.hpp"
#include "paper/library.hpp"
#include "paper/support.hpp"
#include "polhode/error.hpp"
#include "polhode/free/generating_function.hpp"
#include "polhode/rotor/chart_jacobian.hpp"
#include "polhode/system/canonical_rates.hpp"

namespace polhode::paper {
namespace {

constexpr CanonicalChart from_euler{CanonicalSet::euler}, from_andoyer{CanonicalSet::andoyer};

// A state in both sets of variables, by the library; of the angles between the nodes, exactly.
struct TwoCharts {
  explicit TwoCharts(const RotorState& start)
      : andoyer(to_andoyer(start)),
        state(to_rotor(andoyer)),
        a(exact(andoyer)),
        x(exact(to_euler(state))),
        exactly(andoyer_case({Mp(1), Mp(1), Mp(1)}, a)),
        sJ(s(exactly.J)),
        cJ(c(exactly.J)),
        sI(s(exactly.incl)),
        cI(c(exactly.incl)) {}
  AndoyerState andoyer;
  RotorState state;
  Phase a, x;
  AndoyerCase exactly;
  Mp sJ, cJ, sI, cI;
};

Phase random_variation(Random& random) {
  Phase d;
  for (Mp& component : d) component = random.number(-1, 1);
  return d;
}
// A Jacobian times a variation.
Phase varied(const Matrix6& M, const Phase& d) {
  Phase change{};
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j)
      change[i] += Mp(M(static_cast<int>(i), static_cast<int>(j))) * d[j];
  return change;
}

// [SA "cantran2", (75), "conditionJ", "defJ", "J_alpha, first form", "J of the other variables",
// "L, G, H"] J_alpha = Phi phi_alpha + Theta theta_alpha + Psi psi_alpha of Andoyer's six variables
// are L, G, H, 0, 0, 0
TEST(PaperAndoyer, LibraryOneForms) {
  Gap gap;
  for (const RotorState& start : hub_states(75, 100)) {
    const TwoCharts k(start);
    const Matrix6 M = canonical_transformation(k.state, from_andoyer, from_euler);
    const Phase J_expected{k.a[3], k.a[4], k.a[5], Mp(0), Mp(0), Mp(0)};
    for (std::size_t j = 0; j < 6; ++j) {
      Phase d{};
      d[j] = 1;
      gap.add(dot(second_half(k.x), first_half(varied(M, d))), J_expected[j]);
    }
  }
  EXPECT_LT(gap.size(), budget::paper_library);
}

// [SA "dr1", "dr2", (73), (74), "J_alpha", "J_l"] the vectors of the infinitesimal rotations by the
// angles, and their products with the momentum
TEST(PaperAndoyer, LibraryInfinitesimalRotations) {
  Gap euler, andoyer, products;
  for (const RotorState& start : hub_states(73, 100)) {
    const TwoCharts k(start);
    const Matrix6 by_euler = chart_jacobian(to_euler(k.state));
    const Matrix6 by_andoyer = chart_jacobian(k.andoyer);
    const auto rotation = [](const Matrix6& B, int column) {
      return Vec{Mp(B(0, column)), Mp(B(1, column)), Mp(B(2, column))};
    };
    const Mat& R = k.exactly.R;
    const Vec s3 = R * Vec{Mp(0), Mp(0), Mp(1)}, b3{Mp(0), Mp(0), Mp(1)};
    euler.add(rotation(by_euler, 0), s3);
    euler.add(rotation(by_euler, 1), Vec{c(k.x[2]), -s(k.x[2]), Mp(0)});
    euler.add(rotation(by_euler, 2), b3);
    const Mp &l = k.a[0], &h = k.a[2], &G = k.a[4];
    const Vec node_j{c(l), -s(l), Mp(0)}, node_i = R * Vec{c(h), s(h), Mp(0)};
    andoyer.add(rotation(by_andoyer, 0), b3);
    andoyer.add(rotation(by_andoyer, 1), (1 / G) * k.exactly.g_B);
    andoyer.add(rotation(by_andoyer, 2), s3);
    // J and I move through L, G and H: d(cos J) = dL/G - cos J dG/G
    andoyer.add(rotation(by_andoyer, 3), (-1 / (G * k.sJ)) * node_j);
    andoyer.add(rotation(by_andoyer, 4),
                (k.cJ / (G * k.sJ)) * node_j + (k.cI / (G * k.sI)) * node_i);
    andoyer.add(rotation(by_andoyer, 5), (-1 / (G * k.sI)) * node_i);
    const Phase J_andoyer{k.a[3], G, k.a[5], Mp(0), Mp(0), Mp(0)};
    const Phase J_euler{k.x[3], k.x[4], k.x[5], Mp(0), Mp(0), Mp(0)};
    const Vec g = exact(k.state.g);
    for (int j = 0; j < 6; ++j) {
      const auto n = static_cast<std::size_t>(j);
      products.add(dot(g, rotation(by_andoyer, j)), J_andoyer[n]);
      products.add(dot(g, rotation(by_euler, j)), J_euler[n]);
    }
  }
  EXPECT_LT(euler.size(), budget::paper_library);
  EXPECT_LT(andoyer.size(), budget::paper_library);
  EXPECT_LT(products.size(), budget::paper_library);
}

// [SA (78), (79), (80), (A1), (A44), (A45), (A46)] the triangle between the three nodes
TEST(PaperAndoyer, LibraryTriangleOfTheNodes) {
  Gap angles, sides;
  for (const RotorState& start : hub_states(78, 200)) {
    const TwoCharts k(start);
    const Mp &l = k.a[0], &g = k.a[1], &h = k.a[2], &L = k.a[3], &G = k.a[4], &H = k.a[5];
    const Mp sl = s(l), cl = c(l), sg = s(g), cg = c(g), sh = s(h), ch = c(h);
    const Mp side_L = root(G * G - L * L), side_H = root(G * G - H * H);
    const Mp &phi = k.x[0], &theta = k.x[1], &psi = k.x[2];
    angles.add(c(theta), L * H / (G * G) - cg / (G * G) * side_L * side_H);
    const Mp above = side_H * (G * sg * cl + L * sl * cg) + H * sl * side_L;
    const Mp below = -side_H * (G * sg * sl - L * cl * cg) + H * cl * side_L;
    angles.add(turned(psi - angle(above, below)), Mp(0));
    const Mp N = side_L * (G * sg * ch + H * sh * cg) + L * sh * side_H;
    const Mp D = side_L * (G * sg * sh - H * ch * cg) - L * ch * side_H;
    angles.add(turned(phi - angle(N, -D)), Mp(0));
    sides.add(cg, c(phi - h) * c(psi - l) - s(phi - h) * s(psi - l) * c(theta));
    const Vec cosines = (1 / G) * exact(k.state.g);
    const Mp lean = k.sJ * c(psi - l);
    sides.add(k.cI, c(theta) * k.cJ + s(theta) * lean);
    sides.add(lean, cosines[0] * s(psi) + cosines[1] * c(psi));
    sides.add(k.cI, c(theta) * cosines[2] + s(theta) * s(psi) * cosines[0] +
                        s(theta) * c(psi) * cosines[1]);
  }
  EXPECT_LT(angles.size(), budget::paper_library);
  EXPECT_LT(sides.size(), budget::paper_library);
}

// [SA (49), (50), (A2), (A3), (A52)] differentials of that triangle, for any variation
TEST(PaperAndoyer, LibraryDifferentialsOfTheTriangle) {
  Gap angles, integrand, differential;
  Random random(50);
  for (const RotorState& start : hub_states(50, 100)) {
    const TwoCharts k(start);
    const Phase d = random_variation(random);
    const Phase e = varied(canonical_transformation(k.state, from_andoyer, from_euler), d);
    const Mp &l = k.a[0], &g = k.a[1], &G = k.a[4], &theta = k.x[1], &psi = k.x[2];
    const Mp dx = e[0] - d[2], dy = e[2] - d[0], lean = s(psi - l);
    const Mp twist = k.cJ * dy - k.sJ * lean * e[1];
    angles.add(d[1] - k.cI * dx, twist);
    integrand.add(k.x[4] * e[1] + k.x[5] * e[2], G * k.cJ * d[0] + G * twist);
    const Mp sx = s(k.x[0] - k.a[2]), cx = c(k.x[0] - k.a[2]), cy = c(psi - l);
    const Mp ct = c(theta), st = s(theta), sg = s(g);
    differential.add(sg * d[1], (sx * cy + cx * lean * ct) * dx + (cx * lean + sx * cy * ct) * dy -
                                    sx * lean * st * e[1]);
    differential.add(sg * d[1], sg * k.cI * dx + sg * k.cJ * dy - sx * lean * st * e[1]);
    differential.add(sg * d[1], sg * k.cI * dx + sg * k.cJ * dy - lean * k.sJ * sg * e[1]);
  }
  EXPECT_LT(angles.size(), budget::paper_library);
  EXPECT_LT(integrand.size(), budget::paper_library);
  EXPECT_LT(differential.size(), budget::paper_library);
}

// [SA (A53)] at a fixed attitude
TEST(PaperAndoyer, LibraryVariationAtAFixedAttitude) {
  Gap gap;
  Random random(53);
  for (const RotorState& start : hub_states(53, 100)) {
    const TwoCharts k(start);
    Phase e = random_variation(random);
    for (std::size_t i = 0; i < 3; ++i) e[i] = 0;
    const Phase d = varied(canonical_transformation(k.state, from_euler, from_andoyer), e);
    gap.add(d[1], -k.cJ * d[0] - k.cI * d[2]);
  }
  EXPECT_LT(gap.size(), budget::paper_library);
}

// [SA "constraint", "hge0"] -G <= L <= G; the energy is between those of spins about b3 and b1
TEST(PaperAndoyer, LibraryBounds) {
  Random random(14);
  for (const RotorState& state : hub_states(14, 50)) {
    const AndoyerState a = to_andoyer(state);
    EXPECT_NO_THROW(andoyer_state(a.l, a.g, a.h, a.L, a.G, a.H));
    for (const double L : {1.01 * a.G, -1.01 * a.G})
      EXPECT_THROW(andoyer_state(a.l, a.g, a.h, L, a.G, a.H), DomainError);
    const Body body = body_of(random.moments());
    const double least = a.G * a.G / (2 * body.moments().z);
    const double greatest = a.G * a.G / (2 * body.moments().x), T = kinetic_energy(body, state);
    EXPECT_TRUE(0.0 < least && least <= T && T <= greatest);
    for (const double beyond : {0.99 * least, 1.01 * greatest})
      EXPECT_THROW(to_rotor(body, SerretState{0.1, 0.2, 0.3, a.G, a.H, beyond}, 0.0), DomainError);
  }
}

// [SA (52), (9995), (9996), (9997), "A.4, gdot", "A.4", "A.4, sum"] free rates of the angles from
// the invariable plane
TEST(PaperAndoyer, LibraryNodeRates) {
  Gap body_rates, rates;
  Random random(52);
  for (const RotorState& start : hub_states(52, 100)) {
    const TwoCharts k(start);
    const Vec I = random.moments();
    const Body body = body_of(I);
    const rates::AndoyerRates r = rates::andoyer_rates(System(body), 0.0, k.state);
    const Vec omega = exact(angular_velocity(body, k.state));
    const Mp &l = k.a[0], &G = k.a[4], J_rate = -Mp(r.L) / (G * k.sJ);
    body_rates.add(omega, Vec{r.g * k.sJ * s(l) + J_rate * c(l), r.g * k.sJ * c(l) - J_rate * s(l),
                              r.l + r.g * k.cJ});
    const Mp across = omega[0] * s(l) + omega[1] * c(l);
    rates.add(r.g * k.sJ, across);
    rates.add(r.l * k.cJ * k.sJ, omega[2] * k.cJ * k.sJ - squared(k.cJ) * across);
    rates.add(r.g + r.l * k.cJ, omega[2] * k.cJ + k.sJ * across);
    rates.add(r.g + k.cJ * r.l, 2 * Mp(kinetic_energy(body, k.state)) / G);
  }
  EXPECT_LT(body_rates.size(), budget::paper_library);
  EXPECT_LT(rates.size(), budget::paper_library);
}

// Derivatives of S at fixed attitude lose digits there: the sine between the third axis of the
// frame and the plane of g and omega, times that between g and omega.
bool is_near_caustic(const Body& body, const RotorState& s) {
  const Vec3 w = angular_velocity(body, s);
  const Vec3 s3 = rotate(conj(s.q), Vec3{0.0, 0.0, 1.0});
  return std::abs(dot(s3, cross(s.g, w))) < 0.05 * norm(s.g) * norm(w);
}

// S and its derivatives along a motion.
free::GeneratingFunction generated(const FreeRotation& motion, double t) {
  return free::generating_function(motion.body(), euler_angles(motion.at(t).q),
                                   to_serret(motion, t), t);
}

// [SA (45), (46), (47), (48)] S - T t - Phi phi is a line integral of Theta dtheta + Psi dpsi, here
// along the free motion at a fixed t; it jumps by a multiple of the action after a period
TEST(PaperSerret, LibrarySeparationOfTheGeneratingFunction) {
  Gap by_time, by_node, line;
  for (const AndoyerCase& e : branches(3)) {
    const RotorState start = hub_state(e);
    const Body body = body_of(e.I);
    const double t = 0.3, later = 0.8, angle = 0.4, span = 0.2;
    const FreeRotation motion(body, start, t);
    const free::GeneratingFunction f = generated(motion, t);
    const free::GeneratingFunction delayed = generated(FreeRotation(body, start, later), later);
    by_time.add(Mp(delayed.S) - Mp(f.S), Mp(f.minus_T) * (Mp(later) - Mp(t)));
    const RotorState about_s3{rotation_z(angle) * start.q, start.g};
    const free::GeneratingFunction rotated = generated(FreeRotation(body, about_s3, t), t);
    by_node.add(turned((Mp(rotated.S) - Mp(f.S)) / Mp(f.Phi) - Mp(angle)) * Mp(f.Phi), Mp(0));
    const auto integrand = [&](const Mp& x) {
      const RotorState at = motion.at(static_cast<double>(x));
      const EulerState p = to_euler(at);
      const EulerRates q = to_euler_rates(body, at);
      return Mp(p.Theta) * q.theta_dot + Mp(p.Psi) * q.psi_dot;
    };
    const RotorState moved = motion.at(t + span);
    const free::GeneratingFunction end = generated(FreeRotation(body, moved, t), t);
    const Mp passed = Mp(end.minus_t0) - Mp(f.minus_t0);
    if (magnitude(passed - Mp(span)) > Mp("1e-6")) continue;
    const Mp phi = turned(Mp(to_euler(moved).phi) - Mp(to_euler(start).phi));
    const Mp sum = Mp(f.Phi) * phi + integral(integrand, Mp(t), Mp(t + span));
    line.add(turned((Mp(end.S) - Mp(f.S) - sum) / Mp(e.a[4])), Mp(0));
  }
  EXPECT_LT(by_time.size(), budget::paper_generating);
  EXPECT_LT(by_node.size(), budget::paper_generating);
  EXPECT_LT(line.size(), budget::paper_generating);
}

// [SA (44), "identically nil"] along one motion S grows at T, which is S_q qdot - H; u/n - t is the
// constant -t0
TEST(PaperSerret, LibraryGeneratingFunctionAlongTheMotion) {
  Gap growth, elapsed_gap;
  int count = 0;
  for (const AndoyerCase& e : branches(20)) {
    const Body body = body_of(e.I);
    const RotorState start = hub_state(e);
    const FreeRotation motion(body, start);
    const double t = 0.5;
    const free::GeneratingFunction f = generated(motion, 0.0);
    const free::GeneratingFunction later =  // on the branch of f
        free::generating_function(body, euler_angles(motion.at(t).q), to_serret(motion, 0.0), t);
    if (is_near_caustic(body, start) || is_near_caustic(body, motion.at(t))) continue;
    elapsed_gap.add(Mp(later.minus_t0), Mp(f.minus_t0));
    ++count;
    const EulerRates q = to_euler_rates(body, start);
    const Mp action_rate =
        Mp(f.Phi) * q.phi_dot + Mp(f.Theta) * q.theta_dot + Mp(f.Psi) * q.psi_dot;
    const Mp slope = (Mp(later.S) - Mp(f.S)) / Mp(t);
    growth.add(Mp(kinetic_energy(body, start)) + slope - action_rate, Mp(0));
  }
  EXPECT_GT(count, 10);
  EXPECT_LT(growth.size(), budget::paper_generating);
  EXPECT_LT(elapsed_gap.size(), budget::paper_generating);
}

// [SA (36), (41)] the constants are canonical: d(theta_B, g_B)/d(g0, h, -t0, G, H, T) brings the
// standard brackets to those of the hub
TEST(PaperSerret, LibrarySerretIsCanonical) {
  Gap gap;
  for (const AndoyerCase& e : branches(3)) {
    const Body body = body_of(e.I);
    const RotorState start = hub_state(e);
    const Matrix6 B = chart_jacobian(body, to_serret(FreeRotation(body, start), 0.0), 0.0);
    add_poisson_defect(gap, B, exact(start.g));
  }
  EXPECT_LT(gap.size(), budget::paper_library_brackets);
}

}  // namespace
}  // namespace polhode::paper
