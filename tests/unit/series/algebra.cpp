// SPDX-License-Identifier: MIT
// Laws of the algebra, exact in rationals on series drawn at random.
#include <gmock/gmock.h>

#include "unit/series/support.hpp"

namespace series_test {
namespace {

constexpr unsigned seeds = 8;

TEST(SeriesAlgebra, IsACommutativeRing) {
  const Symbols symbols = some_symbols();
  for (unsigned seed = 0; seed < seeds; ++seed) {
    Draw draw(100 + seed);
    const Exact a = drawn_series(symbols, draw), b = drawn_series(symbols, draw),
                c = drawn_series(symbols, draw);
    EXPECT_EQ(a + b, b + a);
    EXPECT_EQ((a + b) + c, a + (b + c));
    EXPECT_TRUE((a - a).is_zero());
    EXPECT_EQ(a - b, a + (-b));
    EXPECT_EQ(a * b, b * a);
    EXPECT_EQ((a * b) * c, a * (b * c));
    EXPECT_EQ(a * (b + c), a * b + a * c);
    EXPECT_EQ(Rational(2, 3) * a / Rational(2, 3), a);
    EXPECT_EQ(constant(symbols, Rational(3)) * a, Rational(3) * a);
    EXPECT_TRUE((Rational(0) * a).is_zero());
  }
}

TEST(SeriesAlgebra, PoissonBracket) {
  const Symbols symbols = some_symbols();
  for (unsigned seed = 0; seed < seeds; ++seed) {
    Draw draw(200 + seed);
    const Exact f = drawn_series(symbols, draw), g = drawn_series(symbols, draw),
                h = drawn_series(symbols, draw);
    ASSERT_GE(bracket(f, g).size(), 10U);
    EXPECT_EQ(bracket(f, g), -bracket(g, f));
    EXPECT_TRUE(bracket(f, f).is_zero());
    EXPECT_EQ(bracket(f + h, g), bracket(f, g) + bracket(h, g));
    EXPECT_EQ(bracket(f * h, g), f * bracket(h, g) + bracket(f, g) * h);
  }
  for (unsigned seed = 0; seed < 3; ++seed) {
    Draw draw(300 + seed);
    const Exact f = drawn_series(symbols, draw, 3), g = drawn_series(symbols, draw, 3),
                h = drawn_series(symbols, draw, 3);
    const Exact first = bracket(f, bracket(g, h));
    ASSERT_GE(first.size(), 50U);
    EXPECT_TRUE((first + bracket(g, bracket(h, f)) + bracket(h, bracket(f, g))).is_zero());
  }
}

TEST(SeriesAlgebra, BracketsOfThePairsThemselves) {
  const Symbols symbols = some_symbols();
  const auto variable = [&](const char* name) {
    return monomial(symbols, Rational(1), {{name, 1}});
  };
  EXPECT_EQ(bracket(variable("q"), variable("p")), constant(symbols, Rational(1)));
  // d sin(2l) / dt = 2 cos(2l) dH/dL.
  const Exact wave = sine(symbols, Rational(1), {}, {{"l", 2}});
  EXPECT_EQ(bracket(wave, variable("L")), cosine(symbols, Rational(2), {}, {{"l", 2}}));
  EXPECT_TRUE(bracket(variable("e"), wave).is_zero());
  EXPECT_TRUE(bracket(variable("L"), variable("G")).is_zero());
}

TEST(SeriesAlgebra, DerivativesCommuteAndFollowLeibniz) {
  const Symbols symbols = some_symbols();
  Draw draw(400);
  const Exact a = drawn_series(symbols, draw), b = drawn_series(symbols, draw);
  for (const char* const x : {"L", "e", "l", "x"}) {
    EXPECT_EQ(derivative(a * b, x), derivative(a, x) * b + a * derivative(b, x));
    for (const char* const y : {"G", "g", "x"})
      EXPECT_EQ(derivative(derivative(a, x), y), derivative(derivative(a, y), x));
  }
  EXPECT_TRUE(derivative(constant(symbols, Rational(2)), "L").is_zero());
}

TEST(SeriesAlgebra, OneFormOfEveryTerm) {
  const Symbols symbols = some_symbols();
  const Rational one(1);
  EXPECT_EQ(sine(symbols, one, {}, {{"g", -1}, {"x", 2}}),
            sine(symbols, -one, {}, {{"g", 1}, {"x", -2}}));
  EXPECT_EQ(cosine(symbols, one, {}, {{"l", -1}}), cosine(symbols, one, {}, {{"l", 1}}));
  EXPECT_TRUE(sine(symbols, one, {{"e", 2}}, {}).is_zero());
  EXPECT_EQ(cosine(symbols, one, {{"e", 2}}, {}), monomial(symbols, one, {{"e", 2}}));
  // Equal symbols made apart.
  EXPECT_EQ(constant(symbols, one), constant(some_symbols(), one));
  EXPECT_EQ(constant(symbols, one) + constant(some_symbols(), one), constant(symbols, Rational(2)));
}

}  // namespace
}  // namespace series_test
