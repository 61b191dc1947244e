// SPDX-License-Identifier: MIT
// Sadov's and Serret's sets: round trip through the hub, canonicity and derivatives against those
// of the oracle, at generic points and down to 1e-12 from J = 0, J = pi/2 about the long axis, I =
// 0 and the separatrix.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "budgets.hpp"
#include "oracle/flow_adapted.hpp"
#include "polhode/free/sadov.hpp"
#include "polhode/free/serret.hpp"
#include "worst.hpp"

namespace polhode {
namespace {

using polhode::test::larger;
using polhode::test::Worst;

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

// What the variables of a state determine, by the oracle: nothing here asks the library.
struct Determined {
  Matrix6 B;                      // the derivatives of the state
  Matrix6 size;                   // their moduli, with what the oracle rounds
  std::array<double, 6> numbers;  // that are rounded
  double closeness;               // of the separatrix and the axes, where B is singular
};

// max_i sum_j |B_ij S_j|: what relative roundings of the chart's numbers do to the hub.
double sensitivity(const Determined& d) {
  Worst largest;
  for (int i = 0; i < 6; ++i) {
    double sum = 0.0;
    for (int j = 0; j < 6; ++j) sum += std::abs(d.B(i, j) * d.numbers[static_cast<std::size_t>(j)]);
    largest.add(sum);
  }
  return largest.value();
}

double distance(const RotorState& a, const RotorState& b) {
  const Quaternion r = conj(normalized(a.q)) * normalized(b.q);
  return larger(2.0 * norm(Vec3{r.x, r.y, r.z}), norm(a.g - b.g));
}

// The largest |B J B^T - Pi|_ab over eps (|C| |J| |C^T|)_ab, C the oracle's B.
double symplectic_defect(const Matrix6& B, const Matrix6& C, const Vec3& g) {
  Matrix6 J, J_abs, C_abs, Pi;
  for (int i = 0; i < 3; ++i) {
    J(i, i + 3) = Pi(i, i + 3) = J_abs(i, i + 3) = J_abs(i + 3, i) = 1.0;
    J(i + 3, i) = Pi(i + 3, i) = -1.0;
  }
  const Mat3 cross_g = hat(g);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) Pi(3 + i, 3 + j) = cross_g(i, j);
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) C_abs(i, j) = std::abs(C(i, j));
  const Matrix6 product = B * J * transpose(B), size = C_abs * J_abs * transpose(C_abs);
  Worst worst;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) {
      const double defect = std::abs(product(i, j) - Pi(i, j));
      worst.add(defect == 0.0 ? 0.0 : defect / (eps * size(i, j)));
    }
  return worst.value();
}

// Of every column, relative to the largest entry of the oracle's.
double difference(const Matrix6& B, const Matrix6& C) {
  Worst worst;
  for (int j = 0; j < 6; ++j) {
    Worst size, off;
    for (int i = 0; i < 6; ++i) {
      size.add(std::abs(C(i, j)));
      off.add(std::abs(B(i, j) - C(i, j)));
    }
    worst.add(off.value() / size.value());
  }
  return worst.value();
}

void expect_laws(const Determined& d, const Matrix6& B, const RotorState& back,
                 const RotorState& state) {
  EXPECT_LE(distance(back, state),
            budget::flow_round_trip + budget::flow_round_trip_eps * eps * sensitivity(d));
  EXPECT_LE(symplectic_defect(B, d.size, back.g), budget::flow_canonical_eps);
  EXPECT_LE(difference(B, d.B),
            budget::flow_jacobian + budget::flow_jacobian_eps * eps / d.closeness);
}

// The time since t0 is within half a period and leads from t0 to the state.
double elapsed_since(const SerretState& s, double t, const oracle::FlowAdapted& motion) {
  const double elapsed = t - s.t0;
  EXPECT_LE(std::abs(elapsed), (0.5 + budget::flow_phase) * motion.period());
  EXPECT_LE(motion.miss(elapsed), budget::flow_phase);
  return elapsed;
}

double closeness(const Case& c) {
  const Vec3 I = c.body.moments(), &g = c.state.g;
  const double G2 = dot(g, g), twice_T = g.x * g.x / I.x + g.y * g.y / I.y + g.z * g.z / I.z;
  Worst least;
  for (const double moment : {I.x, I.y, I.z}) least.add(-std::abs(twice_T * moment / G2 - 1.0));
  return -least.value();
}

void expect_sadov_laws(const Case& c) {
  const FreeRotation motion(c.body, c.state);
  for (const double t : {0.0, 17.7}) {
    const RotorState state = motion.at(t);
    const SadovState s = to_sadov(motion, t);
    const oracle::FlowAdapted exact(c.body.moments(), state);
    const double elapsed = elapsed_since(to_serret(motion, t), t, exact);
    const Matrix6 C = exact.by_sadov(elapsed);
    for (const double angle : {s.phi_l, s.phi_g, s.phi_h}) EXPECT_LE(std::abs(angle), pi<double>());
    const Determined d{
        C,
        exact.size_by_sadov(elapsed),
        {s.phi_l, s.phi_g, s.phi_h, exact.action(), exact.momentum(), exact.vertical_momentum()},
        closeness(c)};
    expect_laws(d, chart_jacobian(c.body, s), to_rotor(c.body, s), state);
  }
}

void expect_serret_laws(const Case& c) {
  const FreeRotation motion(c.body, c.state);
  for (const double t : {0.0, 17.7}) {
    const RotorState state = motion.at(t);
    const SerretState s = to_serret(motion, t);
    const oracle::FlowAdapted exact(c.body.moments(), state);
    const Matrix6 C = exact.by_serret(elapsed_since(s, t, exact));
    for (const double angle : {s.g0, s.h}) EXPECT_LE(std::abs(angle), pi<double>());
    const Determined d{
        C,
        C,
        {s.g0, s.h, s.t0, exact.momentum(), exact.vertical_momentum(), 0.5 * exact.twice_energy()},
        closeness(c)};
    expect_laws(d, chart_jacobian(c.body, s, t), to_rotor(c.body, s, t), state);
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
