// SPDX-License-Identifier: MIT
// What a state loses on the way through every chart, and how canonical the charts are: at generic
// states and at distances down to 1e-12 from where each is singular. A seeded sample, or the full
// counts when POLHODE_TEST_FULL is set. tools/accuracy/charts.py writes the properties recorded
// here into docs/accuracy/charts.md.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "budgets.hpp"
#include "oracle/flow_adapted.hpp"
#include "oracle/free_cases.hpp"
#include "polhode/free/sadov.hpp"
#include "polhode/free/serret.hpp"
#include "polhode/free/tumbler.hpp"
#include "polhode/rotor/attitude.hpp"
#include "property/chart_support.hpp"
#include "property/wide_jacobian.hpp"
#include "worst.hpp"

namespace {

using namespace chart_test;
using namespace oracle;
using namespace polhode;
using polhode::test::larger;
using polhode::test::smaller;

struct Case {
  Body body;
  RotorState state;  // |g| = 1
};

// What one set did to one state; bounds are what the headers promise.
struct Loss {
  double round_trip;
  double allowed;
  std::optional<double> defect = {};  // of B, in eps of its terms
  double defect_allowed = budget::symplectic_eps;
};

// --- states ---

Body triaxial(Draw& draw, const std::array<int, 3>& axis) {
  for (;;) {
    const auto I = oracle::detail::triaxial_moments(draw);
    if (I[1] - I[0] < 0.05 * I[0] || I[2] - I[1] < 0.05 * I[1]) continue;
    std::array<double, 3> moments{};
    for (std::size_t i = 0; i < 3; ++i) moments[static_cast<std::size_t>(axis[i])] = I[i];
    return {moments[0], moments[1], moments[2]};
  }
}

// Components (long, middle, short) of a unit momentum at the distance named.
using Along = std::array<double, 3>;
Along along_near_spin(Draw& draw, std::size_t axis, double distance) {
  return oracle::detail::direction_near_axis(draw, axis, distance * draw.uniform(1.0, 2.0));
}
// |G^2 - 2 T I2| = distance G^2, both sides.
Along along_near_separatrix(Draw& draw, const Along& I, double distance) {
  const double A = (I[2] - I[1]) / I[2], C = (I[1] - I[0]) / I[0];
  const double middle = draw.uniform(-0.5, 0.5), across = 1.0 - middle * middle;
  const double D2 = draw.sign() * distance;
  return {draw.sign() * std::sqrt((A * across - D2) / (A + C)), middle,
          draw.sign() * std::sqrt((C * across + D2) / (A + C))};
}

enum class Place { generic, J, I, theta, long_spin, short_spin, separatrix };
struct Region {
  Place place;
  const char* name;
  double closest = 1e-12;
};

Case drawn(Place place, double distance, std::uint64_t index) {
  Draw draw(20261122, index);
  Sampler sample(20261122 + index);
  std::array<int, 3> axis{0, 1, 2};
  std::swap(axis[0], axis[draw.index(3)]);
  std::swap(axis[1], axis[1 + draw.index(2)]);
  const Body body = triaxial(draw, axis);
  const auto tilted = [&](double J, double I) {
    return inclined_state({J, sample.coin(), I, sample.coin()}, sample.angle(), sample.angle(),
                          sample.angle());
  };
  const double near = distance * sample.uniform(1.0, 2.0), far = sample.uniform(0.2, 1.5);
  if (place == Place::J) return {body, tilted(near, far)};
  if (place == Place::I) return {body, tilted(far, near)};
  if (place == Place::theta) {
    const double half_turns = sample.coin() ? 1.0 : 0.0;
    const Quaternion flip{1.0 - half_turns, half_turns, 0.0, 0.0};
    return {body,
            {rotation_z(sample.angle()) * flip * rotation_x(near) * rotation_z(sample.angle()),
             sample.generic().g}};
  }
  RotorState s = sample.generic();
  if (place == Place::generic) return {body, s};
  const Vec3 moments = body.moments();
  const Along I{moments[axis[0]], moments[axis[1]], moments[axis[2]]};
  const Along g = place == Place::separatrix
                      ? along_near_separatrix(draw, I, distance)
                      : along_near_spin(draw, place == Place::long_spin ? 0 : 2, distance);
  for (std::size_t i = 0; i < 3; ++i) s.g[axis[i]] = g[i];
  return {body, s};
}

// --- sets ---

// Of B, in units of the terms of another B.
double canonical_defect(const Matrix6& B, const Matrix6& exact, const Vec3& g) {
  return symplectic_defect(B, canonical_tensor(), hub_tensor(g), exact);
}
double canonical_defect(const CanonicalChart& chart, const RotorState& s) {
  return canonical_defect(chart_jacobian(s, chart), wide_jacobian(chart, s), s.g);
}

// The vertical of space along the body axes, and the sines that say how near a state is to where a
// set is singular: of theta, J and I. By hand, so that no set allows itself anything.
std::array<double, 3> vertical(const RotorState& s) {
  const auto& [w, x, y, z] = normalized(s.q);
  return {2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)};
}
double sine_of_theta(const RotorState& s) { return std::hypot(vertical(s)[0], vertical(s)[1]); }
double sine_of_J(const RotorState& s) { return std::hypot(s.g.x, s.g.y) / norm(s.g); }
double sine_of_I(const RotorState& s) {
  const auto& [x, y, z] = vertical(s);
  return norm(cross(s.g, Vec3{x, y, z})) / norm(s.g);
}
// The rate of the node, (w x n_z) . n_z / sin^2 theta in the plane of the equator.
double rate_of_node(const Case& c) {
  const auto& [x, y, z] = vertical(c.state);
  const Vec3 I = c.body.moments(), &g = c.state.g;
  return (g.x / I.x * x + g.y / I.y * y) / (x * x + y * y);
}

