// SPDX-License-Identifier: MIT
// Compiled series against the definition in 50 digits, alone and among other points.
#include <gmock/gmock.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <limits>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/series/compiled_series.hpp"
#include "polhode/series/series_text.hpp"
#include "unit/series/support.hpp"
#include "worst.hpp"

namespace series_test {
namespace {

using boost::multiprecision::cpp_bin_float_50;
using namespace polhode;
using polhode::test::Worst;

Series<double> in_doubles(const Symbols& symbols, Draw& draw, int terms) {
  return drawn<double>(symbols, draw, terms, -3, 4, 5,
                       [&] { return draw.integer(-1000, 1000) / 97.0; });
}

TEST(CompiledSeries, IsTheDefinition) {
  const Symbols symbols = some_symbols();
  Worst worst;
  for (unsigned seed = 0; seed < 20; ++seed) {
    Draw draw(1400 + seed);
    const Series<double> a = in_doubles(symbols, draw, 50);
    const CompiledSeries compiled(a);
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
    for (const Term<double>& term : a.terms()) {
      cpp_bin_float_50 one = std::abs(term.c);
      for (std::size_t i = 0; i < sizes.variables.size(); ++i)
        one *= to_power(sizes.variables[i], exponent(symbols, term.key, static_cast<int>(i)));
      size += one;
    }
    const cpp_bin_float_50 error = abs(cpp_bin_float_50(compiled.at(point)) - exact) / size;
    worst.add(error.convert_to<double>() / std::numeric_limits<double>::epsilon());
  }
  EXPECT_LE(worst.value(), budget::compiled_series_eps);
}

TEST(CompiledSeries, APointIsTheSameAmongOthers) {
  const Symbols symbols = some_symbols();
  Draw draw(1500);
  const CompiledSeries compiled(in_doubles(symbols, draw, 80));
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
  const Symbols symbols({"e"}, {"l"});
  const CompiledSeries zero{Series<double>(symbols)};
  EXPECT_EQ(zero.at(std::vector<double>{1.0, 2.0}), 0.0);
  const CompiledSeries one(constant(Symbols({}, {}), 2.5));
  EXPECT_EQ(one.at({}), 2.5);
  EXPECT_TRUE(zero.at_each({}).empty());
  EXPECT_REJECTED(zero.at(std::vector<double>(3)), "a point of 3 numbers; it needs 2");
  EXPECT_REJECTED(zero.at_each(std::vector<double>(3)), "points of 3 numbers in all; each needs 2");
}

// The same algebra with 50 digits, whose text is read back as it was.
TEST(MultiprecisionSeries, ComputesAndIsReadBack) {
  const Symbols symbols = some_symbols();
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
  EXPECT_EQ(series_from_text<cpp_bin_float_50>(symbols, text(a)), a);
  EXPECT_EQ(series_from_csv<cpp_bin_float_50>(symbols, csv(a)), a);
}

}  // namespace
}  // namespace series_test
