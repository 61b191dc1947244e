// SPDX-License-Identifier: MIT
// Spin axes in lanes. Oracles: one body at a time, to the last bit; the adaptive method at a tight
// tolerance; the closed form on an orbit that stays.
#include <gmock/gmock.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/dynamics/integrate_model.hpp"
#include "polhode/secular/spin_precession.hpp"
#include "worst.hpp"

namespace {

using namespace polhode;
using polhode::test::message_of;
using polhode::test::Worst;
using ::testing::HasSubstr;

constexpr double deg = std::numbers::pi / 180.0, arcsec = deg / 3600.0;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// Of the Earth, in kyr; a table from -200 to 200.
secular::ElementSeries series() {
  return {{{4248.976 * arcsec, 0.0189700, 30.613 * deg}, {7455.487 * arcsec, 0.0163175, 3.4874}},
          {{-18848.0 * arcsec, 0.0106447, 234.0 * deg}, {0.0, 0.01377449, 107.58 * deg}}};
}
secular::OrbitHistory table() {
  std::vector<double> times;
  std::vector<secular::OrbitElements> rows;
  for (int k = -200; k <= 200; ++k) {
    times.push_back(k);
    rows.push_back(series().at(times.back()));
  }
  return secular::OrbitHistory(secular::ElementTable(times, rows));
}

// Bodies that all differ, from slow to a quarter turn in a step.
std::vector<secular::PrecessionRates> many_rates(std::size_t count) {
  std::vector<secular::PrecessionRates> all;
  for (std::size_t i = 0; i < count; ++i) {
    const auto x = static_cast<double>(i);
    all.push_back({.star = (2000.0 + 997.0 * std::fmod(7.0 * x, 101.0)) * arcsec,
                   .satellites = 500.0 * std::fmod(x, 13.0) * arcsec,
                   .geodetic = 19.0 * std::fmod(x, 3.0) * arcsec,
                   .drift = i % 2 == 0 ? 0.0 : -1e-5});
  }
  return all;
}
std::vector<secular::SpinAxis> many_axes(std::size_t count) {
  std::vector<secular::SpinAxis> all;
  for (std::size_t i = 0; i < count; ++i) {
    const auto x = static_cast<double>(i);
    all.push_back({{std::cos(x), std::sin(3.0 * x) + 0.1, 1.5 * std::cos(0.7 * x)}});
  }
  return all;
}

using Row = std::vector<secular::SpinAxis>;

Row alone(const secular::OrbitHistory& orbit, const secular::PrecessionRates& rates,
          const secular::SpinAxis& start, const SaveAt& times, const Method& method,
          Outcome* outcome = nullptr) {
  using Model = secular::SpinPrecession<secular::OrbitHistory>;
  const BasicProblem<Model> problem{Model(orbit, rates), start, 0.0, times[times.size() - 1],
                                    method};
  const BasicTrajectory<secular::SpinAxis> run =
      integrate(problem, Keep{.samples = times, .dense = false});
  Row row;
  for (const auto& at : run.samples()) row.push_back(at.s);
  if (outcome != nullptr) *outcome = run.outcome();
  return row;
}

std::vector<std::uint64_t> bits(std::span<const secular::SpinAxis> row) {
  std::vector<std::uint64_t> all;
  for (const secular::SpinAxis& axis : row)
    for (const double x : {axis.s.x, axis.s.y, axis.s.z})
      all.push_back(std::bit_cast<std::uint64_t>(x));
  return all;
}

TEST(SpinHistories, AreThoseOfOneBodyToTheLastBit) {
  const secular::OrbitHistory orbit = table();
  const Splitting method{5.0, SplittingScheme::order8};
  for (const SaveAt& times :
       {SaveAt::times({0.0, 3.0, 5.0, 50.0, 101.7}), SaveAt::steps(0.0, -60.0, -7.5)})
    for (const std::size_t count : {1U, 7U, 300U}) {
      const std::vector<secular::PrecessionRates> rates = many_rates(count);
      const std::vector<secular::SpinAxis> starts = many_axes(count);
      const auto rows = static_cast<std::size_t>(times.size());
      for (const InstructionSet set : supported_instruction_sets()) {
        std::vector<secular::SpinAxis> all(count * rows);
        EXPECT_TRUE(secular::spin_histories(orbit, rates, starts, 0.0, times, method, all, {}, set)
                        .empty());
        for (std::size_t i = 0; i < count; i += count < 20 ? 1 : 37)
          EXPECT_EQ(bits(std::span(all).subspan(i * rows, rows)),
                    bits(alone(orbit, rates[i], starts[i], times, method)))
              << instruction_set_name(set) << " body " << i << " of " << count;
      }
    }
}

TEST(SpinHistories, AreThoseOfTheAdaptiveMethod) {
  const secular::OrbitHistory orbit{series()};
  const std::size_t count = 40;
  const std::vector<secular::PrecessionRates> rates = many_rates(count);
  const std::vector<secular::SpinAxis> starts = many_axes(count);
  const SaveAt end = SaveAt::times({2000.0});
  std::vector<secular::SpinAxis> all(count);
  secular::spin_histories(orbit, rates, starts, 0.0, end, {1.0, SplittingScheme::order8}, all);
  Worst worst;
  for (std::size_t i = 0; i < count; ++i)
    worst.add(norm(all[i].s - alone(orbit, rates[i], starts[i], end, Adaptive{1e-14})[0].s));
  EXPECT_LT(worst.value(), budget::secular_lanes);
}

TEST(SpinHistories, OnAnOrbitThatStaysTurnAboutItsNormal) {
  const secular::OrbitHistory still{secular::ElementSeries({{0.0, 0.2, 1.0}}, {{0.0, 0.4, 2.0}})};
  const Vec3 n = secular::orbit_normal(still.at(0.0));
  const std::vector<secular::SpinAxis> starts = many_axes(20);
  const SaveAt end = SaveAt::times({7.0});
  const secular::PrecessionRates rates{.star = 2.0, .satellites = 1.0, .geodetic = 0.3};
  std::vector<secular::SpinAxis> all(starts.size());
  secular::spin_histories(still, {&rates, 1}, starts, 0.0, end, {0.1, SplittingScheme::order2},
                          all);
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const Vec3 s = secular::spin_axis(starts[i].s).s;
    const double c = dot(s, n), angle = -((2.0 * std::pow(0.96, -1.5) + 1.0) * c - 0.3) * 7.0;
    const Vec3 exact = c * n + std::cos(angle) * (s - c * n) + std::sin(angle) * cross(n, s);
    EXPECT_LT(norm(all[i].s - exact), budget::secular_constant_orbit) << i;
  }
}

