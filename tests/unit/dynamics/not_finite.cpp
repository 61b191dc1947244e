// SPDX-License-Identifier: MIT
// A number of a user's term that is NaN ends a run with a sentence, whichever component it is and
// whichever stage of a step sees it: no method takes it for a small error.
#include <gmock/gmock.h>

#include <cmath>
#include <string>
#include <vector>

#include "polhode/dynamics/integrate.hpp"
#include "polhode/perturb/kane_damper.hpp"
#include "polhode/perturb/user_terms.hpp"

namespace {

using namespace polhode;
using testing::HasSubstr;

const Body body(1.0, 2.0, 2.7);
const RotorState tumbling{{0.5, 0.5, -0.5, 0.5}, {0.8, 1.9, 0.3}};
const RotorState resting{{0.5, 0.5, -0.5, 0.5}, {0.0, 0.0, 0.0}};
constexpr double stop = 10.0;

// A torque that has no value from a time on.
struct BrokenTorque {
  static constexpr bool kick = true;
  int component;
  double from;

  template <Real T>
  BasicEffect<T> effect(const BasicSetting<T>& at) const {
    BasicEffect<T> e{};
    if (to_double(at.t) >= from) e.u[component] = T(std::nan(""));
    return e;
  }
};
struct BrokenMotion {
  int component;
  double from;

  template <Real T>
  BasicEffect<T> effect(const BasicSetting<T>& at) const {
    BasicEffect<T> e{};
    if (to_double(at.t) >= from) e.v[component] = T(std::nan(""));
    return e;
  }
};

bool is_finite(const RotorState& s) {
  return std::isfinite(s.q.w + s.q.x + s.q.y + s.q.z + s.g.x + s.g.y + s.g.z);
}

void expect_said(const Problem& problem, double from, const std::string& name) {
  const Trajectory run = integrate(problem, {SaveAt::steps(0.0, stop, 0.5)});
  EXPECT_EQ(run.outcome().status, Outcome::Status::failed) << name;
  EXPECT_THAT(run.outcome().advice, HasSubstr("\"jet\"")) << name;
  EXPECT_LE(run.stop(), from) << name;
  for (const Sample& sample : run.samples()) EXPECT_TRUE(is_finite(sample.s)) << name;
}

struct NamedMethod {
  std::string name;
  Method method;
};
const std::vector<NamedMethod> methods{
    {"Adaptive", Adaptive{}},
    {"in double-double", Adaptive{1e-20, Precision::double_double}},
    {"Splitting", Splitting{.step = 0.125}},
    {"VariationOfConstants", VariationOfConstants{}},
    {"Collocation", Collocation{}}};

// Gauss' nodes and the kicks of a splitting lie inside a step: its very end is not asked for.
std::vector<double> times(const Method& method) {
  if (std::holds_alternative<Adaptive>(method)) return {4.0, stop};
  return {4.0};
}

// At its end a run is asked only by stages at the end of a step, and of a body at rest they change
// nothing else.
TEST(NotFinite, AnyComponentOfATorqueIsSaid) {
  for (const NamedMethod& m : methods)
    for (const RotorState& start : {tumbling, resting})
      for (const double from : times(m.method))
        for (int k = 0; k < 3; ++k) {
          const AnyPerturbation jet("jet", BrokenTorque{k, from});
          expect_said({System(body, Frame::inertial(), {jet}), start, 0.0, stop, m.method}, from,
                      m.name + ", u" + std::to_string(k + 1) + " from " + std::to_string(from) +
                          (start == resting ? ", at rest" : ""));
        }
}

TEST(NotFinite, AnyComponentOfAConvectiveTermIsSaid) {
  for (const NamedMethod& m : methods) {
    if (std::holds_alternative<Splitting>(m.method)) continue;  // it refuses convective terms
    for (const double from : times(m.method))
      for (int k = 0; k < 3; ++k) {
        const AnyPerturbation jet("jet", BrokenMotion{k, from});
        expect_said({System(body, Frame::inertial(), {jet}), tumbling, 0.0, stop, m.method}, from,
                    m.name + ", v" + std::to_string(k + 1) + " from " + std::to_string(from));
      }
  }
}

TEST(NotFinite, TheRunWithADamperSaysItToo) {
  for (const RotorState& start : {tumbling, resting})
    for (const double from : {4.0, stop})
      for (int k = 0; k < 3; ++k) {
        const AnyPerturbation jet("jet", BrokenTorque{k, from});
        const System system(body, Frame::inertial(), {jet}, KaneDamper(0.1, 0.05));
        expect_said({system, start, 0.0, stop, Adaptive{}}, from,
                    "damper, u" + std::to_string(k + 1) + " from " + std::to_string(from) +
                        (start == resting ? ", at rest" : ""));
      }
}

}  // namespace
