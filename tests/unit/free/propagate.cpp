// SPDX-License-Identifier: MIT
// Many bodies in lanes: against Taylor integration with 76 digits, and the same bits whatever lies
// beside a body, however many there are and whichever instructions compute.
#include "polhode/free/propagate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include "budgets.hpp"
#include "message_of.hpp"
#include "oracle/free_accuracy.hpp"
#include "oracle/free_edge_cases.hpp"
#include "polhode/free/rounding_sensitivity.hpp"
#include "unit/free/support.hpp"

namespace {

using namespace free_test;
using namespace polhode;

// Rows of many bodies; moments need not be those of a body.
struct Many {
  std::vector<Vec3> moments;
  std::vector<RotorState> states;
  std::vector<double> times, epochs;

  void add(const FreeCase& c) {
    moments.push_back(c.moments);
    states.push_back(c.start);
    times.push_back(c.t);
    epochs.push_back(c.t0);
  }
  std::size_t size() const { return times.size(); }
  polhode::BodyRows rows(std::size_t first = 0) const {
    return {
        {&moments[first].x, 3}, {&states[first].q.w, 7}, {&times[first], 1}, {&epochs[first], 1}};
  }
  std::vector<RotorState> at(InstructionSet set = polhode::widest_instruction_set()) const {
    std::vector<RotorState> results(size());
    EXPECT_TRUE(propagate(rows(), results, set).empty());
    return results;
  }
};

FreeCase drawn(oracle::CaseMaker maker, std::uint64_t seed, std::size_t i) {
  Draw draw(seed << 32U, i);
  return maker(draw);
}

// Errors of a sample: every one within the budget, and their median.
void expect_exact(const Many& many, const std::string& what) {
  const std::vector<RotorState> found = many.at();
  std::vector<double> errors;
  polhode::test::Worst<> worst;
  for (std::size_t i = 0; i < many.size(); ++i) {
    oracle::FreeBody body(many.moments[i], many.states[i].q, many.states[i].g);
    const oracle::FreeError e = oracle::error_at(body, found[i], many.times[i], many.epochs[i]);
    errors.push_back(larger(e.angle, e.momentum));
    worst.add(errors.back(), what + " " + std::to_string(i));
  }
  std::nth_element(errors.begin(), errors.begin() + static_cast<long>(errors.size() / 2),
                   errors.end());
  EXPECT_LE(worst.value(), budget::free_many) << worst.where();
  EXPECT_LE(errors[errors.size() / 2], budget::free_many_median) << what;
  testing::Test::RecordProperty("worst", std::to_string(worst.value() * 1e16));
}

std::size_t sample(std::size_t few, std::size_t all) {
  return std::getenv("POLHODE_TEST_FULL") != nullptr ? all : few;
}

struct Class {
  const char* name;
  oracle::CaseMaker maker;
};
const Class classes[] = {{"random", oracle::random_case},
                         {"near an axis", oracle::near_axis_case},
                         {"nearly equal moments", oracle::nearly_equal_case},
                         {"near the separatrix", oracle::near_separatrix_case},
                         {"on the separatrix", oracle::exact_separatrix_case},
                         {"small angles", oracle::small_angle_case},
                         {"needles, discs and units", oracle::extreme_case},
                         {"about the middle axis", oracle::middle_spin_case}};

TEST(Propagate, IsExactForEveryKindOfBody) {
  std::uint64_t seed = 300;
  for (const Class& c : classes) {
    Many many;
    ++seed;
    for (std::size_t i = 0; i < sample(5, 1000); ++i) many.add(drawn(c.maker, seed, i));
    expect_exact(many, c.name);
  }
}

TEST(Propagate, IsExactWithinAHundredTurnsAndAfterABillion) {
  std::uint64_t seed = 320;
  for (const double turns : {-100.0, 37.5, 1e4, -1e9}) {
    Many many;
    ++seed;
    for (std::size_t i = 0; i < sample(12, 2000); ++i) {
      FreeCase c = drawn(i % 4 == 0 ? oracle::close_separatrix_case : oracle::random_case, seed, i);
      set_time(c, turns);
      many.add(c);
    }
    expect_exact(many, std::to_string(turns) + " turns");
  }
}

// FreeRotation is compared with the oracle in tests/property: here thousands are with it.
TEST(Propagate, AgreesWithFreeRotationForThousandsOfBodies) {
  std::uint64_t seed = 360;
  for (const Class& c : classes) {
    Many many;
    ++seed;
    Draw draw(seed, 0);
    for (std::size_t i = 0; i < 1000; ++i) {
      FreeCase drawn_case = drawn(c.maker, seed, i);
      if (i % 2 == 0) set_time(drawn_case, draw.sign() * draw.power_of_ten(-3, 9));
      many.add(drawn_case);
    }
    const std::vector<RotorState> found = many.at();
    polhode::test::Worst<> worst;
    for (std::size_t i = 0; i < many.size(); ++i) {
      const Vec3& I = many.moments[i];
      const FreeRotation m(Body(I.x, I.y, I.z), many.states[i], many.epochs[i]);
      const RotorState s = m.at(many.times[i]);
      worst.add(larger(attitude_difference(found[i].q, s.q),
                       norm(found[i].g - s.g) / norm(many.states[i].g)),
                std::string(c.name) + " " + std::to_string(i));
    }
    EXPECT_LE(worst.value(), budget::free_many + budget::free_state) << worst.where();
  }
}

// Of every kind and regime, in a mixed order.
Many mixed_bodies(std::size_t count) {
  Many many;
  Draw draw(341, 0);
  for (std::size_t i = 0; i < count; ++i) {
    FreeCase c = drawn(classes[i * 7 % 8].maker, 340, i);
    if (i % 5 == 0) set_time(c, draw.sign() * draw.power_of_ten(-3, 9));
    many.add(c);
  }
  for (const NamedMotion& n : motions())
    for (const double t : {0.0, 1.25, -1e6, 1e18}) many.add({n.moments, n.start(), 0.5, t});
  return many;
}

TEST(Propagate, HasTheSameBitsByEverySet) {
  const Many many = mixed_bodies(1500);
  const std::vector<RotorState> baseline = many.at(InstructionSet::baseline);
  for (const InstructionSet set : polhode::supported_instruction_sets()) {
    const std::vector<RotorState> found = many.at(set);
    for (std::size_t i = 0; i < many.size(); ++i)
      ASSERT_EQ(bits(found[i]), bits(baseline[i])) << instruction_set_name(set) << ", " << i;
  }
}

TEST(Propagate, HasTheSameBitsAloneAndInAnyCompany) {
  const Many many = mixed_bodies(300);
  const std::vector<RotorState> together = many.at();
  for (std::size_t first = 0; first < many.size(); ++first)
    for (const std::size_t count : {1U, 2U, 3U, 7U, 9U, 33U}) {
      if (first + count > many.size() || (count > 1 && first % 11 != 0)) continue;
      const RotorState unset{{7.0, 7.0, 7.0, 7.0}, {7.0, 7.0, 7.0}};
      std::vector<RotorState> found(count + 1, unset);
      propagate(many.rows(first), std::span(found).first(count));
      for (std::size_t i = 0; i < count; ++i)
        ASSERT_EQ(bits(found[i]), bits(together[first + i])) << count << " from " << first;
      EXPECT_EQ(bits(found[count]), bits(unset));
    }
}

TEST(Propagate, IsFreeRotationWhereLanesDoNotReach) {
  for (const NamedMotion& n : motions()) {
    if (n.regime != Regime::steady && n.regime != Regime::rest && n.regime != Regime::separatrix)
      continue;
    for (const double t : {0.0, -3.5, 1e12, infinite, not_a_number}) {
      const Body body = n.body();
      const RotorState start = n.start();
      RotorState found;
      EXPECT_TRUE(propagate({&body, 1}, {&start, 1}, {&t, 1}, 0.25, {&found, 1}).empty());
      EXPECT_EQ(bits(found), bits(n.motion(0.25).at(t))) << n.name << ", t = " << t;
    }
  }
}

TEST(Propagate, TakesOneForAll) {
  const Body body(1.0, 1.5, 2.2);
  const RotorState start{{1.0, 0.2, 0.1, -0.4}, {0.5, 0.7, 1.6}};
  const std::vector<double> times{0.5, 3.25, -7.0, 1e5};
  std::vector<RotorState> results(times.size());
  EXPECT_TRUE(propagate({&body, 1}, {&start, 1}, times, 0.0, results).empty());
  for (std::size_t i = 0; i < times.size(); ++i) {
    RotorState alone;
    propagate({&body, 1}, {&start, 1}, {&times[i], 1}, 0.0, {&alone, 1});
    EXPECT_EQ(bits(results[i]), bits(alone));
  }
  EXPECT_TRUE(propagate({}, {&start, 1}, {}, 0.0, {}).empty());
}

TEST(Propagate, WhatFailsFailsAlone) {
  Many many;
  for (std::size_t i = 0; i < 40; ++i) many.add(drawn(oracle::random_case, 350, i));
  const std::vector<RotorState> sound = many.at();
  many.states[3].g.y = not_a_number;
  many.states[17].q = {0.0, 0.0, 0.0, 0.0};
  many.moments[18] = {1.0, 2.0, 4.0};
  many.moments[30] = {1.0, -2.0, 2.0};
  many.times[31] = not_a_number;
  many.epochs[39] = infinite;
  for (const InstructionSet set : polhode::supported_instruction_sets()) {
    std::vector<RotorState> found(many.size());
    const std::vector<FailedBody> failed = propagate(many.rows(), found, set);
    ASSERT_EQ(failed.size(), 5U);
    const std::size_t indices[] = {3, 17, 18, 30, 39};
    const char* const reasons[] = {"is not finite", "non-zero quaternion", "break I3 <= I1 + I2",
                                   "must be positive", "is not finite"};
    for (std::size_t k = 0; k < 5; ++k) {
      EXPECT_EQ(failed[k].index, indices[k]);
      EXPECT_NE(failed[k].reason.find(reasons[k]), std::string::npos) << failed[k].reason;
      EXPECT_TRUE(std::isnan(found[indices[k]].q.w) && std::isnan(found[indices[k]].g.z));
    }
    EXPECT_TRUE(std::isnan(found[31].q.w));
    for (std::size_t i = 0; i < many.size(); ++i) {
      if (i == 31 || std::find(indices, indices + 5, i) != indices + 5) continue;
      EXPECT_EQ(bits(found[i]), bits(sound[i])) << i;
    }
  }
}

TEST(Propagate, RefusesWhatDoesNotFit) {
  const std::vector<Body> bodies(3, Body(1.0, 1.5, 2.2));
  const RotorState start{{1.0, 0.2, 0.1, -0.4}, {0.5, 0.7, 1.6}};
  const double t = 1.0;
  std::vector<RotorState> results(2);
  EXPECT_MESSAGE(
      propagate(bodies, {&start, 1}, {&t, 1}, 0.0, results),
      "propagate: got 3 bodies and room for 2 results; expected as many, or one for all");
}

constexpr double eps = std::numeric_limits<double>::epsilon();

// A sphere at rate w = g / I: one rounding of g or I turns it by eps w t / 2 to eps w t more.
TEST(RoundingSensitivity, OfASphereIsThatOfItsAngle) {
  const FreeRotation motion(Body(1.5, 1.5, 1.5), {{1, 0, 0, 0}, {0, 0, 3.3}});
  const double w = 3.3 / 1.5;
  for (const double t : {1e3, 1e6, 1e9}) {
    const double moved = free::rounding_sensitivity(motion, t);
    EXPECT_GE(moved, budget::sensitivity_least * eps * w * t);
    EXPECT_LE(moved, budget::sensitivity_most * eps * w * t);
  }
}

TEST(RoundingSensitivity, IsAtLeastARoundingOfTheState) {
  const FreeRotation motion(Body(1.0, 1.7, 2.1), {{1, 0, 0, 0}, {0.3, 0.2, 1.0}});
  EXPECT_LE(free::rounding_sensitivity(motion, 0.0), budget::sensitivity_most * eps);
  EXPECT_GT(free::rounding_sensitivity(motion, 1e6), budget::sensitivity_of_a_turn * eps * 1e6);
}

// Next to the middle axis the next flip comes by -ln(g1)/n: a rounding of a moment moves the
// distance from the separatrix by eps G^2, that is by all of it.
TEST(RoundingSensitivity, IsEverythingWhereTheSeparatrixIsARoundingAway) {
  const FreeRotation near(Body(0.32200176517297396, 0.3789751609709488, 0.661517593383879),
                          {{1, 0, 0, 0}, {0.8233251531952871, -0.3, 0.5299161674818204}});
  const FreeRotation far(Body(1.0, 1.7, 2.1), {{1, 0, 0, 0}, {0.3, 0.2, 1.0}});
  EXPECT_GT(free::rounding_sensitivity(near, 200.0),
            budget::sensitivity_at_separatrix * free::rounding_sensitivity(far, 200.0));
}

TEST(RoundingSensitivity, IsHalfATurnWhereNoPhaseIsLeft) {
  const Body body(1.0, 2.0, 3.0);
  for (const Vec3& g : {Vec3{1e30, 0.0, 0.0}, Vec3{1e30, 2.0, 3.0}, Vec3{0.3, 0.2, 1.0}})
    EXPECT_EQ(free::rounding_sensitivity(FreeRotation(body, {{1, 0, 0, 0}, g}), 1e30),
              std::acos(-1.0));
}

TEST(RoundingSensitivity, TakesFlatBodiesAndRefusesNoTime) {
  const FreeRotation flat(Body(1.0, 2.0, 3.0), {{1, 0, 0, 0}, {0.3, 0.2, 1.0}});
  EXPECT_TRUE(std::isfinite(free::rounding_sensitivity(flat, 10.0)));
  EXPECT_TRUE(std::isnan(free::rounding_sensitivity(flat, HUGE_VAL)));
  EXPECT_TRUE(std::isnan(free::rounding_sensitivity(flat, std::nan(""))));
}

}  // namespace
