// SPDX-License-Identifier: MIT
// Fourier analysis over angles: series that are known, folding, and what is refused.
#include "polhode/series/fourier.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/series/compiled_series.hpp"
#include "support.hpp"

namespace series_test {
namespace {

using namespace polhode;
using polhode::test::message_of;
using testing::HasSubstr;

Symbols two_angles() { return Symbols({"x"}, {"l", "g", "h"}); }

TEST(Fourier, GivesBackTheSeriesThatItSamples) {
  const Symbols symbols = two_angles();
  Draw draw(7);
  Series<double> first(symbols), second(symbols), third(symbols);
  for (Series<double>* one : {&first, &second, &third})
    for (int n = 0; n < 12; ++n) {
      const Multiples angle{{"l", draw.integer(-3, 3)}, {"h", draw.integer(-2, 2)}};
      *one += cosine(symbols, 0.1 * draw.integer(1, 9), {}, angle);
      *one += sine(symbols, 0.1 * draw.integer(1, 9), {}, angle);
    }
  const CompiledSeries a(first), b(second), c(third);
  const auto found = fourier_series(symbols, {{"h", 7}, {"l", 9}}, [&](std::span<const double> at) {
    const double point[] = {0.0, at[1], 0.0, at[0]};
    return std::vector<double>{a.at(point), b.at(point), c.at(point)};
  });
  ASSERT_EQ(found.series.size(), 3U);
  const Series<double>* const given[] = {&first, &second, &third};
  for (std::size_t i = 0; i < 3; ++i) {
    const Series<double> difference = found.series[i] - *given[i];
    for (const Term<double>& left : difference.terms())
      EXPECT_LT(std::abs(left.c), budget::fourier_series);
  }
  // One place on either side of the harmonics is free.
  EXPECT_LT(found.at_border, budget::fourier_series);
}

// cos 3 l at the points of a grid of 5 is cos 2 l.
TEST(Fourier, FoldsWhatTheGridDoesNotHold) {
  const Symbols symbols = two_angles();
  const auto found = fourier_series(
      symbols, {{"l", 5}},
      [](std::span<const double> at) { return std::vector<double>{std::cos(3.0 * at[0])}; }, 1e-9);
  ASSERT_EQ(found.series[0].size(), 1U);
  EXPECT_EQ(text(symbols, found.series[0].terms()[0].key), "cos(2*l)");
  EXPECT_NEAR(found.at_border, 1.0, budget::fourier_series);
}

TEST(Fourier, WhatIsRefused) {
  const Symbols symbols = two_angles();
  const auto one = [](std::span<const double>) { return std::vector<double>{1.0}; };
  EXPECT_REJECTED(fourier_series(symbols, {{"l", 4}}, one), "4 points for the angle l must be odd");
  EXPECT_REJECTED(fourier_series(symbols, {{"l", -1}}, one), "-1 points");
  EXPECT_REJECTED(fourier_series(symbols, {{"l", 3}, {"l", 3}}, one), "l is there twice");
  EXPECT_REJECTED(fourier_series(symbols, {{"x", 3}}, one), "x");
  EXPECT_REJECTED(fourier_series(symbols, {{"l", 9999}, {"g", 9999}}, one),
                  "the grid has more than");
  EXPECT_THAT(message_of([&] {
                fourier_series(symbols, {{"l", 3}}, [](std::span<const double> at) {
                  return std::vector<double>(at[0] > 0.0 ? 2 : 1);
                });
              }),
              HasSubstr("f has 2 values at one point and 1 at another"));
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    EXPECT_THAT(message_of([&] {
                  fourier_series(symbols, {{"l", 3}, {"g", 1}}, [&](std::span<const double> at) {
                    return std::vector<double>{1.0, at[0] > 4.0 ? bad : 0.0};
                  });
                }),
                HasSubstr(" at (4.18879020478639"));
  EXPECT_REJECTED(
      fourier_series(symbols, {{"l", 3}}, one, std::numeric_limits<double>::quiet_NaN()),
      "least nan must not be negative");
}

}  // namespace
}  // namespace series_test
