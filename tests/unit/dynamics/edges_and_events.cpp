// SPDX-License-Identifier: MIT
// The same function as an event and as a switching function of a term: a run steps to every zero
// that an event reports, and to no other.
#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "budgets.hpp"
#include "polhode/dynamics/integrate.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "polhode/perturb/gravity_gradient.hpp"
#include "polhode/perturb/torque_table.hpp"
#include "polhode/perturb/user_terms.hpp"
#include "worst.hpp"

namespace polhode {
namespace {

using polhode::test::larger;
using polhode::test::smaller;

constexpr double turn = 2.0 * std::numbers::pi;

struct Case {
  std::string name;
  System system;
  RotorState initial;
  double stop;
  std::function<double(double, const RotorState&)> function;
  std::size_t zeros;    // changes of sign
  double torque = 0.0;  // times the side, about axis 3
};

double height(const RotorState& s, const Vec3& axis) { return rotate(s.q, axis).z; }

std::vector<Case> cases() {
  const Body nut(30.53, 83.87, 113.3), tumbler(1.0, 2.0, 3.0), top(1.0, 1.0, 1.5);
  const RotorState flips{{}, {0.01 * 30.53, 6.28 * 83.87, 0.0}}, tumbles{{}, {0.4, 1.9, 0.8}};
  const RotorState spins{{}, {0.0, 0.0, 1.5}};
  const AnyPerturbation moon(
      "moon",
      GravityGradient(0.1, KeplerOrbit({.gm = 1.0, .pericentre = 0.9, .eccentricity = 0.1})));
  const AnyPerturbation saw(
      "saw", TorqueTable({{0.0, {}}, {1.0, {0, 0, 1.0}}, {3.0, {0, 0, -1.0}}, {5.0, {}}}, {}));
  const auto qw = [](double, const RotorState& s) { return s.q.w; };
  const auto dip = [](double depth) {  // of 1 + cos t, once a turn
    return [depth](double, const RotorState& s) {
      return 1.0 + rotate(s.q, {1.0, 0.0, 0.0}).x - depth;
    };
  };
  // away^2 - R^2 behind a sphere, along a circular orbit of 8 time units
  const auto shadow = [](double t, const RotorState&) {
    const double x = std::cos(turn * t / 8.0), y = std::sin(turn * t / 8.0);
    return y * y + larger(x, 0.0) * larger(x, 0.0) - 0.09;
  };
  return {
      {"qw of a wing nut", System(nut), flips, 40.0, qw, 44},
      {"qw of a tumbler", System(tumbler), tumbles, 2045.0, qw, 305},
      {"flips", System(nut), flips, 40.0, [](double, const RotorState& s) { return s.g.y; }, 11},
      {"two zeros, near", System(top), spins, 40.0, dip(1e-3), 12},
      {"two zeros, nearer", System(top), spins, 40.0, dip(1e-6), 12},
      {"touches", System(top), spins, 40.0, dip(0.0), 0},
      {"eclipses", System(top), spins, 80.0, shadow, 20},
      {"in a gravity gradient", System(tumbler, Frame::inertial(), {moon}), tumbles, 60.0,
       [](double, const RotorState& s) {
         return height(s, {1.0, 0.0, 0.0});
       },
       24},
      {"through a table",
       System(Body(1.0, 1.0, 1.0), Frame::inertial(), {saw}),
       {{}, {0.0, 0.0, 1.0}},
       5.0,
       [](double, const RotorState& s) { return s.g.z - 1.95; },
       2},
      {"bang-bang", System(top), spins, 60.0,
       [](double, const RotorState& s) { return s.q.w * s.q.w - s.q.z * s.q.z; }, 19, 0.02},
      {"bang-bang of the rate", System(tumbler, Frame::inertial(), {moon}), tumbles, 100.0,
       [](double, const RotorState& s) { return s.g.x; }, 4, 0.02},
  };
}

class EdgesAndEvents : public testing::TestWithParam<Method> {};
INSTANTIATE_TEST_SUITE_P(Methods, EdgesAndEvents,
                         testing::Values(Method(Adaptive{}), Method(Collocation{})));

TEST_P(EdgesAndEvents, AreTheSameZeros) {
  for (const Case& c : cases()) {
    // one entry each time that the torque is asked for on another side
    const auto crossed = std::make_shared<std::vector<double>>();
    const auto torque = [crossed, size = c.torque](const auto&, const auto& s,
                                                   std::span<const double> sides) {
      using T = std::decay_t<decltype(s.g.x)>;
      if (crossed->empty() || crossed->back() != sides[0]) crossed->push_back(sides[0]);
      return BasicVec3<T>{T(0.0), T(0.0), T(size * sides[0])};
    };
    std::vector<AnyPerturbation> terms = c.system.terms();
    terms.emplace_back("switch", SwitchedTorqueTerm(torque, [&c](double t, const RotorState& s) {
                         return std::vector{c.function(t, s)};
                       }));
    Problem problem{System(c.system.body(), c.system.frame(), terms),
                    c.initial,
                    0.0,
                    c.stop,
                    GetParam(),
                    {{"zero", c.function}}};
    const Trajectory run = integrate(problem);
    ASSERT_TRUE(run.outcome().ok()) << c.name << ": " << run.outcome().advice;
    // the search for events asks for torques too
    problem.events.clear();
    crossed->clear();
    integrate(problem);
    EXPECT_EQ(crossed->size() - 1, c.zeros) << c.name;
    std::size_t events = 0;
    for (const EventRecord& event : run.events()) {
      if (event.direction == 0) continue;  // a touch changes no side
      ++events;
      double apart = c.stop;
      for (const Sample& end : run.samples()) apart = smaller(apart, std::fabs(end.t - event.t));
      EXPECT_LE(apart, budget::time_of_zero * (1.0 + event.t)) << c.name << " " << event.t;
    }
    EXPECT_EQ(events, c.zeros) << c.name;
  }
}

}  // namespace
}  // namespace polhode
