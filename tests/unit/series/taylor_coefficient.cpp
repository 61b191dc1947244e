// SPDX-License-Identifier: MIT
// Coefficients that are functions of the momenta, exact in rationals: quotients and derivatives
// beside closed forms, the laws of brackets, divisors that are sums of different functions.
#include "polhode/series/taylor_coefficient.hpp"

#include <gmock/gmock.h>

#include <algorithm>

#include "message_of.hpp"
#include "polhode/series/linear_flow.hpp"
#include "polhode/series/product.hpp"
#include "unit/series/support.hpp"
#include "worst.hpp"

namespace series_test {
namespace {

using polhode::series::AngleRate;
using polhode::test::smaller;

using Taylor = polhode::series::TaylorCoefficient<series::Rational, 2, 5>;
using Local = series::Series<Taylor>;

series::Symbols rotor() { return Symbols({"L", "G", "k"}, {"l", "g"}, {{"l", "L"}, {"g", "G"}}); }
Taylor L() { return Taylor::variable(0, Rational(2, 3)); }
Taylor G() { return Taylor::variable(1, Rational(5, 4)); }
Taylor number(int n, int d = 1) { return Taylor(Rational(n, d)); }

// Of 1, L, G, their product, a quotient and its powers.
Taylor drawn_function(Draw& draw) {
  const Taylor w = number(3) + L() - G() / number(7);
  return Taylor(draw.rational()) + Taylor(draw.rational()) * L() * G() +
         Taylor(draw.rational()) / w + Taylor(draw.rational()) * L() / (w * w);
}
Local drawn_local(Draw& draw, int terms = 4) {
  return drawn<Taylor>(rotor(), draw, terms, 0, 0, 2, [&] { return drawn_function(draw); });
}

// The degree to which all of a series is known.
int known(const Local& a) {
  int least = 5;
  for (const auto& term : a.terms()) least = smaller<int>(least, term.c.known());
  return least;
}
void expect_equal(const Local& a, const Local& b, int least_known) {
  const int degree = smaller<int>(known(a), known(b));
  EXPECT_GE(degree, least_known);
  EXPECT_EQ(series::expanded(a, degree), series::expanded(b, degree));
}

TEST(TaylorCoefficient, QuotientsAndDerivativesAreThoseOfTheFunctions) {
  const Taylor w = L() + number(2) * G();
  EXPECT_EQ(w * (number(1) / w), number(1));
  EXPECT_EQ((w * w).derivative(1), number(4) * w);
  // 1 / w to degree 4, since a derivative is known to one degree less.
  const Taylor slope = (number(1) / w).derivative(1);
  EXPECT_EQ(slope.known(), 4);
  EXPECT_EQ(slope - number(-2) / (w * w), Taylor(0));
  // (1 + x)^(-1) = 1 - x + x^2 - ..., the value is that of the polynomial.
  const Taylor inverse = number(1) / Taylor::variable(0, Rational(1));
  EXPECT_EQ(inverse.value({series::Rational(1, 2), series::Rational(9)}), series::Rational(21, 32));
  const auto one = polhode::series::TaylorCoefficient<double, 1, 4>::variable(0, 1.0);
  EXPECT_EQ(sqrt(one) * sqrt(one), one);
  EXPECT_EQ(sqrt(one).at(4), -5.0 / 128.0);
}

// Polynomials lose nothing; a quotient does.
TEST(TaylorCoefficient, SaysWhatIsKnown) {
  Taylor polynomial = L() * L() * G();
  for (int n = 0; n < 3; ++n) polynomial = polynomial.derivative(n == 0 ? 1 : 0);
  EXPECT_EQ(polynomial, number(2));
  EXPECT_EQ(polynomial.known(), 5);
  EXPECT_EQ((L() * L() * L() * G() * G() * G()).derivative(0).known(), 4);
  Taylor quotient = number(1) / L();
  for (int n = 0; n < 5; ++n) quotient = quotient.derivative(0);
  EXPECT_EQ(quotient.known(), 0);
  EXPECT_REJECTED(quotient.derivative(0), "nothing is known");
  EXPECT_REJECTED(L().derivative(2), "no variable at place 2");
  EXPECT_REJECTED(number(1) / (L() - number(2, 3)), "a function that is 0");
  const auto below = polhode::series::TaylorCoefficient<double, 1, 2>::variable(0, -1.0);
  EXPECT_REJECTED(sqrt(below), "not positive");
}

TEST(TaylorCoefficient, BracketsKeepTheirLaws) {
  for (unsigned seed = 0; seed < 4; ++seed) {
    Draw draw(1400 + seed);
    const Local f = drawn_local(draw), g = drawn_local(draw), h = drawn_local(draw);
    ASSERT_GE(series::bracket(f, g).size(), 5U);
    expect_equal(series::bracket(f, g), -bracket(g, f), 4);
    expect_equal(bracket(f * g, h), f * bracket(g, h) + bracket(f, h) * g, 4);
    expect_equal(bracket(f, bracket(g, h)), bracket(bracket(f, g), h) + bracket(g, bracket(f, h)),
                 3);
  }
}

// Rates of different form, whose sums are no single term without a Taylor polynomial.
TEST(TaylorCoefficient, IntegralsAreUndoneByTheFlow) {
  const series::Symbols symbols = rotor();
  const std::vector<AngleRate<Taylor>> rates{
      {"l", constant(symbols, number(1) / (L() + number(4)))}, {"g", constant(symbols, G() * G())}};
  Draw draw(1500);
  const Local all = drawn_local(draw, 12), f = all - mean(all, {"l", "g"});
  ASSERT_GE(f.size(), 8U);
  const Local s = integral(f, rates, 0.0);
  Local flow(symbols);
  for (const auto& [angle, rate] : rates) flow += rate * series::derivative(s, angle);
  expect_equal(flow, f, 5);
  // l - g stands still where L = G^2, and not beside it.
  const std::vector<AngleRate<Taylor>> near{
      {"l", constant(symbols, L())}, {"g", constant(symbols, G() * G() - number(25, 16) + L())}};
  EXPECT_REJECTED(
      series::integral(series::cosine(symbols, number(1), {}, {{"l", 1}, {"g", -1}}), near, 0.0),
      "turns with l - g, whose rate is 0 at the values chosen");
}

// The coefficient of k L cos(l) depends on L too.
TEST(TaylorCoefficient, ItsVariablesAreDisplacedNotReplaced) {
  const series::Symbols symbols = rotor();
  const Local a = cosine(symbols, L() * G(), {{"k", 2}}, {{"l", 1}});
  EXPECT_REJECTED(series::substituted(a, "L", series::constant(symbols, number(2))),
                  "L is a variable of the coefficients too");
  EXPECT_EQ(series::substituted(a, "k", series::constant(symbols, number(2))),
            series::cosine(symbols, number(4) * L() * G(), {}, {{"l", 1}}));
}

TEST(TaylorCoefficient, ExpandedIsASeriesInDisplacements) {
  const series::Symbols symbols = rotor();
  const Local a = cosine(symbols, L() * G(), {{"k", 2}}, {{"l", 1}});
  const Exact wanted = series::cosine(symbols, series::Rational(5, 6), {{"k", 2}}, {{"l", 1}}) +
                       cosine(symbols, Rational(5, 4), {{"k", 2}, {"L", 1}}, {{"l", 1}}) +
                       cosine(symbols, Rational(2, 3), {{"k", 2}, {"G", 1}}, {{"l", 1}});
  EXPECT_EQ(series::expanded(a, 1), wanted);
  EXPECT_EQ(series::expanded(a),
            wanted + series::cosine(symbols, series::Rational(1), {{"k", 2}, {"L", 1}, {"G", 1}},
                                    {{"l", 1}}));
}

series::Symbols at_values() {
  return Symbols({"L", "G", "k"}, {"l", "g"}, {{"l", "L"}, {"g", "G"}}, {{"G", 1.25}, {"L", 0.75}});
}

// Powers of L and G in text are functions of them; only two of three variables are used.
TEST(TaylorCoefficient, ValuesOfSymbolsMakeFunctionsOfText) {
  using Three = polhode::series::TaylorCoefficient<series::Rational, 3, 5>;
  const series::Symbols symbols = at_values();
  const Three l = Three::variable(0, Rational(3, 4)), g = Three::variable(1, Rational(5, 4));
  const auto read = [&](const char* text) {
    return series::series_from_text<Three>(symbols, text);
  };
  EXPECT_EQ(
      read("k*(G + L)^2*cos(l)/(1 - G*L)"),
      series::cosine(symbols, (g + l) * (g + l) / (Three(1) - g * l), {{"k", 1}}, {{"l", 1}}));
  EXPECT_EQ(series::derivative(read("k^2*L"), "k"), read("2*k*L"));
  EXPECT_EQ(series::expanded(series::derivative(read("k^2/L"), "L")),
            series::expanded(read("-k^2/L^2"), 4));
  EXPECT_EQ(series::text(read("G^2*k*sin(g)")),
            "25/16*k*sin(g) + 5/2*(G - 1.25)*k*sin(g) + (G - 1.25)^2*k*sin(g)");
  const auto f = series::derivative(read("k/(G - L) + L^2*sin(g)"), "L");
  EXPECT_EQ(series::series_from_text<Three>(symbols, series::text(f)), f);
  const auto same = polhode::series::series_from_csv<Three>(symbols, series::csv(f));
  EXPECT_EQ(same, f);
  EXPECT_EQ(series::csv(same), series::csv(f));
  EXPECT_EQ(polhode::series::collected<Three>(series::expanded(f)), f);
  EXPECT_REJECTED(read("sqrt(G)"), "column 1: 'sqrt'; expected");
  EXPECT_REJECTED(read("1/(3*G - 5*L)"), "a divisor that is not 0 at L = 0.75, G = 1.25 before it");
  using One = polhode::series::TaylorCoefficient<double, 1, 5>;
  EXPECT_REJECTED(series::series_from_text<One>(symbols, "G"),
                  "2 variables have values, L = 0.75, G = 1.25; coefficients of this type take 1");
  EXPECT_REJECTED(series::series_from_text<double>(symbols, "G"),
                  "coefficients of this type take 0");
  EXPECT_REJECTED(read("G") + series::series_from_text<Three>(rotor(), "k"), "without values");
}

}  // namespace
}  // namespace series_test
