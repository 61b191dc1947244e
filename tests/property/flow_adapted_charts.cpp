// SPDX-License-Identifier: MIT
// Sadov's and Serret's sets: round trip through the hub and canonicity, at generic points and down
// to 1e-12 from J = 0, J = pi/2 about the long axis, I = 0 and the separatrix.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "budgets.hpp"
#include "polhode/free/sadov.hpp"
#include "polhode/free/serret.hpp"
#include "worst.hpp"

namespace polhode {
namespace {

using polhode::test::larger;

constexpr double eps = 0x1p-52;

struct Case {
  Body body;
  RotorState state;
};

// Moments and a state; the momentum is of order 1.
Case random_case(std::mt19937_64& random) {
  std::uniform_real_distribution<double> u(-1.0, 1.0), moment(0.5, 3.0);
  for (;;) {
    const double a = moment(random), b = moment(random), c = moment(random);
    if (2.0 * larger(a, b, c) > a + b + c) continue;
    const Quaternion q = normalized(Quaternion{u(random), u(random), u(random), u(random)});
    return {Body(a, b, c), {q, {u(random), u(random), u(random)}}};
  }
}

// Momenta at a distance of 1e-1 .. 1e-12 from the axes 1 and 3 and from the separatrix of (3, 4,
// 6).
std::vector<Case> near_singular_cases() {
  std::vector<Case> cases;
  std::mt19937_64 random(20261121);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  const Body body(3.0, 4.0, 6.0);
  for (int k = 1; k <= 12; ++k) {
    const double d = std::pow(10.0, -k);
    for (const double side : {1.0, -1.0}) {
      const Quaternion q = normalized(Quaternion{u(random), u(random), u(random), u(random)});
      if (k <= 6) {
        cases.push_back({body, {q, {d, 0.7 * d, side}}});
        cases.push_back({body, {q, {side, 0.7 * d, d}}});
      }
      cases.push_back({body, {q, {0.8 * (1.0 + side * d), -0.4, 0.8}}});
    }
  }
  return cases;
}

// max_i sum_j |B_ij S_j|: what relative roundings of the chart's numbers do to the hub.
double sensitivity(const Matrix6& B, const double (&s)[6]) {
  double largest = 0.0;
  for (int i = 0; i < 6; ++i) {
    double sum = 0.0;
    for (int j = 0; j < 6; ++j) sum += std::abs(B(i, j) * s[j]);
    largest = larger(largest, sum);
  }
  return largest;
}

double distance(const RotorState& a, const RotorState& b) {
  const Quaternion r = conj(normalized(a.q)) * normalized(b.q);
  return larger(2.0 * norm(Vec3{r.x, r.y, r.z}), norm(a.g - b.g));
}

// The largest |B J B^T - Pi|_ab over eps (|B| |J| |B^T|)_ab.
double symplectic_defect(const Matrix6& B, const Vec3& g) {
  Matrix6 J, J_abs, B_abs, Pi;
  for (int i = 0; i < 3; ++i) {
    J(i, i + 3) = Pi(i, i + 3) = J_abs(i, i + 3) = J_abs(i + 3, i) = 1.0;
    J(i + 3, i) = Pi(i + 3, i) = -1.0;
  }
  const Mat3 cross_g = hat(g);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) Pi(3 + i, 3 + j) = cross_g(i, j);
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) B_abs(i, j) = std::abs(B(i, j));
  const Matrix6 product = B * J * transpose(B), size = B_abs * J_abs * transpose(B_abs);
  double worst = 0.0;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j)
      if (product(i, j) != Pi(i, j))
        worst = larger(worst, std::abs(product(i, j) - Pi(i, j)) / (eps * size(i, j)));
  return worst;
}

void expect_sadov_laws(const Case& c) {
  const FreeRotation motion(c.body, c.state);
  for (const double t : {0.0, 17.7}) {
    const SadovState s = to_sadov(motion, t);
    const Matrix6 B = chart_jacobian(c.body, s);
    const double numbers[6] = {s.phi_l, s.phi_g, s.phi_h, s.I_l, s.I_g, s.I_h};
    const RotorState back = to_rotor(c.body, s);
    EXPECT_LE(
        distance(back, motion.at(t)),
        budget::flow_round_trip + budget::flow_round_trip_eps * eps * sensitivity(B, numbers));
    EXPECT_LE(symplectic_defect(B, back.g), budget::flow_canonical_eps);
  }
}

void expect_serret_laws(const Case& c) {
  const FreeRotation motion(c.body, c.state);
  for (const double t : {0.0, 17.7}) {
    const SerretState s = to_serret(motion, t);
    const Matrix6 B = chart_jacobian(c.body, s, t);
    const double numbers[6] = {s.g0, s.h, s.t0, s.G, s.H, s.T};
    const RotorState back = to_rotor(c.body, s, t);
    EXPECT_LE(
        distance(back, motion.at(t)),
        budget::flow_round_trip + budget::flow_round_trip_eps * eps * sensitivity(B, numbers));
    EXPECT_LE(symplectic_defect(B, back.g), budget::flow_canonical_eps);
  }
}

TEST(FlowAdaptedCharts, SadovAtRandomStates) {
  std::mt19937_64 random(7);
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE(i);
    expect_sadov_laws(random_case(random));
  }
}

TEST(FlowAdaptedCharts, SerretAtRandomStates) {
  std::mt19937_64 random(8);
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE(i);
    expect_serret_laws(random_case(random));
  }
}

TEST(FlowAdaptedCharts, SadovNextToItsSingularities) {
  int i = 0;
  for (const Case& c : near_singular_cases()) {
    SCOPED_TRACE(i++);
    expect_sadov_laws(c);
  }
}

TEST(FlowAdaptedCharts, SerretNextToItsSingularities) {
  int i = 0;
  for (const Case& c : near_singular_cases()) {
    SCOPED_TRACE(i++);
    expect_serret_laws(c);
  }
}

}  // namespace
}  // namespace polhode
