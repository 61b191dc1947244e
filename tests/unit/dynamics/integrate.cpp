// SPDX-License-Identifier: MIT
// The loop of integrate: samples, dense output, events and endings, the same for every method.
#include "polhode/dynamics/integrate.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/error.hpp"
#include "polhode/free/free_rotation.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "polhode/perturb/constant_torque.hpp"
#include "polhode/perturb/gravity_gradient.hpp"
#include "polhode/perturb/user_terms.hpp"

namespace {

using namespace polhode;
using testing::HasSubstr;

const Body wing_nut(1.0, 2.0, 2.7);
const RotorState tumbling{{0.5, 0.5, -0.5, 0.5}, {0.8, 1.9, 0.3}};

// Rotation angle between two attitudes, and the relative change of momentum, added up.
double distance(const RotorState& a, const RotorState& b) {
  const Quaternion d = conj(normalized(a.q)) * normalized(b.q);
  return 2.0 * norm(Vec3{d.x, d.y, d.z}) + norm(a.g - b.g) / norm(a.g);
}

const auto spring = [](const auto&, const auto& s) {
  using T = std::decay_t<decltype(s.q.w)>;
  const BasicVec3<T> z = rotate(s.q, BasicVec3<T>{T(0.0), T(0.0), T(1.0)});
  return T(0.2) * z.x * z.x;
};

Problem problem(const Method& method, double start = 0.0, double stop = 10.0) {
  return {System(wing_nut, Frame::inertial(), {AnyPerturbation("spring", HamiltonianTerm(spring))}),
          tumbling, start, stop, method};
}
Problem free_problem(const Method& method, double start = 0.0, double stop = 10.0) {
  return {System(wing_nut), tumbling, start, stop, method};
}

const Event middle_momentum{"g2", [](double, const RotorState& s) { return s.g.y; }};

TEST(Integrate, GoesByCollocationWhereNoMethodIsNamed) {
  const Problem rotor{System(wing_nut), tumbling, 0.0, 10.0};
  EXPECT_EQ(rotor.method, Method(Collocation{}));
  const Trajectory run = integrate(rotor);
  EXPECT_EQ(run.method(), "collocation, tolerance 1e-12");
  EXPECT_LT(distance(run.at(10.0), FreeRotation(wing_nut, tumbling).at(10.0)),
            budget::adaptive_short_run);
}

TEST(Integrate, SamplesAreAtTheTimesAskedForInBothDirections) {
  for (const double sign : {1.0, -1.0}) {
    const FreeRotation exact(wing_nut, tumbling, 2.0);
    const Trajectory run = integrate(free_problem(Adaptive{}, 2.0, 2.0 + 8.0 * sign),
                                     {SaveAt::steps(2.0, 2.0 + 8.0 * sign, 0.25 * sign)});
    ASSERT_EQ(run.samples().size(), 33U);
    for (std::size_t k = 0; k < run.samples().size(); ++k) {
      const Sample& sample = run.samples()[k];
      EXPECT_EQ(sample.t, 2.0 + 0.25 * sign * static_cast<double>(k));
      EXPECT_LT(distance(sample.s, exact.at(sample.t)), budget::adaptive_short_run);
    }
    EXPECT_EQ(run.outcome().status, Outcome::Status::completed);
    EXPECT_EQ(run.stop(), 2.0 + 8.0 * sign);
  }
}

TEST(Integrate, WithoutTimesEveryStepIsASample) {
  const Trajectory run = integrate(problem(Adaptive{}));
  EXPECT_EQ(run.samples().size(), static_cast<std::size_t>(run.statistics().steps) + 1);
  EXPECT_EQ(run.samples().front().t, 0.0);
  EXPECT_EQ(run.samples().back().t, 10.0);
}

TEST(Integrate, DenseOutputMeetsTheSamplesAndTheExactMotion) {
  const FreeRotation exact(wing_nut, tumbling, 0.0);
  const Trajectory run = integrate(free_problem(Adaptive{}));
  for (const Sample& sample : run.samples())
    EXPECT_LT(distance(run.at(sample.t), sample.s), budget::adaptive_dense);
  for (double t = 0.0; t <= 10.0; t += 0.0371)
    EXPECT_LT(distance(run.at(t), exact.at(t)), budget::adaptive_dense);
  EXPECT_TRUE(run.has_dense());
  EXPECT_THROW(run.at(10.0001), DomainError);
  EXPECT_THROW(run.at(std::nan("")), DomainError);
}

TEST(Integrate, ASinkGetsTheSameSamplesInBlocks) {
  const SaveAt times = SaveAt::count(0.0, 10.0, 2500);
  std::vector<Sample> seen;
  int blocks = 0;
  const Trajectory streamed =
      integrate(problem(Adaptive{}), times, [&](std::span<const Sample> block) {
        ++blocks;
        seen.insert(seen.end(), block.begin(), block.end());
      });
  EXPECT_EQ(seen, integrate(problem(Adaptive{}), {times}).samples());
  EXPECT_EQ(blocks, 3);
  EXPECT_TRUE(streamed.samples().empty());
  EXPECT_FALSE(streamed.has_dense());
  EXPECT_THROW(streamed.at(5.0), DomainError);
}

TEST(Integrate, SamplesOutsideTheSpanAreLeftOut) {
  const Trajectory run =
      integrate(problem(Adaptive{}), {SaveAt::times({-1.0, 0.0, 3.0, 10.0, 11.0})});
  ASSERT_EQ(run.samples().size(), 3U);
  EXPECT_EQ(run.samples()[0].t, 0.0);
  EXPECT_EQ(run.samples()[2].t, 10.0);
  EXPECT_THAT(
      [] {
        integrate(problem(Adaptive{}), {SaveAt::times({5.0, 3.0})});
      },
      testing::ThrowsMessage<DomainError>(HasSubstr("3 comes after 5")));
}

// 3 * 0.1 is beyond 0.3 by one unit in the last place.
TEST(Integrate, ARowThatRoundingPutsBeyondTheEndIsThere) {
  const FreeRotation exact(wing_nut, tumbling, 0.0);
  for (const Method& method : {Method(Adaptive{}), Method(Splitting{0.07})}) {
    for (const double sign : {1.0, -1.0}) {
      const SaveAt rows = SaveAt::steps(0.0, 0.3 * sign, 0.1 * sign);
      const Trajectory run = integrate(free_problem(method, 0.0, 0.3 * sign), {rows, false});
      ASSERT_EQ(run.samples().size(), 4U);
      EXPECT_GT(std::fabs(run.samples().back().t), 0.3);
      EXPECT_LT(distance(run.samples().back().s, exact.at(0.3 * sign)), budget::adaptive_short_run);
    }
  }
}

TEST(Integrate, ASinkThatThrowsDoesNotGetTheSameSamplesAgain) {
  std::vector<double> seen;
  const SampleSink full = [&seen](std::span<const Sample> block) {
    for (const Sample& sample : block) seen.push_back(sample.t);
    if (seen.size() > 1024) throw std::runtime_error("disk full");
  };
  EXPECT_THAT([&] { integrate(problem(Adaptive{}), SaveAt::count(0.0, 10.0, 4000), full); },
              testing::ThrowsMessage<std::runtime_error>("disk full"));
  EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
  EXPECT_EQ(std::adjacent_find(seen.begin(), seen.end()), seen.end());
}

TEST(Integrate, EventsAreTheCrossingsOfTheExactMotion) {
  Problem p = free_problem(Adaptive{}, 0.0, 40.0);
  p.events = {middle_momentum};
  const Trajectory run = integrate(p);
  const FreeRotation exact(wing_nut, tumbling, 0.0);
  // g2 vanishes twice in a period of the polhode, half a period apart
  ASSERT_GE(run.events().size(), 6U);
  for (const EventRecord& event : run.events()) {
    EXPECT_LT(std::fabs(exact.at(event.t).g.y), budget::adaptive_dense);
    EXPECT_EQ(event.direction, exact.at(event.t + 1e-3).g.y > 0.0 ? 1 : -1);
  }
  for (std::size_t i = 1; i < run.events().size(); ++i)
    EXPECT_NEAR(run.events()[i].t - run.events()[i - 1].t, 0.5 * exact.polhode_period(),
                budget::adaptive_dense);
  p.events[0].crossing = Crossing::rising;
  const std::size_t rising = integrate(p).events().size();
  p.events[0].crossing = Crossing::falling;
  EXPECT_EQ(rising + integrate(p).events().size(), run.events().size());
}

TEST(Integrate, AStoppingEventEndsTheRunThere) {
  for (const double sign : {1.0, -1.0}) {
    Problem p = free_problem(Adaptive{}, 0.0, 40.0 * sign);
    p.events = {middle_momentum};
    p.events[0].stops = true;
    const Trajectory run = integrate(p, {SaveAt::steps(0.0, 40.0 * sign, 0.1 * sign)});
    EXPECT_EQ(run.outcome().status, Outcome::Status::stopped_by_event);
    ASSERT_EQ(run.events().size(), 1U);
    EXPECT_EQ(run.stop(), run.events()[0].t);
    EXPECT_EQ(run.samples().back().t, run.stop());
    EXPECT_LT(std::fabs(run.samples().back().s.g.y), budget::adaptive_dense);
  }
}

TEST(Integrate, AnEventThatNeverCrossesIsNoError) {
  Problem p = free_problem(Adaptive{});
  p.events = {{"far", [](double, const RotorState& s) { return s.g.x - 100.0; }}};
  const Trajectory run = integrate(p);
  EXPECT_TRUE(run.events().empty());
  EXPECT_EQ(run.outcome().status, Outcome::Status::completed);
}

TEST(Integrate, AnEventThatIsNaNEndsTheRunWithASentence) {
  Problem p = free_problem(Adaptive{});
  p.events = {{"root", [](double t, const RotorState&) { return std::sqrt(5.0 - t); }}};
  const Trajectory run = integrate(p);
  EXPECT_EQ(run.outcome().status, Outcome::Status::failed);
  EXPECT_THAT(run.outcome().advice, HasSubstr("event \"root\" is NaN after t = "));
  EXPECT_LE(run.stop(), 5.0);
}

TEST(Integrate, ANaNTorqueEndsTheRunAndKeepsWhatWasThere) {
  const auto breaks = [](double t, const RotorState&) {
    return Vec3{t < 4.0 ? 0.1 : std::nan(""), 0.0, 0.0};
  };
  const Problem p{System(wing_nut, Frame::inertial(), {AnyPerturbation("jet", TorqueTerm(breaks))}),
                  tumbling, 0.0, 10.0, Adaptive{}};
  const Trajectory run = integrate(p, {SaveAt::steps(0.0, 10.0, 0.5)});
  EXPECT_EQ(run.outcome().status, Outcome::Status::failed);
  EXPECT_THAT(run.outcome().advice, HasSubstr("jet"));
  EXPECT_LE(run.stop(), 4.0);
  EXPECT_GE(run.samples().size(), 4U);
}

TEST(Integrate, WhatATermThrowsPassesThroughAfterTheSamples) {
  const auto throws = [](double t, const RotorState&) {
    if (t > 4.0) throw std::runtime_error("out of fuel");
    return Vec3{0.1, 0.0, 0.0};
  };
  const Problem p{System(wing_nut, Frame::inertial(), {AnyPerturbation("jet", TorqueTerm(throws))}),
                  tumbling, 0.0, 10.0, Adaptive{}};
  std::size_t seen = 0;
  const SampleSink sink = [&seen](std::span<const Sample> block) { seen += block.size(); };
  EXPECT_THAT([&] { integrate(p, SaveAt::steps(0.0, 10.0, 0.5), sink); },
              testing::ThrowsMessage<std::runtime_error>("out of fuel"));
  EXPECT_GE(seen, 4U);
}

TEST(Integrate, WhatAHamiltonianThrowsPassesThrough) {
  const auto throws = [](const auto& t, const auto& s) {
    if (to_double(t) > 4.0) throw std::runtime_error("no potential here");
    return s.q.w * s.q.w;
  };
  const Problem p{
      System(wing_nut, Frame::inertial(), {AnyPerturbation("V", HamiltonianTerm(throws))}),
      tumbling, 0.0, 10.0, Adaptive{}};
  EXPECT_THAT([&] { integrate(p); },
              testing::ThrowsMessage<std::runtime_error>("no potential here"));
}

// The frame's attitude jumps by a right angle, so a torque that is constant in space jumps in the
// body: the run gets over it, or says where it stands and what may be the matter.
TEST(Integrate, AFrameThatJumpsIsNoHang) {
  const Frame jumps = Frame::from_attitude([](const auto& t) {
    using T = std::decay_t<decltype(t)>;
    return rotation_z(T(to_double(t) < 4.0 ? 0.0 : 1.5707963267948966));
  });
  const System system(
      wing_nut, jumps,
      {AnyPerturbation("push", ConstantTorque::in_space({0.1, 0.0, 0.0}, SpaceAxes::inertial))});
  const Trajectory run = integrate({system, tumbling, 0.0, 10.0, Adaptive{}}, {.dense = false});
  if (run.outcome().ok()) {
    EXPECT_EQ(run.stop(), 10.0);
    EXPECT_GT(run.statistics().rejected, 5);
  } else {
    EXPECT_NEAR(run.stop(), 4.0, budget::adaptive_dense);
    EXPECT_THAT(run.outcome().advice, HasSubstr("frame discontinuous"));
  }
}

// Two bodies at once: the sum of their torques.
TEST(Integrate, TwoGravityGradientsAtOnceAreOneOfTheSum) {
  const KeplerOrbit moon({.gm = 1.0, .pericentre = 0.9, .eccentricity = 0.1});
  const auto run = [&](std::vector<AnyPerturbation> terms) {
    return integrate({System(wing_nut, Frame::inertial(), std::move(terms)), tumbling, 0.0, 10.0,
                      Adaptive{}})
        .samples()
        .back()
        .s;
  };
  const RotorState both = run({AnyPerturbation("one", GravityGradient(0.3, moon)),
                               AnyPerturbation("two", GravityGradient(0.7, moon))});
  EXPECT_LT(distance(both, run({AnyPerturbation("sum", GravityGradient(1.0, moon))})),
            budget::adaptive_short_run);
  EXPECT_GT(distance(both, run({AnyPerturbation("one", GravityGradient(0.3, moon))})),
            budget::two_bodies_differ);
}

TEST(Integrate, ARunThatWouldNeverEndSaysSo) {
  const Trajectory slow = integrate(free_problem(Splitting{1e-9}, 0.0, 1e9), {.dense = false});
  EXPECT_EQ(slow.outcome().status, Outcome::Status::failed);
  EXPECT_THAT(slow.outcome().advice, HasSubstr("so reaching the end would take 1e+17 of them"));
  Problem fast = free_problem(Adaptive{}, 0.0, 3600.0);
  fast.initial.g = {1e20, 2e20, 3e20};
  const Trajectory run = integrate(fast, {.dense = false});
  EXPECT_EQ(run.outcome().status, Outcome::Status::failed);
  EXPECT_THAT(run.outcome().advice, HasSubstr("so reaching the end would take"));
}

// What is left counts, not how far from the epoch it is.
TEST(Integrate, ALateRunIsNotEndless) {
  const Trajectory run = integrate(free_problem(Splitting{1.0}, 1e14, 1e14 + 1500.0));
  EXPECT_EQ(run.outcome().status, Outcome::Status::completed) << run.outcome().advice;
}

TEST(Integrate, ARunOfNoLengthIsItsStart) {
  const Trajectory run = integrate(problem(Adaptive{}, 3.0, 3.0));
  EXPECT_EQ(run.samples().size(), 1U);
  EXPECT_EQ(run.outcome().status, Outcome::Status::completed);
  EXPECT_EQ(run.at(3.0), run.samples()[0].s);
}

TEST(Integrate, AProblemThatNeverEndsIsNotMade) {
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_MESSAGE(problem(Adaptive{}, 0.0, std::nan("")),
                 "Problem: start 0 and stop nan must be finite");
  EXPECT_MESSAGE(problem(Adaptive{}, -inf, 1.0), "Problem: start -inf and stop 1 must be finite");
}

TEST(Integrate, WhatIsNoProblemIsRefused) {
  const double nan = std::nan("");
  const auto refused = [](Problem p, const std::string& words) {
    EXPECT_REJECTED(integrate(p), words);
  };
  Problem p = problem(Adaptive{});
  p.initial.q = {0.0, 0.0, 0.0, 0.0};
  refused(p, "quaternion (0, 0, 0, 0) must be finite and not zero");
  p = problem(Adaptive{});
  p.initial.g.y = nan;
  refused(p, "momentum (0.8, nan, 0.3) must be finite");
  p = problem(Adaptive{});
  p.stop = std::numeric_limits<double>::infinity();
  refused(p, "integrate: start 0 and stop inf must be finite");
  refused(problem(Adaptive{.tolerance = 0.0}), "tolerance 0 must be from 1e-15 to 0.01");
  refused(problem(Adaptive{.tolerance = 1e-16}), "tolerance 1e-16 must be");
  refused(problem(Splitting{0.0}), "step 0 must be positive");
  refused(problem(Splitting{nan}), "must be positive");
  refused(problem(VariationOfConstants{.tolerance = 1.0}), "tolerance 1 must be");
  p = problem(Adaptive{});
  p.events = {{"empty", {}}};
  refused(p, "event \"empty\" must have a function");
}

}  // namespace