std::optional<Loss> rate_loss(const Case& c) {
  const Vec3 w = angular_velocity(c.body, c.state);
  return Loss{hub_difference(rotor_state(c.body, c.state.q, w), c.state), budget::chart_rounding};
}
std::optional<Loss> matrix_loss(const Case& c) {
  const Quaternion q = attitude(transpose(rotation_matrix(c.state.q)));
  return Loss{hub_difference({q, c.state.g}, c.state), budget::chart_rounding};
}
std::optional<Loss> euler_rates_loss(const Case& c) {
  const auto e = to_euler_rates(c.body, c.state);
  const Vec3 I = c.body.moments();
  const double largest = larger(I.x, I.y, I.z);
  return Loss{
      hub_difference(to_rotor(c.body, e), c.state),
      budget::chart_rounding + budget::euler_pole_eps * eps * largest * std::abs(rate_of_node(c))};
}
std::optional<Loss> euler_loss(const Case& c) {
  const auto e = to_euler(c.state);
  return Loss{hub_difference(to_rotor(e), c.state),
              budget::chart_rounding + budget::euler_pole_eps * eps / sine_of_theta(c.state),
              canonical_defect({CanonicalSet::euler}, c.state)};
}
std::optional<Loss> andoyer_loss(const Case& c) {
  const auto a = to_andoyer(c.state);
  const double sine = smaller(sine_of_J(c.state), sine_of_I(c.state));
  return Loss{
      hub_difference(to_rotor(a), c.state),
      budget::chart_rounding + smaller(budget::andoyer_pole_eps * eps / sine, budget::andoyer_pole),
      canonical_defect({CanonicalSet::andoyer}, c.state)};
}
std::optional<Loss> poincare_loss(const Case& c) {
  const auto p = nearest_poincare(c.state);
  return Loss{hub_difference(to_rotor(p), c.state), budget::poincare,
              canonical_defect({CanonicalSet::poincare, p.pole_J, p.pole_I}, c.state)};
}
// Next to a pole the numbers of a set that holds J or I by a sum of momenta round to the pole: the
// state keeps half of its digits, and B at those numbers has no meaning.
Loss flow_loss(const Case& c, const RotorState& back, const Matrix6& B, const Matrix6& size,
               const Numbers& numbers, bool at_pole) {
  const double error = hub_difference(back, c.state);
  if (at_pole) return {error, budget::flow_pole};
  return {error,
          budget::flow_round_trip + budget::flow_round_trip_eps * eps * amplified(size, numbers),
          canonical_defect(B, size, back.g), budget::flow_canonical_eps};
}
constexpr double pole_distance = 1e-7;  // sqrt(eps), and some

// The time since t0, which leads from t0 to the state. Next to an axis t0 rounds to anything.
double elapsed_since(const SerretState& s, const FlowAdapted& motion) {
  EXPECT_LE(std::abs(s.t0), (0.5 + budget::flow_phase) * motion.period());
  return -s.t0;
}
// The derivatives are the oracle's at the phase the library gives; so that this is the phase, the
// oracle comes to the state from there.
void expect_phase(const FlowAdapted& motion, double elapsed, bool at_pole) {
  EXPECT_LE(motion.miss(elapsed), at_pole ? budget::flow_pole : budget::flow_phase);
}

