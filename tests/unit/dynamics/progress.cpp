// SPDX-License-Identifier: MIT
// A run reports how far it has come, and can be stopped from outside: the same for every method.
#include <gmock/gmock.h>

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <vector>

#include "polhode/dynamics/integrate.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "polhode/perturb/gravity_gradient.hpp"
#include "polhode/trajectory/trajectory.hpp"

namespace {

using namespace polhode;

// What a caller throws to stop a run; no exception class of the library.
struct Interrupt {
  double t;
};

Problem problem(const Method& method, double start, double stop) {
  const KeplerOrbit moon({.gm = 1.0, .pericentre = 0.9, .eccentricity = 0.1});
  return {System(Body(1.0, 2.0, 2.7), Frame::inertial(),
                 {AnyPerturbation("moon", GravityGradient(0.3, moon))}),
          {{0.5, 0.5, -0.5, 0.5}, {0.8, 1.9, 0.3}},
          start,
          stop,
          method};
}

class ProgressOf : public testing::TestWithParam<Method> {};

TEST_P(ProgressOf, EveryStepIsToldInOrder) {
  for (const double sign : {1.0, -1.0}) {
    std::vector<double> reported;
    const Trajectory run = integrate(problem(GetParam(), 1.0, 1.0 + 10.0 * sign), {},
                                     [&](double t) { reported.push_back(t); });
    ASSERT_EQ(reported.size(), static_cast<std::size_t>(run.statistics().steps));
    for (std::size_t k = 0; k < reported.size(); ++k)
      EXPECT_EQ(reported[k], run.samples()[k + 1].t);
  }
}

// A step may hold millions of samples: they are reported one by one.
TEST_P(ProgressOf, SamplesInsideAStepAreTold) {
  std::size_t calls = 0;
  double latest = 0.0;
  const Trajectory run = integrate(
      problem(GetParam(), 0.0, 10.0), SaveAt::count(0.0, 10.0, 5001),
      [](std::span<const Sample>) {},
      [&](double t) {
        EXPECT_GE(t, latest);
        latest = t;
        ++calls;
      });
  EXPECT_GE(calls, 5000U);
  EXPECT_LE(calls, 5001U + static_cast<std::size_t>(run.statistics().steps));
  EXPECT_EQ(latest, 10.0);
}

TEST_P(ProgressOf, WhatItThrowsStopsTheRunAfterTheSamplesSoFar) {
  std::vector<double> seen;
  const SampleSink sink = [&seen](std::span<const Sample> block) {
    for (const Sample& sample : block) seen.push_back(sample.t);
  };
  const Progress stops = [](double t) {
    if (t >= 4.0) throw Interrupt{t};
  };
  try {
    integrate(problem(GetParam(), 0.0, 1e9), SaveAt::steps(0.0, 1e9, 0.25), sink, stops);
    FAIL() << "the run came to its end";
  } catch (const Interrupt& interrupt) {
    EXPECT_EQ(interrupt.t, 4.0);
    ASSERT_EQ(seen.size(), 17U);  // 0, 0.25, ... 4
    EXPECT_EQ(seen.back(), 4.0);
  }
}

TEST_P(ProgressOf, ItChangesNoBit) {
  const auto run = [](const Progress& progress) {
    return integrate(problem(GetParam(), 0.0, 10.0), {SaveAt::count(0.0, 10.0, 41)}, progress)
        .samples();
  };
  EXPECT_EQ(run({}), run([](double) {}));
}

TEST_P(ProgressOf, StateTransitionsTellAndStop) {
  std::vector<double> reported;
  state_transitions(problem(GetParam(), 0.0, 5.0), SaveAt::count(0.0, 5.0, 6),
                    [&](double t) { reported.push_back(t); });
  EXPECT_TRUE(std::is_sorted(reported.begin(), reported.end()));
  for (const double t : {1.0, 2.0, 3.0, 4.0, 5.0}) EXPECT_THAT(reported, testing::Contains(t));
  const Progress stops = [](double t) {
    if (t > 4.0) throw Interrupt{t};
  };
  EXPECT_THROW(state_transitions(problem(GetParam(), 0.0, 1e9), SaveAt::count(0.0, 1e9, 2), stops),
               Interrupt);
}

INSTANTIATE_TEST_SUITE_P(EveryMethod, ProgressOf,
                         testing::Values(Method(Adaptive{}),
                                         Method(Adaptive{.tolerance = 1e-15,
                                                         .precision = Precision::double_double}),
                                         Method(Splitting{0.05}), Method(VariationOfConstants{})));

}  // namespace
