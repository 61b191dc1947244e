// SPDX-License-Identifier: MIT
// Laws of the algebra, exact in rationals on series drawn at random.
#include <gmock/gmock.h>

#include "polhode/series/product.hpp"
#include "unit/series/support.hpp"

namespace series_test {
namespace {

constexpr unsigned seeds = 8;

TEST(SeriesAlgebra, IsACommutativeRing) {
  const series::Symbols symbols = some_symbols();
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
    EXPECT_EQ(series::Rational(2, 3) * a / series::Rational(2, 3), a);
    EXPECT_EQ(series::constant(symbols, series::Rational(3)) * a, series::Rational(3) * a);
    EXPECT_TRUE((series::Rational(0) * a).is_zero());
  }
}

TEST(SeriesAlgebra, PoissonBracket) {
  const series::Symbols symbols = some_symbols();
  for (unsigned seed = 0; seed < seeds; ++seed) {
    Draw draw(200 + seed);
    const Exact f = drawn_series(symbols, draw), g = drawn_series(symbols, draw),
                h = drawn_series(symbols, draw);
    ASSERT_GE(series::bracket(f, g).size(), 10U);
    EXPECT_EQ(series::bracket(f, g), -series::bracket(g, f));
    EXPECT_TRUE(series::bracket(f, f).is_zero());
    EXPECT_EQ(series::bracket(f + h, g), series::bracket(f, g) + series::bracket(h, g));
    EXPECT_EQ(series::bracket(f * h, g), f * series::bracket(h, g) + series::bracket(f, g) * h);
  }
  for (unsigned seed = 0; seed < 3; ++seed) {
    Draw draw(300 + seed);
    const Exact f = drawn_series(symbols, draw, 3), g = drawn_series(symbols, draw, 3),
                h = drawn_series(symbols, draw, 3);
    const Exact first = bracket(f, series::bracket(g, h));
    ASSERT_GE(first.size(), 50U);
    EXPECT_TRUE((first + series::bracket(g, series::bracket(h, f)) +
                 series::bracket(h, series::bracket(f, g)))
                    .is_zero());
  }
}

TEST(SeriesAlgebra, BracketsOfThePairsThemselves) {
  const series::Symbols symbols = some_symbols();
  const auto variable = [&](const char* name) {
    return series::monomial(symbols, series::Rational(1), {{name, 1}});
  };
  EXPECT_EQ(series::bracket(variable("q"), variable("p")),
            series::constant(symbols, series::Rational(1)));
  // d sin(2l) / dt = 2 cos(2l) dH/dL.
  const Exact wave = series::sine(symbols, series::Rational(1), {}, {{"l", 2}});
  EXPECT_EQ(series::bracket(wave, variable("L")),
            cosine(symbols, series::Rational(2), {}, {{"l", 2}}));
  EXPECT_TRUE(series::bracket(variable("e"), wave).is_zero());
  EXPECT_TRUE(series::bracket(variable("L"), variable("G")).is_zero());
}

TEST(SeriesAlgebra, DerivativesCommuteAndFollowLeibniz) {
  const series::Symbols symbols = some_symbols();
  Draw draw(400);
  const Exact a = drawn_series(symbols, draw), b = drawn_series(symbols, draw);
  for (const char* const x : {"L", "e", "l", "x"}) {
    EXPECT_EQ(series::derivative(a * b, x),
              series::derivative(a, x) * b + a * series::derivative(b, x));
    for (const char* const y : {"G", "g", "x"})
      EXPECT_EQ(series::derivative(series::derivative(a, x), y),
                series::derivative(series::derivative(a, y), x));
  }
  EXPECT_TRUE(series::derivative(series::constant(symbols, series::Rational(2)), "L").is_zero());
}

TEST(SeriesAlgebra, OneFormOfEveryTerm) {
  const series::Symbols symbols = some_symbols();
  const series::Rational one(1);
  EXPECT_EQ(series::sine(symbols, one, {}, {{"g", -1}, {"x", 2}}),
            series::sine(symbols, -one, {}, {{"g", 1}, {"x", -2}}));
  EXPECT_EQ(series::cosine(symbols, one, {}, {{"l", -1}}), cosine(symbols, one, {}, {{"l", 1}}));
  EXPECT_TRUE(series::sine(symbols, one, {{"e", 2}}, {}).is_zero());
  EXPECT_EQ(series::cosine(symbols, one, {{"e", 2}}, {}),
            series::monomial(symbols, one, {{"e", 2}}));
  // Equal symbols made apart.
  EXPECT_EQ(series::constant(symbols, one), series::constant(some_symbols(), one));
  EXPECT_EQ(series::constant(symbols, one) + series::constant(some_symbols(), one),
            series::constant(symbols, series::Rational(2)));
}

// Values of what is made of series against the same made of their values: exact.

TEST(SeriesValues, SumsAndProducts) {
  const series::Symbols symbols = some_symbols();
  for (unsigned seed = 0; seed < seeds; ++seed) {
    Draw draw(500 + seed);
    const Exact a = drawn_series(symbols, draw, 12), b = drawn_series(symbols, draw, 12);
    const Point<series::Rational> at = drawn_point(symbols, draw);
    EXPECT_EQ(value(a + b, at), value(a, at) + value(b, at));
    EXPECT_EQ(value(a - b, at), value(a, at) - value(b, at));
    EXPECT_EQ(value(a * b, at), value(a, at) * value(b, at));
    EXPECT_EQ(value(series::power(a, 3), at), to_power(value(a, at), 3));
  }
  // No term is left of what is too small for a double.
  const polhode::series::Series<double> tiny = series::monomial(symbols, 1e-300, {{"e", 1}});
  EXPECT_TRUE((tiny / 1e300).is_zero());
  EXPECT_TRUE((1e-300 * tiny).is_zero());
}

// x + d x, to first order in d x.
struct Jet {
  series::Rational x, dx;
  explicit Jet(int n) : x(n) {}
  Jet(Rational at, Rational rate) : x(std::move(at)), dx(std::move(rate)) {}
  friend Jet operator+(const Jet& a, const Jet& b) { return {a.x + b.x, a.dx + b.dx}; }
  friend Jet operator-(const Jet& a, const Jet& b) { return {a.x - b.x, a.dx - b.dx}; }
  friend Jet operator*(const Jet& a, const Jet& b) { return {a.x * b.x, a.x * b.dx + a.dx * b.x}; }
  friend Jet operator/(const Jet& a, const Jet& b) {
    return {a.x / b.x, (a.dx * b.x - a.x * b.dx) / (b.x * b.x)};
  }
};

TEST(SeriesValues, Derivatives) {
  const series::Symbols symbols = some_symbols();
  Draw draw(600);
  const Exact a = drawn_series(symbols, draw, 20);
  const Point<series::Rational> at = drawn_point(symbols, draw);
  const auto moved = [&](std::size_t variable, std::size_t angle) {
    Point<Jet> jets;
    for (std::size_t i = 0; i < at.variables.size(); ++i)
      jets.variables.emplace_back(at.variables[i], Rational(i == variable ? 1 : 0));
    for (std::size_t i = 0; i < at.cosines.size(); ++i) {
      const series::Rational rate(i == angle ? 1 : 0);
      jets.cosines.emplace_back(at.cosines[i], -rate * at.sines[i]);
      jets.sines.emplace_back(at.sines[i], rate * at.cosines[i]);
    }
    return value(a, jets, [](const series::Rational& c) { return Jet(c, Rational(0)); }).dx;
  };
  const std::size_t none = 99;
  for (std::size_t i = 0; i < at.variables.size(); ++i)
    EXPECT_EQ(value(series::derivative(a, symbols.variables()[i]), at), moved(i, none));
  for (std::size_t i = 0; i < at.cosines.size(); ++i)
    EXPECT_EQ(value(series::derivative(a, symbols.angles()[i]), at), moved(none, i));
}

TEST(SeriesValues, AVariableReplaced) {
  const series::Symbols symbols = some_symbols();
  for (unsigned seed = 0; seed < seeds; ++seed) {
    Draw draw(700 + seed);
    const Exact a = drawn_series(symbols, draw, 6, 0), s = drawn_series(symbols, draw, 3);
    Point<series::Rational> at = drawn_point(symbols, draw);
    const series::Rational replaced = value(substituted(a, "G", s), at);
    at.variables[1] = value(s, at);
    EXPECT_EQ(replaced, value(a, at));
  }
  Draw draw(750);
  const Exact a = drawn_series(symbols, draw, 8, -2);
  const Exact s = series::monomial(symbols, series::Rational(-3, 2), {{"L", 2}, {"e", -1}});
  Point<Rational> at = drawn_point(symbols, draw);
  const series::Rational replaced = value(substituted(a, "G", s), at);
  at.variables[1] = value(s, at);
  EXPECT_EQ(replaced, value(a, at));
}

TEST(SeriesValues, AnglesReplacedAtOnce) {
  const series::Symbols symbols = some_symbols();
  Draw draw(800);
  const Exact a = drawn_series(symbols, draw, 10);
  const Point<series::Rational> at = drawn_point(symbols, draw);
  // l -> g - 2 x, g -> l.
  const auto wave = [&](series::Trigonometric function, const polhode::series::Multiples& angle) {
    return value(function == series::Trigonometric::sine
                     ? series::sine(symbols, Rational(1), {}, angle)
                     : series::cosine(symbols, Rational(1), {}, angle),
                 at);
  };
  const polhode::series::Multiples sum{{"g", 1}, {"x", -2}};
  Point<Rational> turned = at;
  turned.cosines[0] = wave(series::Trigonometric::cosine, sum);
  turned.sines[0] = wave(series::Trigonometric::sine, sum);
  turned.cosines[1] = at.cosines[0];
  turned.sines[1] = at.sines[0];
  EXPECT_EQ(value(series::angles_replaced(a, {{"l", sum}, {"g", {{"l", 1}}}}), at),
            value(a, turned));
  // Andoyer's and back.
  const Exact there = angles_replaced(a, {{"l", {{"l", 1}, {"g", 1}}}});
  EXPECT_EQ(series::angles_replaced(there, {{"l", {{"l", 1}, {"g", -1}}}}), a);
}

TEST(SeriesValues, ADisplacedVariableIsASubstitution) {
  const series::Symbols symbols = some_symbols();
  Draw draw(900);
  const Exact a = drawn_series(symbols, draw, 8, 0), d = drawn_series(symbols, draw, 3);
  const Exact moved = series::monomial(symbols, series::Rational(1), {{"G", 1}}) + d;
  EXPECT_EQ(series::displaced(a, "G", d), series::substituted(a, "G", moved));
}

// cos(l + d) = cos l cos d - sin l sin d, whose series in d are known.
TEST(SeriesValues, ADisplacedAngleIsTaylorsSeries) {
  const series::Symbols symbols = some_symbols();
  const series::Truncation keep{{{"e", 1}}, 5};
  const series::Rational one(1);
  const Exact d = series::sine(symbols, series::Rational(2), {{"e", 1}}, {{"g", 1}});
  const auto order = [&](int n, Rational c) { return c * power(d, n, keep); };
  const Exact cos_d = order(0, one) + order(2, Rational(-1, 2)) + order(4, Rational(1, 24));
  const Exact sin_d = order(1, one) + order(3, Rational(-1, 6)) + order(5, Rational(1, 120));
  const Exact c = series::cosine(symbols, one, {{"L", 3}}, {{"l", 1}});
  const Exact s = sine(symbols, one, {{"L", 3}}, {{"l", 1}});
  EXPECT_EQ(series::displaced(c, "l", d, keep),
            series::product(c, cos_d, keep) - series::product(s, sin_d, keep));
}

TEST(SeriesValues, TruncationIsTheProductWithoutHigherOrders) {
  const series::Symbols symbols = some_symbols();
  for (unsigned seed = 0; seed < seeds; ++seed) {
    Draw draw(1000 + seed);
    const Exact a = drawn_series(symbols, draw, 15, 0), b = drawn_series(symbols, draw, 15, 0);
    const series::Truncation keep{{{"e", 1}, {"G", 2}}, 4};
    const Exact whole = a * b, cut = product(a, b, keep);
    EXPECT_EQ(cut, series::truncated(whole, keep));
    EXPECT_LT(cut.size(), whole.size());
    EXPECT_GT(cut.size(), 0U);
    EXPECT_EQ(series::bracket(a, b, keep), series::truncated(series::bracket(a, b), keep));
    Exact parts(symbols);
    for (int order = 0; order <= 4; ++order) parts += part_of_order(whole, keep, order);
    EXPECT_EQ(parts, cut);
  }
}

TEST(SeriesValues, SizesAreUpperBounds) {
  const series::Symbols symbols = some_symbols();
  Draw draw(1100);
  const Exact a = drawn_series(symbols, draw, 40, 0), b = drawn_series(symbols, draw, 30, 0);
  const auto of_all = product_size(a, b);
  EXPECT_EQ(of_all.pairs, static_cast<double>(a.size() * b.size()));
  EXPECT_GE(of_all.terms, static_cast<double>((a * b).size()));
  const series::Truncation keep{{{"e", 1}}, 2};
  const auto of_some = product_size(a, b, keep);
  EXPECT_LT(of_some.pairs, of_all.pairs);
  EXPECT_GE(of_some.terms, static_cast<double>(series::product(a, b, keep).size()));
  // Few keys can come out: e^0 to e^60, times 1 and two cosines and sines.
  Exact dense = constant(symbols, series::Rational(1));
  const Exact one =
      series::monomial(symbols, Rational(1), {{"e", 1}}) + constant(symbols, Rational(1));
  dense = power(one, 30) * (series::sine(symbols, Rational(1), {}, {{"l", 1}}) +
                            series::cosine(symbols, Rational(1), {}, {{"l", 1}}));
  EXPECT_EQ(series::product_size(dense, dense).terms, 61.0 * 5.0);
}

// More than 64 bits of exponents and multipliers.
TEST(SeriesValues, ProductsInManySymbols) {
  std::vector<std::string> variables, angles;
  for (char c = 'a'; c <= 'l'; ++c) {
    variables.emplace_back(1, c);
    angles.push_back("w_" + variables.back());
  }
  const series::Symbols symbols(variables, angles, {{"w_a", "a"}, {"b", "c"}, {"w_l", "l"}});
  for (unsigned seed = 0; seed < seeds; ++seed) {
    Draw draw(1150 + seed);
    const Exact a = drawn_series(symbols, draw, 20, -2), b = drawn_series(symbols, draw, 20, -2);
    const Point<series::Rational> at = drawn_point(symbols, draw);
    EXPECT_EQ(value(a * b, at), value(a, at) * value(b, at));
    EXPECT_EQ(a * b, b * a);
    EXPECT_EQ(series::bracket(a, b), -series::bracket(b, a));
  }
}

// Coefficients of few bits: exact in doubles too.
TEST(SeriesValues, ProductsOfManyTermsInDoublesAndRationals) {
  const series::Symbols symbols = some_symbols();
  Draw draw(1180);
  const auto whole = [&] { return series::Rational(draw.integer(-99, 99)); };
  const Exact a = drawn(symbols, draw, 80, -4, 5, 6, whole);
  const Exact b = drawn(symbols, draw, 90, -2, 9, 3, whole);
  const Exact ab = a * b;
  EXPECT_GT(ab.size(), 10000U);
  EXPECT_EQ(series::to_doubles(a) * series::to_doubles(b), series::to_doubles(ab));
  const series::Truncation keep{{{"L", 3}, {"e", 1}, {"q", 2}}, 11};
  EXPECT_EQ(series::product(series::to_doubles(a), series::to_doubles(b), keep),
            series::to_doubles(series::truncated(ab, keep)));
}

}  // namespace
}  // namespace series_test