std::optional<Loss> sadov_loss(const Case& c) {
  const FreeRotation motion(c.body, c.state);
  const auto s = to_sadov(motion, 0.0);
  const FlowAdapted exact(c.body.moments(), c.state);
  const bool spin = !exact.long_axis() && exact.sine_of_action() < pole_distance;
  const bool at_pole = spin || exact.sine_of_tilt() < pole_distance;
  const double elapsed = elapsed_since(to_serret(motion, 0.0), exact);
  expect_phase(exact, elapsed, at_pole);
  return flow_loss(
      c, to_rotor(c.body, s), chart_jacobian(c.body, s), exact.size_by_sadov(elapsed),
      {s.phi_l, s.phi_g, s.phi_h, exact.action(), exact.momentum(), exact.vertical_momentum()},
      at_pole);
}
std::optional<Loss> serret_loss(const Case& c) {
  const auto s = to_serret(FreeRotation(c.body, c.state), 0.0);
  const FlowAdapted exact(c.body.moments(), c.state);
  const Vec3 I = c.body.moments();
  const double energy = exact.twice_energy() / (exact.momentum() * exact.momentum());
  const double across_1 = 1.0 - energy * smaller(I.x, I.y, I.z);
  const double across_3 = energy * larger(I.x, I.y, I.z) - 1.0;
  const double least = pole_distance * pole_distance;
  const bool at_pole = across_1 < least || across_3 < least || exact.sine_of_tilt() < pole_distance;
  const double elapsed = elapsed_since(s, exact);
  expect_phase(exact, elapsed, at_pole);
  return flow_loss(
      c, to_rotor(c.body, s, 0.0), chart_jacobian(c.body, s, 0.0), exact.by_serret(elapsed),
      {s.g0, s.h, s.t0, exact.momentum(), exact.vertical_momentum(), 0.5 * exact.twice_energy()},
      at_pole);
}
constexpr double psi_share = 0.9;  // psi stands still at psi_max, and holds half of the digits
std::optional<Loss> tumbler_loss(const Case& c) {
  const FreeRotation motion(c.body, c.state);
  const auto s = to_tumbler(motion, 0.0);
  const double psi = s.sense > 0 ? s.psi0 : angle_difference(s.psi0, 3.141592653589793);
  if (std::abs(psi) > psi_share * psi_max(motion)) return std::nullopt;
  const Vec3 I = c.body.moments();
  double J = 1.0;  // sine of the angle between the momentum and the nearer axis of circulation
  for (int i = 0; i < 3; ++i) {
    const bool middle = I[i] < larger(I.x, I.y, I.z) && I[i] > smaller(I.x, I.y, I.z);
    if (!middle) J = smaller(J, std::hypot(c.state.g[(i + 1) % 3], c.state.g[(i + 2) % 3]));
  }
  return Loss{
      hub_difference(to_rotor(c.body, s), c.state),
      budget::chart_rounding + smaller(budget::tumbler_spin_eps * eps / J, budget::tumbler_spin)};
}

struct Set {
  const char* name;
  std::optional<Loss> (*loss)(const Case&);
  std::vector<Region> regions;  // besides the generic one
};

const std::vector<Set>& sets() {
  const Region J{Place::J, "J"}, I{Place::I, "I"}, theta{Place::theta, "theta"};
  const Region long_spin{Place::long_spin, "long_spin"},
      short_spin{Place::short_spin, "short_spin"};
  const Region separatrix{Place::separatrix, "separatrix"};
  static const std::vector<Set> all{
      {"rate", rate_loss, {}},
      {"matrix", matrix_loss, {}},
      {"euler_rates", euler_rates_loss, {theta}},
      {"euler", euler_loss, {theta}},
      {"andoyer", andoyer_loss, {J, I}},
      {"poincare", poincare_loss, {J, I}},
      {"serret", serret_loss, {short_spin, long_spin, I, separatrix}},
      {"sadov", sadov_loss, {short_spin, long_spin, I, separatrix}},
      // at 1e-12 from the separatrix many a pair of periods is refused
      {"tumbler",
       tumbler_loss,
       {short_spin, long_spin, I, {Place::separatrix, "separatrix", 1e-10}}}};
  return all;
}

// --- the survey ---

std::string digits(double x) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.1e", x);
  return text.data();
}

void survey(const Set& set, const Region& region, double distance, std::size_t count) {
  std::vector<double> losses;
  double defect = -1.0;
  for (std::uint64_t i = 0; losses.size() < count; ++i) {
    const Case c = drawn(region.place, distance, i);
    const std::optional<Loss> loss = set.loss(c);
    if (!loss) continue;
    losses.push_back(loss->round_trip);
    EXPECT_LE(loss->round_trip, loss->allowed)
        << set.name << ", " << region.name << " " << distance << ", state " << i;
    if (!loss->defect) continue;
    defect = larger(defect, *loss->defect);
    EXPECT_LE(*loss->defect, loss->defect_allowed)
        << set.name << ", " << region.name << " " << distance << ", state " << i;
  }
  const std::string key = std::string(region.name) + (distance < 1.0 ? digits(distance) : "");
  std::ranges::sort(losses);
  testing::Test::RecordProperty(key + "_count", std::to_string(count));
  testing::Test::RecordProperty(key + "_median", digits(losses[count / 2]));
  testing::Test::RecordProperty(key + "_max", digits(losses.back()));
  if (defect >= 0.0) testing::Test::RecordProperty(key + "_defect", digits(defect));
}

class ChartAccuracy : public testing::TestWithParam<std::size_t> {};

TEST_P(ChartAccuracy, OfHubToSetAndBack) {
  const bool full = std::getenv("POLHODE_TEST_FULL") != nullptr;
  const Set& set = sets()[GetParam()];
  survey(set, {Place::generic, "generic"}, 1.0, full ? 1000 : 100);
  for (const Region& region : set.regions)
    for (const double distance : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12})
      if (distance > 0.5 * region.closest) survey(set, region, distance, full ? 500 : 20);
}

INSTANTIATE_TEST_SUITE_P(Every, ChartAccuracy, testing::Range<std::size_t>(0, sets().size()),
                         [](const auto& set) { return std::string(sets()[set.param].name); });

}  // namespace
