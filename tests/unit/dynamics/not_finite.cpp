// SPDX-License-Identifier: MIT
// A number of a user's term that is NaN ends a run with a sentence, whichever component it is and
// whichever stage of a step sees it: no method takes it for a small error.
#include <gmock/gmock.h>

#include <cmath>
#include <string>
#include <vector>

#include "polhode/dynamics/integrate.hpp"
#include "polhode/orbit/any_orbit.hpp"
#include "polhode/orbit/table_orbit.hpp"
#include "polhode/perturb/atmospheric_drag.hpp"
#include "polhode/perturb/gravity_gradient.hpp"
#include "polhode/perturb/kane_damper.hpp"
#include "polhode/perturb/magnetic_torque.hpp"
#include "polhode/perturb/solar_pressure.hpp"
#include "polhode/perturb/tidal_torque.hpp"
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

// An orbit that ends in the middle of a run: no term takes that for a torque of zero.

// A circle of radius 7, known until t = 100.
TableOrbit ends_at_100() {
  PositionTable table;
  for (int i = 0; i <= 20; ++i) {
    const double t = 5.0 * i;
    table.times.push_back(t);
    table.positions.push_back({7.0 * std::cos(0.01 * t), 7.0 * std::sin(0.01 * t), 0.3});
  }
  return TableOrbit(table);
}

struct Still {
  Vec3 at;
  template <Real T>
  BasicVec3<T> position(const T&) const {
    return {T(at.x), T(at.y), T(at.z)};
  }
};

std::vector<AnyPerturbation> terms_of_a_place() {
  const TableOrbit orbit = ends_at_100();
  const DirectedPath path{AnyOrbit("table", orbit)}, sun{AnyOrbit("sun", Still{{1e3, 0.0, 0.0}})},
      still{AnyOrbit("still", Still{{-7.0, 0.0, 0.0}})};
  const Surface plate = Surface::of_plate({0.0, 3.0, 0.4}, {1.0, 0.0, 0.0}, 1e-4, {}, true);
  const Sunlight light{1.0, 1e3};
  const FieldAlongOrbit field(orbit, DipoleField({0.0, 0.3, 1.0}));
  shape::MassMoments moments;
  moments.third[0] = 1e-3;
  const Mat3 tensor{{{1e-2, 0.0, 0.0}, {0.0, 1e-2, 0.0}, {0.0, 0.0, 1e-2}}};
  return {{"gravity", GravityGradient(1e-3, orbit)},
          {"degree 3", HigherGravity(1e-3, orbit, moments, OrbitOf::body)},
          {"J2", OblateGravity(1e-3, orbit, {1e-3, 1.0})},
          {"tide", TidalTorque(1e-3, 1.0, orbit, {0.1, 1e-3, 1.0})},
          {"dipole", ResidualDipole({0.1, 0.0, 0.0}, field)},
          {"currents", EddyCurrents(tensor, field)},
          {"light of the centre", SolarPressure(plate, {1e-3, 7.0}, path)},
          {"light", SolarPressure(plate, light, path, sun)},
          {"light, cylinder", SolarPressure(plate, light, path, sun, Shadow::cylinder(1.0))},
          {"light, cone", SolarPressure(plate, light, path, sun, Shadow::cone(1.0, 5.0))},
          {"light of a table", SolarPressure(plate, light, still, path, Shadow::cone(1.0, 5.0))},
          {"drag", AtmosphericDrag(plate, {.density = 1e-3}, path)},
          {"drag in layers",
           AtmosphericDrag(
               plate,
               {.density = 1e-3, .radius = 7.0, .scale_height = 1.0, .rotation = {0.0, 0.0, 0.01}},
               path)}};
}

Trajectory run_of(const AnyPerturbation& term, const Method& method, double until) {
  const System system(Body(1.0, 1.7, 2.2), Frame::inertial(), {term});
  return integrate({system, {{0.8, 0.2, -0.4, 0.4}, {0.01, 0.02, 0.03}}, 0.0, until, method, {}});
}

TEST(MissingOrbit, EndsTheRun) {
  for (const AnyPerturbation& term : terms_of_a_place()) {
    const Trajectory inside = run_of(term, Adaptive{1e-9}, 99.0);
    EXPECT_TRUE(inside.outcome().ok()) << term.name() << ": " << inside.outcome().advice;
    const Trajectory beyond = run_of(term, Adaptive{1e-9}, 300.0);
    EXPECT_FALSE(beyond.outcome().ok()) << term.name();
    EXPECT_LE(beyond.outcome().t, 100.0) << term.name();
    EXPECT_THAT(beyond.outcome().advice, HasSubstr("\"" + term.name() + "\""));
    if (term.is_kick()) {
      EXPECT_FALSE(run_of(term, Splitting{.step = 1.0}, 300.0).outcome().ok()) << term.name();
    }
  }
}

}  // namespace
