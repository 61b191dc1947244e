// SPDX-License-Identifier: MIT
// Means and integrals: what is differentiated along the flow is what was integrated.
#include "polhode/series/linear_flow.hpp"

#include <gmock/gmock.h>

#include "message_of.hpp"
#include "unit/series/support.hpp"

namespace series_test {
namespace {

using polhode::AngleRate;
using polhode::test::message_of;
using testing::HasSubstr;

using Rates = std::vector<AngleRate<Rational>>;

Exact along(const Exact& s, const Rates& rates) {
  Exact sum(s.symbols());
  for (const auto& [angle, rate] : rates) sum += rate * derivative(s, angle);
  return sum;
}
Exact without_mean(const Exact& a) { return a - mean(a, a.symbols().angles()); }

TEST(LinearFlow, IntegralsAreUndoneByTheFlow) {
  const Symbols symbols = some_symbols();
  const auto number = [&](Rational c) { return constant(symbols, std::move(c)); };
  for (unsigned seed = 0; seed < 5; ++seed) {
    Draw draw(1200 + seed);
    const Exact f = without_mean(drawn_series(symbols, draw, 20));
    ASSERT_GE(f.size(), 15U);
    const Rates rates{
        {"l", number(Rational(3))}, {"g", number(Rational(7, 5))}, {"x", number(Rational(-1, 11))}};
    EXPECT_EQ(along(integral(f, rates, 0.0), rates), f);
    // All rates go as G / L.
    const Exact factor = monomial(symbols, Rational(2), {{"G", 1}, {"L", -1}});
    const Rates scaled{
        {"l", factor}, {"g", Rational(7, 5) * factor}, {"x", Rational(1, 11) * factor}};
    EXPECT_EQ(along(integral(f, scaled, 0.0), scaled), f);
  }
}

TEST(LinearFlow, AMeanHasNoneOfItsAnglesAndTheRestAll) {
  const Symbols symbols = some_symbols();
  Draw draw(1300);
  const Exact a =
      drawn_series(symbols, draw, 60) + cosine(symbols, Rational(5), {{"e", 1}}, {{"x", 2}});
  const Exact slow = mean(a, {"l", "g"});
  ASSERT_FALSE(slow.is_zero());
  EXPECT_TRUE(derivative(slow, "l").is_zero());
  EXPECT_TRUE(derivative(slow, "g").is_zero());
  EXPECT_FALSE(derivative(slow, "x").is_zero());
  EXPECT_TRUE(mean(a - slow, {"l", "g"}).is_zero());
  EXPECT_EQ(mean(a, {}), a);
  EXPECT_REJECTED(mean(a, {"y"}), "no angle 'y'");
}

TEST(LinearFlow, RefusesSmallDivisorsByName) {
  const Symbols symbols = some_symbols();
  const Exact one = constant(symbols, Rational(1));
  const Exact f = cosine(symbols, Rational(1), {{"e", 2}}, {{"l", 2}, {"g", -1}});
  const auto refused = [&](const Rates& rates, double least) {
    return message_of([&] { return integral(f, rates, least); });
  };
  const Rates near{{"l", one}, {"g", Rational(1999, 1000) * one}};
  EXPECT_EQ(integral(f, near, 1e-3),
            sine(symbols, Rational(1000), {{"e", 2}}, {{"l", 2}, {"g", -1}}));
  EXPECT_THAT(refused(near, 2e-3), HasSubstr("2*l - g"));
  EXPECT_THAT(refused(near, 2e-3), HasSubstr("0.001, below the bound 0.002"));
  EXPECT_THAT(refused({{"l", one}, {"g", Rational(2) * one}}, 0.0), HasSubstr("a resonance"));
  EXPECT_THAT(refused({{"l", one}, {"g", monomial(symbols, Rational(1), {{"G", 1}})}}, 0.0),
              HasSubstr("a sum of 2 terms"));
  EXPECT_THAT(refused({{"l", f}}, 0.0), HasSubstr("depends on angles"));
  EXPECT_THAT(refused({{"y", one}}, 0.0), HasSubstr("no angle 'y'"));
  EXPECT_REJECTED(integral(one, near, 0.0), "no angle; take the mean");
}

}  // namespace
}  // namespace series_test