TEST(SpinHistories, WhatFailsFailsAlone) {
  const secular::OrbitHistory orbit = table();
  const Splitting method{5.0, SplittingScheme::order8};
  const SaveAt times = SaveAt::steps(0.0, 60.0, 20.0);
  const std::size_t count = 20, rows = 4;
  std::vector<secular::PrecessionRates> rates = many_rates(count);
  std::vector<secular::SpinAxis> starts = many_axes(count);
  std::vector<secular::SpinAxis> healthy(count * rows), all(count * rows);
  EXPECT_TRUE(secular::spin_histories(orbit, rates, starts, 0.0, times, method, healthy).empty());
  starts[3].s.y = nan;
  starts[5].s = {0.0, 0.0, 0.0};
  rates[7].geodetic = nan;
  rates[9].drift = -0.1;                              // turns round at t = 10
  rates[11].star = rates[11].satellites = 1.797e308;  // their sum is infinite
  const std::vector<secular::LostSpin> lost =
      secular::spin_histories(orbit, rates, starts, 0.0, times, method, all);
  std::vector<std::size_t> indices;
  for (const secular::LostSpin& one : lost) indices.push_back(one.index);
  ASSERT_THAT(indices, testing::ElementsAre(3, 5, 7, 9, 11));
  const char* const why[] = {"spin_axis: got a direction of length nan",
                             "spin_axis: got a direction of length 0",
                             "rates: got nan; expected finite rates",
                             "turns the torques round before t = 60", "is not finite after"};
  for (std::size_t k = 0; k < lost.size(); ++k) {
    EXPECT_EQ(lost[k].index, 3 + 2 * k);
    EXPECT_EQ(lost[k].outcome.t, 0.0);
    EXPECT_THAT(lost[k].outcome.advice, HasSubstr(why[k]));
  }
  for (std::size_t i = 0; i < count; ++i) {
    const bool is_lost = i >= 3 && i <= 11 && i % 2 == 1;
    const auto row = std::span(all).subspan(i * rows, rows);
    if (is_lost)
      EXPECT_TRUE(std::isnan(row.back().s.x)) << i;
    else
      EXPECT_EQ(bits(row), bits(std::span(healthy).subspan(i * rows, rows))) << i;
  }
}

TEST(SpinHistories, EndWithTheTable) {
  const secular::OrbitHistory orbit = table();
  const Splitting method{7.0, SplittingScheme::order8};
  const SaveAt times = SaveAt::steps(0.0, 250.0, 50.0);
  const std::vector<secular::PrecessionRates> rates = many_rates(10);
  const std::vector<secular::SpinAxis> starts = many_axes(10);
  std::vector<secular::SpinAxis> all(10 * 6);
  const std::vector<secular::LostSpin> lost =
      secular::spin_histories(orbit, rates, starts, 0.0, times, method, all);
  ASSERT_EQ(lost.size(), 10U);
  for (std::size_t i = 0; i < 10; ++i) {
    Outcome outcome;
    const Row row = alone(orbit, rates[i], starts[i], times, method, &outcome);
    EXPECT_EQ(lost[i].index, i);
    EXPECT_EQ(lost[i].outcome.t, outcome.t);
    EXPECT_EQ(lost[i].outcome.advice, outcome.advice);
    EXPECT_EQ(bits(std::span(all).subspan(6 * i, row.size())), bits(row));
    for (std::size_t k = row.size(); k < 6; ++k) EXPECT_TRUE(std::isnan(all[6 * i + k].s.z));
  }
}

TEST(SpinHistories, WhatDoesNotFitIsRefused) {
  const secular::OrbitHistory orbit = table();
  const secular::PrecessionRates rates{.star = 0.1};
  const std::vector<secular::SpinAxis> starts = many_axes(3);
  std::vector<secular::SpinAxis> room(8);
  const auto error = [&](const SaveAt& times, double step) {
    return message_of([&] {
      secular::spin_histories(orbit, {&rates, 1}, starts, 0.0, times, {step}, room);
    });
  };
  EXPECT_THAT(error(SaveAt::times({1, 2, 3}), 1.0), HasSubstr("room for 8 axes and 3 times"));
  EXPECT_THAT(error(SaveAt::times({1, 2}), 1.0), HasSubstr("got 3 starts and room for 4 bodies"));
  EXPECT_THAT(error(SaveAt::times({-1, 2}), 1.0), HasSubstr("on two sides of the epoch 0"));
  EXPECT_THAT(error(SaveAt::times({-2, -1, 0}), 1.0), HasSubstr("running towards the epoch 0"));
  EXPECT_THAT(error(SaveAt::times({1, 2}), -1.0), HasSubstr("step"));
}

}  // namespace
