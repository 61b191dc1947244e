// SPDX-License-Identifier: MIT
// Torques that jump or have a kink where the state says: steps end there, the error is that of the
// tolerance, and what is not endless is not refused.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "budgets.hpp"
#include "polhode/dynamics/integrate.hpp"
#include "polhode/error.hpp"
#include "polhode/orbit/any_orbit.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "polhode/perturb/atmospheric_drag.hpp"
#include "polhode/perturb/constant_torque.hpp"
#include "polhode/perturb/gravity_gradient.hpp"
#include "polhode/perturb/internal_damping.hpp"
#include "polhode/perturb/solar_pressure.hpp"
#include "polhode/perturb/user_terms.hpp"
#include "unit/dynamics/plates_reference.hpp"
#include "worst.hpp"

namespace polhode {
namespace {

using polhode::test::larger;
using polhode::test::smaller;
using polhode_test::PlatesReference;
using testing::HasSubstr;

constexpr double turn = 2.0 * std::numbers::pi;

RotorState end_of(const Problem& problem) {
  const Trajectory run = integrate(problem, {SaveAt::times({problem.stop}), false});
  EXPECT_EQ(run.outcome().status, Outcome::Status::completed)
      << run.outcome().advice << " at " << run.outcome().t;
  return run.samples().back().s;
}

// ---- plates that turn edge-on ----

Problem plates(const Method& method, const PlatesReference& reference) {
  std::vector<SurfaceFacet> facets;
  for (std::size_t k = 0; k < 2; ++k) {
    const auto three = [](const PlatesReference::Three& v) {
      return Vec3{static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
    };
    facets.push_back({three(reference.centres[k]),
                      three(reference.normals[k]),
                      static_cast<double>(reference.areas[k]),
                      {}});
  }
  const AnyOrbit circle("circle", KeplerOrbit({0.0625, 1.0, 0.0}));
  const AtmosphericDrag drag(Surface(facets), {.density = 0.16}, {circle});
  return {System(Body(2.0, 3.0, 4.5), Frame::inertial(), {{"drag", drag}}),
          {{}, {0.8, 1.5, 1.35}},
          0.0,
          200.0,
          method};
}

double distance(const RotorState& s, const PlatesReference::Values& y) {
  const double values[] = {s.q.w, s.q.x, s.q.y, s.q.z, s.g.x, s.g.y, s.g.z};
  double same = 0.0, opposite = 0.0;
  for (std::size_t i = 0; i < 7; ++i) {
    const auto apart = [&](double x) { return std::fabs(static_cast<double>(x - y[i])); };
    same = larger(same, apart(values[i]));
    opposite = larger(opposite, apart(i < 4 ? -values[i] : values[i]));
  }
  return smaller(same, opposite);
}

TEST(Switches, PlatesAreAsAccurateAsTheTolerance) {
  PlatesReference reference;
  const PlatesReference::Values start{1, 0, 0, 0, 0.8, 1.5, 1.35};
  const auto coarse = reference.after(start, 200.0L, 0.1L);
  const auto fine = reference.after(start, 200.0L, 0.05L);
  EXPECT_EQ(reference.edges, 53);
  for (std::size_t i = 0; i < 7; ++i)
    EXPECT_LE(std::fabs(static_cast<double>(coarse[i] - fine[i])), budget::plates_reference);
  for (const double tolerance : {1e-6, 1e-8, 1e-10, 1e-12, 1e-13, 1e-15}) {
    const RotorState end = end_of(plates(Adaptive{.tolerance = tolerance}, reference));
    EXPECT_LE(distance(end, fine), budget::plates_per_tolerance * tolerance + budget::plates_floor)
        << tolerance;
  }
}

// The derivative of the end by the start, across the kinks: differences of two runs.
TEST(Switches, TransitionsAcrossEdges) {
  const Problem problem = plates(Adaptive{.tolerance = 1e-13}, {});
  const auto rows = state_transitions(problem, SaveAt::times({problem.stop}));
  ASSERT_EQ(rows.size(), 1U);
  constexpr double h = 0x1p-17;
  for (int j = 0; j < 3; ++j) {
    Problem more = problem, less = problem;
    more.initial.g[j] += h;
    less.initial.g[j] -= h;
    const Vec3 change = (0.5 / h) * (end_of(more).g - end_of(less).g);
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(rows[0].transition(3 + i, 3 + j), change[i],
                  budget::switch_transition * (1.0 + norm(change)));
  }
}

// ---- a shadow ----

// Two mirrors like blades, light along axis 3: the torque is about axis 3 and constant while the
// Sun is seen, so that momentum and angle are known from the times in the shadow.
struct Mirrors {
  double period = 5400.0, radius = 0.9, rate = 1e-3, pressure = 1e-9;
  double tilt_of_path = 0.0;  // out of the plane of the Sun: so near to the axis it comes

  Problem problem(double stop, const Method& method) const {
    const double tilt = 0.6;
    const Vec3 n{0.0, tilt, 0.8};
    const Finish mirror{.specular = 1.0};
    const Surface blades(
        {{{1.0, 0.0, 0.0}, n, 1.0, mirror}, {{-1.0, 0.0, 0.0}, {0.0, -tilt, 0.8}, 1.0, mirror}});
    const double motion = turn / period;
    // in the plane of x and z, at z > 0 first
    const AnyOrbit path("path", KeplerOrbit({motion * motion, 1.0, 0.0, 0.25 * turn - tilt_of_path,
                                             0.0, 0.25 * turn}));
    const AnyOrbit sun("sun", KeplerOrbit({1e-30, 1e16, 0.0, 0.25 * turn, 0.0, 0.25 * turn}));
    const SolarPressure light(blades, {pressure, 1e16}, {path}, {sun}, Shadow::cylinder(radius));
    return {System(Body(1.0, 1.0, 1.0), Frame::inertial(), {{"light", light}}),
            {{}, {0.0, 0.0, rate}},
            0.0,
            stop,
            method};
  }
  // u_z = 2 p A c^2 s a blade, with c = 0.8, s = 0.6, on x = +-1: x F_y.
  double torque() const { return -4.0 * pressure * 0.64 * 0.6; }
  // Momentum and angle at t, from the phase of the borders: asin(radius) of a path without tilt.
  std::pair<double, double> at(double t) const {
    const double miss = std::sin(tilt_of_path), over = larger(0.0, radius - miss);
    const double half =
        std::asin(std::sqrt(over * (radius + miss)) / std::cos(tilt_of_path)) / turn * period;
    double g = rate, angle = 0.0, now = 0.0;
    for (double middle = 0.5 * period; now < t; middle += period) {
      for (const auto& [end, lit] : {std::pair{middle - half, true},
                                     {middle + half, false},
                                     {middle + 0.5 * period, true}}) {
        const double h = larger(0.0, smaller(end, t) - now), u = lit ? torque() : 0.0;
        angle += h * (g + 0.5 * u * h);
        g += u * h;
        now += h;
      }
    }
    return {g, angle};
  }
};

class Shadows : public testing::TestWithParam<double> {};

TEST_P(Shadows, OfACylinderAreFound) {
  const Mirrors mirrors;
  for (const double days : {1.0, 3.0, 30.0}) {
    SCOPED_TRACE(days);
    const double stop = 86400.0 * days + 1234.5;
    const RotorState end = end_of(mirrors.problem(stop, Adaptive{.tolerance = GetParam()}));
    const auto [g, angle] = mirrors.at(stop);
    const double budget =
        budget::shadow_per_tolerance * GetParam() * stop / mirrors.period + budget::shadow_floor;
    EXPECT_LE(std::fabs(end.g.z / g - 1.0), budget);
    const Quaternion miss = conj(rotation_z(angle)) * end.q;
    EXPECT_LE(2.0 * std::fabs(miss.z), budget * std::fabs(angle));
  }
}
INSTANTIATE_TEST_SUITE_P(Tolerances, Shadows, testing::Values(1e-6, 1e-8, 1e-12, 1e-14));

// A tenth of a percent of an orbit in the dark, a path that dips into the border of the shadow, and
// one that misses it by as little.
TEST(Switches, AShadowThatIsGrazed) {
  for (const auto& [radius, miss] : {std::pair{0.003, 0.0}, std::pair{0.03, 0.0},
                                     std::pair{0.5001, 0.5}, std::pair{0.4999, 0.5}}) {
    Mirrors mirrors;
    mirrors.radius = radius;
    mirrors.tilt_of_path = std::asin(miss);
    const double stop = 10.25 * mirrors.period;
    const auto [g, angle] = mirrors.at(stop);
    const RotorState end = end_of(mirrors.problem(stop, Adaptive{}));
    EXPECT_LE(std::fabs(end.g.z / g - 1.0), budget::shadow_floor) << radius;
  }
}

// ---- a user's torque ----

// +-u about axis 3, its sign that of sin(rate t).
struct Bang {
  double u = 1e-4, rate = 0.01;

  double sign(double t) const { return std::sin(rate * t); }
  Problem problem(const AnyPerturbation& term, double stop, double tolerance) const {
    return {System(Body(1.0, 1.0, 2.0), Frame::inertial(), {term}),
            {{}, {0.0, 0.0, 0.02}},
            0.0,
            stop,
            Adaptive{.tolerance = tolerance}};
  }
  AnyPerturbation named() const {
    return {"bang", SwitchedTorqueTerm(
                        [*this](const auto&, const auto& s, std::span<const double> sides) {
                          using T = std::decay_t<decltype(s.g.x)>;
                          return BasicVec3<T>{T(0.0), T(0.0), T(u * sides[0])};
                        },
                        [*this](double t, const RotorState&) { return std::vector{sign(t)}; })};
  }
  AnyPerturbation unnamed() const {
    return {"bang", TorqueTerm([*this](const double& t, const RotorState&) {
              return Vec3{0.0, 0.0, sign(t) < 0.0 ? -u : u};
            })};
  }
  double momentum(double t) const {
    const double half = 0.5 * turn / rate, n = std::floor(t / half), rest = t - n * half;
    const bool falls = std::fmod(n, 2.0) == 1.0;
    return 0.02 + u * (falls ? half - rest : rest);
  }
};

TEST(Switches, ATorqueThatChangesItsSign) {
  const Bang bang;
  for (const double tolerance : {1e-6, 1e-8, 1e-12, 1e-14}) {
    const RotorState end = end_of(bang.problem(bang.named(), 1e5, tolerance));
    EXPECT_NEAR(end.g.z / bang.momentum(1e5), 1.0,
                budget::bang_per_tolerance * tolerance + budget::bang_floor);
  }
}

// Its jumps cut steps down to the rounding of t, and the run goes on.
TEST(Switches, ATorqueThatDoesNotSayWhereItJumps) {
  const Bang bang;
  for (const double tolerance : {1e-8, 1e-12, 1e-14}) {
    const RotorState end = end_of(bang.problem(bang.unnamed(), 1e5, tolerance));
    EXPECT_NEAR(end.g.z / bang.momentum(1e5), 1.0,
                tolerance < 1e-10 ? budget::bang_unnamed : budget::bang_unnamed_loose);
  }
}

// A term that switches adds to the others, whatever their order.
TEST(Switches, AddToOtherTerms) {
  const AnyPerturbation constant("constant", ConstantTorque::in_body({0.0, 0.0, 0.05}));
  const auto jet = [](const double&, const RotorState&, std::span<const double> sides) {
    return Vec3{0.0, 0.0, sides[0] > 0.0 ? 0.25 : 0.0};
  };
  const auto first = [](double t, const RotorState&) { return std::vector{2.0 - t}; };
  const AnyPerturbation switched("jet", SwitchedTorqueTerm(jet, first));
  for (const auto& terms : {std::vector{constant, switched}, {switched, constant}}) {
    const System system(Body(1.0, 1.5, 2.0), Frame::inertial(), terms);
    const RotorState end = end_of({system, {{}, {0.0, 0.0, 1.0}}, 0.0, 10.0, Adaptive{}});
    EXPECT_NEAR(end.g.z, 1.0 + 10.0 * 0.05 + 2.0 * 0.25, budget::bang_floor);
  }
}

// A thruster that brings the rate into a dead zone by its state, forwards and backwards.
TEST(Switches, ADeadZoneIsEntered) {
  const auto jet = [](const double&, const RotorState&, std::span<const double> sides) {
    return Vec3{0.0, 0.0, sides[0] > 0.0 ? -0.25 : 0.0};
  };
  // it is left on the border, above or below by a rounding
  for (const double border : {0.125, 0.1, 0.3, 0.7})
    for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-9, 1e-12, 1e-14}) {
      const auto above = [border](double, const RotorState& s) {
        return std::vector{s.g.z - border};
      };
      const System system(Body(1.0, 1.5, 2.0), Frame::inertial(),
                          {{"jet", SwitchedTorqueTerm(jet, above)}});
      const RotorState end =
          end_of({system, {{}, {0.0, 0.0, 1.0}}, 0.0, 10.0, Adaptive{.tolerance = tolerance}});
      EXPECT_NEAR(end.g.z, border, budget::bang_floor);
      // the mean rate until there, and then the last one
      const double time = 4.0 * (1.0 - border);
      const double angle = time * 0.25 * (1.0 + border) + (10.0 - time) * 0.5 * border;
      EXPECT_LE(2.0 * std::fabs((conj(rotation_z(angle)) * end.q).z),
                budget::bang_per_tolerance * tolerance + budget::bang_floor);
    }
}

TEST(Switches, ATorqueThatHoldsItsOwnZeroIsRefused) {
  const auto brake = [](const double&, const RotorState&, std::span<const double> sides) {
    return Vec3{0.0, 0.0, -0.25 * sides[0]};
  };
  const auto rate = [](double, const RotorState& s) { return std::vector{s.g.z}; };
  const System system(Body(1.0, 1.5, 2.0), Frame::inertial(),
                      {{"brake", SwitchedTorqueTerm(brake, rate)}});
  const Trajectory run = integrate({system, {{}, {0.0, 0.0, 1.0}}, 0.0, 10.0, Adaptive{}});
  EXPECT_EQ(run.outcome().status, Outcome::Status::failed);
  EXPECT_NEAR(run.outcome().t, 4.0, budget::bang_floor);
  EXPECT_THAT(run.outcome().advice,
              HasSubstr("switching function 1 of term \"brake\" stays at zero after t = 4"));
  EXPECT_THAT(run.outcome().advice, HasSubstr("give it a dead zone"));
}

TEST(Switches, AsManyAsAtTheStart) {
  const auto none = [](const double&, const RotorState&, std::span<const double>) {
    return Vec3{};
  };
  const auto more = [](double t, const RotorState&) {
    return std::vector<double>(t > 1.0 ? 2 : 1, 1.0);
  };
  const System system(Body(1.0, 1.5, 2.0), Frame::inertial(),
                      {{"odd", SwitchedTorqueTerm(none, more)}});
  EXPECT_THAT(
      [&] {
        integrate({system, {{}, {0.1, 0.2, 1.0}}, 0.0, 10.0, Adaptive{}});
      },
      testing::ThrowsMessage<DomainError>(
          HasSubstr("term \"odd\" has 2 switching functions, and 1 at the start")));
}

// ---- what is endless is refused, promptly ----

Trajectory under(const AnyPerturbation& term, double stop, double tolerance) {
  return integrate({System(Body(1.0, 1.5, 2.0), Frame::inertial(), {term}),
                    {{}, {0.1, 0.2, 1.0}},
                    0.0,
                    stop,
                    Adaptive{.tolerance = tolerance}},
                   {.dense = false});
}

TEST(Endless, AMomentumThatGrowsWithoutBound) {
  // dg/dt = g^2 / 8: no more after t = 8
  const TorqueTerm engine([](const double&, const RotorState& s) {
    return Vec3{0.0, 0.0, 0.125 * s.g.z * s.g.z};
  });
  for (const double tolerance : {1e-4, 1e-8, 1e-12}) {
    const Trajectory run = under({"engine", engine}, 20.0, tolerance);
    EXPECT_EQ(run.outcome().status, Outcome::Status::failed) << tolerance;
    EXPECT_LT(run.outcome().t, 8.1);
    EXPECT_LT(run.statistics().evaluations, 1'000'000);
    EXPECT_THAT(run.outcome().advice,
                HasSubstr("below the rounding of t: does a torque or the frame jump there "
                          "repeatedly, or grow without bound?"));
  }
}

TEST(Endless, AStiffDamping) {
  const Trajectory run = under({"stiff", LinearDamping(1e9)}, 1e6, 1e-12);
  EXPECT_EQ(run.outcome().status, Outcome::Status::failed);
  EXPECT_LT(run.statistics().steps, 3000);
  EXPECT_THAT(run.outcome().advice, HasSubstr("damping that stiff"));
}

// Backwards a damping is a growth: the steps of e^50 rad would fill any memory.
TEST(Endless, AMotionThatFillsTheMemory) {
  Problem p{System(Body(1.0, 1.5, 2.0), Frame::inertial(), {{"damping", LinearDamping(1.0)}}),
            {{}, {0.3, 0.5, 1.0}},
            0.0,
            -50.0};
  for (const Method& method : {Method(Collocation{}), Method(Adaptive{}), Method(Splitting{1e-3})})
    for (const bool dense : {true, false}) {
      p.method = method;
      const Trajectory run = integrate(p, {.dense = dense, .most_bytes = 1e6});
      EXPECT_EQ(run.outcome().status, Outcome::Status::failed);
      EXPECT_THAT(run.outcome().advice, HasSubstr("bytes that a trajectory may take in memory"));
      EXPECT_GT(run.samples().size(), 500U);
      EXPECT_LE(run.samples().size(), 1'000'000 / sizeof(Sample) + 2);
      EXPECT_EQ(run.samples().back().t, run.stop());
      if (dense) {
        EXPECT_NEAR(run.at(run.stop()).g.z, run.samples().back().s.g.z, budget::adaptive_dense);
      }
    }
}

TEST(Endless, ATorqueThatIsNoise) {
  // changes at every call: no step is good, not one after the other
  const TorqueTerm noise([calls = std::make_shared<int>(0)](const double&, const RotorState&) {
    return Vec3{0.0, 0.0, ++*calls % 2 == 0 ? 1.0 : -1.0};
  });
  const Trajectory run = under({"noise", noise}, 1e6, 1e-12);
  EXPECT_EQ(run.outcome().status, Outcome::Status::failed);
  EXPECT_LT(run.statistics().evaluations, 1'000'000);
}

// ---- a splitting at rest ----

TEST(SplittingAtRest, ADampingBringsABodyThere) {
  // of a rod the rates about its axis and across it fall to 1e-300 apart
  for (const Body& body : {Body(1.0, 2.0, 2.5), Body(0.1, 1.0, 1.05)})
    for (const double step : {0.125, 1.0})
      for (const double damping : {0.5, 1.0, 20.0, 100.0})
        for (const SplittingScheme scheme :
             {SplittingScheme::order2, SplittingScheme::order4, SplittingScheme::ABA864}) {
          const System system(body, Frame::inertial(), {{"damping", LinearDamping(damping)}});
          const Problem problem{
              system, {{}, {0.3, 0.4, 0.5}}, 0.0, 2048.0, Splitting{step, scheme}};
          const Trajectory run = integrate(problem, {SaveAt::times({1536.0, 2048.0}), false});
          ASSERT_EQ(run.outcome().status, Outcome::Status::completed)
              << step << " " << damping << " " << run.outcome().advice;
          const auto& [first, last] = std::pair{run.samples()[0].s, run.samples()[1].s};
          EXPECT_LT(norm(last.g), budget::at_rest);
          EXPECT_EQ(first.q, last.q);  // nothing turns any more
          EXPECT_TRUE(damping * step >= 1.0 || !(first.q == Quaternion{}));
        }
}

TEST(SplittingAtRest, APartOfAStepThatGoesBackIsNamed) {
  const System system(Body(1.0, 2.0, 2.5), Frame::inertial(), {{"damping", LinearDamping(1e4)}});
  const Problem problem{system, {{}, {0.3, 0.4, 0.5}}, 0.0, 100.0, Splitting{1.0}};
  const Trajectory run = integrate(problem, {.dense = false});
  EXPECT_EQ(run.outcome().status, Outcome::Status::failed);
  EXPECT_THAT(run.outcome().advice, HasSubstr("or the scheme order 2"));
}

// ---- the longest step ----

TEST(LargestStep, AQuarterOfTheFastestTurn) {
  // at rest and hardly pushed: nothing else limits a step
  const KeplerOrbit orbit({.gm = 1.0, .pericentre = 0.5, .eccentricity = 0.5});
  Problem problem{System(Body(1.0, 1.0 + 1e-9, 1.0 + 2e-9), Frame::inertial(),
                         {{"gravity", GravityGradient(1e-12, orbit)}}),
                  {{0.9, 0.1, 0.2, 0.3}, {0.0, 0.0, 1e-30}},
                  0.0,
                  1000.0,
                  Adaptive{.tolerance = 1e-2}};
  // the rate at the pericentre is sqrt(gm (1 + e) / q^3) = sqrt(12)
  const double quarter = 0.25 * turn / std::sqrt(12.0);
  const auto longest = [&] {
    double h = 0.0, before = 0.0;
    for (const Sample& s : integrate(problem).samples()) {
      h = larger(h, s.t - before);
      before = s.t;
    }
    return h;
  };
  EXPECT_LE(longest(), quarter + budget::step_rounding);
  EXPECT_GT(longest(), 0.5 * quarter);
  problem.method = Adaptive{.tolerance = 1e-2, .largest_step = 1e300};
  EXPECT_GT(longest(), 10.0 * quarter);
}

// A second of a torque in a day is stepped over, unless the term says how short it is.
TEST(LargestStep, APulseThatItsTermKnows) {
  const auto jet = [](const double& t, const RotorState&) {
    return Vec3{0.0, 0.0, std::exp(-0.5 * (t - 4e4) * (t - 4e4))};
  };
  const auto gained = [&](double scale) {
    const System system(Body(1.0, 1.0, 2.0), Frame::inertial(), {{"jet", TorqueTerm(jet, scale)}});
    return end_of({system, {}, 0.0, 86400.0, Adaptive{.tolerance = 1e-6}}).g.z;
  };
  EXPECT_EQ(gained(std::numeric_limits<double>::infinity()), 0.0);
  EXPECT_NEAR(gained(2.0), std::sqrt(turn), budget::jet_gained);
}

}  // namespace
}  // namespace polhode
