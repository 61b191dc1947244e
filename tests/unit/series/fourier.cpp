// SPDX-License-Identifier: MIT
// Fourier analysis over angles: series that are known, folding, and what is refused.
#include "series/fourier.hpp"

#include <gmock/gmock.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <limits>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/series/compiled_series.hpp"
#include "polhode/series/linear_flow.hpp"
#include "polhode/series/series_text.hpp"
#include "support.hpp"
#include "unit/series/support.hpp"
#include "worst.hpp"

namespace series_test {
namespace {

using namespace polhode;
using polhode::series::AngleRate;
using polhode::test::message_of;
using testing::HasSubstr;
using Rates = std::vector<AngleRate<series::Rational>>;
using boost::multiprecision::cpp_bin_float_50;
using polhode::test::Worst;

series::Symbols two_angles() { return series::Symbols({"x"}, {"l", "g", "h"}); }

TEST(Fourier, GivesBackTheSeriesThatItSamples) {
  const series::Symbols symbols = two_angles();
  Draw draw(7);
  series::Series<double> first(symbols), second(symbols), third(symbols);
  for (series::Series<double>* one : {&first, &second, &third})
    for (int n = 0; n < 12; ++n) {
      const series::Multiples angle{{"l", draw.integer(-3, 3)}, {"h", draw.integer(-2, 2)}};
      *one += series::cosine(symbols, 0.1 * draw.integer(1, 9), {}, angle);
      *one += series::sine(symbols, 0.1 * draw.integer(1, 9), {}, angle);
    }
  const series::CompiledSeries a(first), b(second), c(third);
  const auto found =
      series::fourier_series(symbols, {{"h", 7}, {"l", 9}}, [&](std::span<const double> at) {
        const double point[] = {0.0, at[1], 0.0, at[0]};
        return std::vector<double>{a.at(point), b.at(point), c.at(point)};
      });
  ASSERT_EQ(found.series.size(), 3U);
  const series::Series<double>* const given[] = {&first, &second, &third};
  for (std::size_t i = 0; i < 3; ++i) {
    const series::Series<double> difference = found.series[i] - *given[i];
    for (const series::Term<double>& left : difference.terms())
      EXPECT_LT(std::abs(left.c), budget::fourier_series);
  }
  // One place on either side of the harmonics is free.
  EXPECT_LT(found.at_border, budget::fourier_series);
}

// cos 3 l at the points of a grid of 5 is cos 2 l.
TEST(Fourier, FoldsWhatTheGridDoesNotHold) {
  const series::Symbols symbols = two_angles();
  const auto found = series::fourier_series(
      symbols, {{"l", 5}},
      [](std::span<const double> at) { return std::vector<double>{std::cos(3.0 * at[0])}; }, 1e-9);
  ASSERT_EQ(found.series[0].size(), 1U);
  EXPECT_EQ(series::text(symbols, found.series[0].terms()[0].key), "cos(2*l)");
  EXPECT_NEAR(found.at_border, 1.0, budget::fourier_series);
}

TEST(Fourier, WhatIsRefused) {
  const series::Symbols symbols = two_angles();
  const auto one = [](std::span<const double>) { return std::vector<double>{1.0}; };
  EXPECT_REJECTED(series::fourier_series(symbols, {{"l", 4}}, one),
                  "4 points for the angle l must be odd");
  EXPECT_REJECTED(series::fourier_series(symbols, {{"l", -1}}, one), "-1 points");
  EXPECT_REJECTED(series::fourier_series(symbols, {{"l", 3}, {"l", 3}}, one), "l is there twice");
  EXPECT_REJECTED(series::fourier_series(symbols, {{"x", 3}}, one), "x");
  EXPECT_REJECTED(series::fourier_series(symbols, {{"l", 9999}, {"g", 9999}}, one),
                  "the grid has more than");
  EXPECT_THAT(message_of([&] {
                series::fourier_series(symbols, {{"l", 3}}, [](std::span<const double> at) {
                  return std::vector<double>(at[0] > 0.0 ? 2 : 1);
                });
              }),
              HasSubstr("f has 2 values at one point and 1 at another"));
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    EXPECT_THAT(message_of([&] {
                  series::fourier_series(symbols, {{"l", 3}, {"g", 1}},
                                         [&](std::span<const double> at) {
                                           return std::vector<double>{1.0, at[0] > 4.0 ? bad : 0.0};
                                         });
                }),
                HasSubstr(" at (4.18879020478639"));
  EXPECT_REJECTED(
      series::fourier_series(symbols, {{"l", 3}}, one, std::numeric_limits<double>::quiet_NaN()),
      "least nan must not be negative");
}

// Means and integrals: what is differentiated along the flow is what was integrated.

Exact along(const Exact& s, const Rates& rates) {
  Exact sum(s.symbols());
  for (const auto& [angle, rate] : rates) sum += rate * series::derivative(s, angle);
  return sum;
}
Exact without_mean(const Exact& a) { return a - series::mean(a, a.symbols().angles()); }

TEST(LinearFlow, IntegralsAreUndoneByTheFlow) {
  const series::Symbols symbols = some_symbols();
  const auto number = [&](series::Rational c) { return series::constant(symbols, std::move(c)); };
  for (unsigned seed = 0; seed < 5; ++seed) {
    Draw draw(1200 + seed);
    const Exact f = without_mean(drawn_series(symbols, draw, 20));
    ASSERT_GE(f.size(), 15U);
    const Rates rates{{"l", number(series::Rational(3))},
                      {"g", number(series::Rational(7, 5))},
                      {"x", number(series::Rational(-1, 11))}};
    EXPECT_EQ(along(series::integral(f, rates, 0.0), rates), f);
    // All rates go as G / L.
    const Exact factor = series::monomial(symbols, series::Rational(2), {{"G", 1}, {"L", -1}});
    const Rates scaled{{"l", factor},
                       {"g", series::Rational(7, 5) * factor},
                       {"x", series::Rational(1, 11) * factor}};
    EXPECT_EQ(along(series::integral(f, scaled, 0.0), scaled), f);
  }
}

TEST(LinearFlow, AMeanHasNoneOfItsAnglesAndTheRestAll) {
  const series::Symbols symbols = some_symbols();
  Draw draw(1300);
  const Exact a = drawn_series(symbols, draw, 60) +
                  series::cosine(symbols, series::Rational(5), {{"e", 1}}, {{"x", 2}});
  const Exact slow = series::mean(a, {"l", "g"});
  ASSERT_FALSE(slow.is_zero());
  EXPECT_TRUE(series::derivative(slow, "l").is_zero());
  EXPECT_TRUE(series::derivative(slow, "g").is_zero());
  EXPECT_FALSE(series::derivative(slow, "x").is_zero());
  EXPECT_TRUE(series::mean(a - slow, {"l", "g"}).is_zero());
  EXPECT_EQ(series::mean(a, {}), a);
  EXPECT_REJECTED(series::mean(a, {"y"}), "no angle 'y'");
}

TEST(LinearFlow, RefusesSmallDivisorsByName) {
  const series::Symbols symbols = some_symbols();
  const Exact one = series::constant(symbols, series::Rational(1));
  const Exact f = series::cosine(symbols, series::Rational(1), {{"e", 2}}, {{"l", 2}, {"g", -1}});
  const auto refused = [&](const Rates& rates, double least) {
    return message_of([&] { return series::integral(f, rates, least); });
  };
  const Rates near{{"l", one}, {"g", series::Rational(1999, 1000) * one}};
  EXPECT_EQ(series::integral(f, near, 1e-3),
            series::sine(symbols, series::Rational(1000), {{"e", 2}}, {{"l", 2}, {"g", -1}}));
  EXPECT_THAT(refused(near, 2e-3), HasSubstr("2*l - g"));
  EXPECT_THAT(refused(near, 2e-3), HasSubstr("0.001, below the bound 0.002"));
  EXPECT_THAT(refused({{"l", one}, {"g", series::Rational(2) * one}}, 0.0),
              HasSubstr("a resonance"));
  EXPECT_THAT(
      refused({{"l", one}, {"g", series::monomial(symbols, series::Rational(1), {{"G", 1}})}}, 0.0),
      HasSubstr("a sum of 2 terms"));
  EXPECT_THAT(refused({{"l", f}}, 0.0), HasSubstr("depends on angles"));
  EXPECT_THAT(refused({{"y", one}}, 0.0), HasSubstr("no angle 'y'"));
  EXPECT_REJECTED(series::integral(one, near, 0.0), "no angle; take the mean");
}

// Compiled series against the definition in 50 digits, alone and among other points.

series::Series<double> in_doubles(const series::Symbols& symbols, Draw& draw, int terms) {
  return drawn<double>(symbols, draw, terms, -3, 4, 5,
                       [&] { return draw.integer(-1000, 1000) / 97.0; });
}

TEST(CompiledSeries, IsTheDefinition) {
  const series::Symbols symbols = some_symbols();
  Worst worst;
  for (unsigned seed = 0; seed < 20; ++seed) {
    Draw draw(1400 + seed);
    const series::Series<double> a = in_doubles(symbols, draw, 50);
    const series::CompiledSeries compiled(a);
    EXPECT_EQ(compiled.size(), a.size());
    std::vector<double> point;
    Point<cpp_bin_float_50> at, sizes;
    for (std::size_t i = 0; i < symbols.variables().size(); ++i) {
      point.push_back(draw.integer(-300, 300) / 200.0 + 1.6e-3);
      at.variables.emplace_back(point.back());
      sizes.variables.emplace_back(std::abs(point.back()));
    }
    for (std::size_t i = 0; i < symbols.angles().size(); ++i) {
      point.push_back(draw.integer(-300, 300) / 100.0);
      at.cosines.push_back(cos(cpp_bin_float_50(point.back())));
      at.sines.push_back(sin(cpp_bin_float_50(point.back())));
    }
    const auto exact = value(a, at, [](double c) { return cpp_bin_float_50(c); });
    // Sum of |C a^n|: without the angles.
    cpp_bin_float_50 size = 0;
    for (const series::Term<double>& term : a.terms()) {
      cpp_bin_float_50 one = std::abs(term.c);
      for (std::size_t i = 0; i < sizes.variables.size(); ++i)
        one *=
            to_power(sizes.variables[i], series::exponent(symbols, term.key, static_cast<int>(i)));
      size += one;
    }
    const cpp_bin_float_50 error = abs(cpp_bin_float_50(compiled.at(point)) - exact) / size;
    worst.add(error.convert_to<double>() / std::numeric_limits<double>::epsilon());
  }
  EXPECT_LE(worst.value(), budget::compiled_series_eps);
}

TEST(CompiledSeries, APointIsTheSameAmongOthers) {
  const series::Symbols symbols = some_symbols();
  Draw draw(1500);
  const series::CompiledSeries compiled(in_doubles(symbols, draw, 80));
  const std::size_t n = compiled.dimension();
  ASSERT_EQ(n, 8U);
  std::vector<double> points;
  for (std::size_t i = 0; i < 29 * n; ++i) points.push_back(draw.integer(1, 999) / 301.0);
  const std::vector<double> values = compiled.at_each(points);
  ASSERT_EQ(values.size(), 29U);
  for (std::size_t i = 0; i < values.size(); ++i)
    EXPECT_EQ(values[i], compiled.at(std::span<const double>(points).subspan(i * n, n)));
}

TEST(CompiledSeries, EdgesAndErrors) {
  const series::Symbols symbols({"e"}, {"l"});
  const series::CompiledSeries zero{series::Series<double>(symbols)};
  EXPECT_EQ(zero.at(std::vector<double>{1.0, 2.0}), 0.0);
  const series::CompiledSeries one(series::constant(series::Symbols({}, {}), 2.5));
  EXPECT_EQ(one.at({}), 2.5);
  EXPECT_TRUE(zero.at_each({}).empty());
  EXPECT_REJECTED(zero.at(std::vector<double>(3)), "a point of 3 numbers; it needs 2");
  EXPECT_REJECTED(zero.at_each(std::vector<double>(3)), "points of 3 numbers in all; each needs 2");
}

// The same algebra with 50 digits, whose text is read back as it was.
TEST(MultiprecisionSeries, ComputesAndIsReadBack) {
  const series::Symbols symbols = some_symbols();
  Draw draw(1600);
  const auto third = [&] { return cpp_bin_float_50(draw.integer(-9, 9)) / 3; };
  const auto a = drawn<cpp_bin_float_50>(symbols, draw, 8, -1, 2, 2, third);
  const auto b = drawn<cpp_bin_float_50>(symbols, draw, 8, -1, 2, 2, third);
  Point<cpp_bin_float_50> at;
  for (int i = 0; i < 5; ++i) at.variables.emplace_back(0.5 + 0.25 * i);
  for (int i = 0; i < 3; ++i) {
    at.cosines.push_back(cos(cpp_bin_float_50(i)));
    at.sines.push_back(sin(cpp_bin_float_50(i)));
  }
  const auto as_it_is = [](const cpp_bin_float_50& c) { return c; };
  const cpp_bin_float_50 error =
      value(a * b, at, as_it_is) / (value(a, at, as_it_is) * value(b, at, as_it_is)) - 1;
  EXPECT_LE(abs(error).convert_to<double>(), budget::series_of_50_digits);
  EXPECT_EQ(series::series_from_text<cpp_bin_float_50>(symbols, series::text(a)), a);
  EXPECT_EQ(series::series_from_csv<cpp_bin_float_50>(symbols, series::csv(a)), a);
}

}  // namespace
}  // namespace series_test
