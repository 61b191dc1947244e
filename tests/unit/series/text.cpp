// SPDX-License-Identifier: MIT
// Series written and read back, expressions, and LaTeX.
#include <gmock/gmock.h>

#include "message_of.hpp"
#include "polhode/series/series_text.hpp"
#include "unit/series/support.hpp"

namespace series_test {
namespace {

using namespace polhode;
using polhode::test::message_of;
using testing::HasSubstr;

series::Symbols few() { return series::Symbols({"e", "G"}, {"l", "g"}, {{"g", "G"}}); }
Exact read(const char* text) { return series::series_from_text<series::Rational>(few(), text); }

TEST(SeriesText, WhatIsWrittenIsReadBack) {
  const series::Symbols symbols = some_symbols();
  for (unsigned seed = 0; seed < 10; ++seed) {
    Draw draw(1700 + seed);
    const Exact a = drawn_series(symbols, draw, 25);
    EXPECT_EQ(series::series_from_text<series::Rational>(symbols, series::text(a)), a);
    EXPECT_EQ(series::series_from_csv<series::Rational>(symbols, series::csv(a)), a);
    const series::Series<double> b = drawn<double>(symbols, draw, 25, -2, 3, 3, [&] {
      return draw.integer(-999, 999) / 7.0 * to_power(10.0, draw.integer(-30, 30));
    });
    EXPECT_EQ(series::series_from_text<double>(symbols, series::text(b)), b);
    EXPECT_EQ(series::series_from_csv<double>(symbols, series::csv(b)), b);
  }
  const Exact zero(symbols);
  EXPECT_EQ(series::text(zero), "0");
  EXPECT_EQ(series::series_from_text<series::Rational>(symbols, "0"), zero);
  EXPECT_EQ(series::series_from_csv<series::Rational>(symbols, series::csv(zero)), zero);
}

TEST(SeriesText, LooksLikeAFormula) {
  const Exact a = read("-3/2 + e - 1/4*e^2*G^-1*cos(2*l - g) + sin(g)");
  EXPECT_EQ(series::text(a), "-3/2 + sin(g) + e - 1/4*e^2*G^-1*cos(2*l - g)");
  EXPECT_EQ(series::csv(read("2/3*e*sin(l - 2*g)")),
            "coefficient,function,e^,G^,l,g\n2/3,sin,1,0,1,-2\n");
}

TEST(SeriesText, ExpressionsAreTheirAlgebra) {
  const series::Symbols symbols = few();
  const series::Rational one(1);
  const Exact e = series::monomial(symbols, one, {{"e", 1}}),
              c = series::cosine(symbols, one, {}, {{"l", 1}});
  const Exact number = series::constant(symbols, one);
  EXPECT_EQ(read("(1 + e*cos(l))^3"), series::power(number + e * c, 3));
  EXPECT_EQ(read("-(1 - e)*(1 + e)/2/G"), series::Rational(-1, 2) * (number - e * e) *
                                              series::monomial(symbols, one, {{"G", -1}}));
  EXPECT_EQ(read("cos(l)^2 + sin(l)^2"), number);
  EXPECT_EQ(read("2*sin(l)*cos(l)"), read("sin(2*l)"));
  EXPECT_EQ(read("cos(-l + 2*g)"), read("cos(l - 2*g)"));
  EXPECT_EQ(read(" 1.5e1 *\n e ^ -2 "),
            series::monomial(symbols, series::Rational(15), {{"e", -2}}));
  EXPECT_EQ(read("(2*e)^-2"), read("1/4/e^2"));
  EXPECT_EQ(read("(e + G)^0"), number);
  EXPECT_EQ(read("1e1*e"), read("10*e"));
}

TEST(SeriesText, Latex) {
  const series::Symbols symbols({"e", "G'", "Om"}, {"phi_l", "l'"});
  const auto of = [&](const char* text) {
    return series::latex(series::series_from_text<series::Rational>(symbols, text));
  };
  EXPECT_EQ(of("-3/4*e^2*cos(2*phi_l - l')"), "-\\frac{3}{4} e^{2} \\cos(2 \\phi_{l} - l')");
  EXPECT_EQ(of("G'^-1*Om^3*sin(phi_l + l')"), "{G'}^{-1} \\mathrm{Om}^{3} \\sin(\\phi_{l} + l')");
  EXPECT_EQ(of("2 - e"), "2 - e");
  EXPECT_EQ(of("0"), "0");
  EXPECT_EQ(series::latex(series::constant(symbols, -2.5e-7)), "-2.5 \\cdot 10^{-7}");
  EXPECT_EQ(series::latex(series::constant(symbols, 1e30)), "1 \\cdot 10^{30}");
}

TEST(SeriesText, Refuses) {
  const auto refused = [](const char* text) { return message_of([&] { return read(text); }); };
  EXPECT_EQ(refused("1 + x"),
            "series: column 5: 'x'; expected a number, cos, sin, a parenthesis or a variable of: "
            "variables e, G; angles l, g");
  EXPECT_THAT(refused("e*cos(l - h)"), HasSubstr("column 11: 'h'; expected an angle of"));
  EXPECT_THAT(refused("2*l"), HasSubstr("an angle stands in cos(...) or sin(...) alone"));
  EXPECT_THAT(refused("(1 + e"), HasSubstr("the end; expected ')'"));
  EXPECT_THAT(refused("1 e"), HasSubstr("'e'; expected an operator, or the end"));
  EXPECT_THAT(refused(""), HasSubstr("column 1: the end"));
  EXPECT_THAT(refused("e^1.5"), HasSubstr("'1.5'; expected an integer"));
  EXPECT_THAT(refused("1/(1 + e)"), HasSubstr("a divisor of one term"));
  EXPECT_THAT(refused("1/0"), HasSubstr("a divisor of one term"));
  EXPECT_THAT(refused("cos(2*l"), HasSubstr("expected ')'"));
  EXPECT_THAT(refused("cos l"), HasSubstr("expected '('"));
  EXPECT_THAT(refused("cos(g/2)"), HasSubstr("column 6: '/'; expected whole multiples of angles"));
  EXPECT_THAT(refused("cos(g*2)"), HasSubstr("column 6: '*'; expected the number before"));
  EXPECT_THAT(refused("cos(0.5*g)"), HasSubstr("'0.5'; expected an integer: angles stand with"));
  EXPECT_THAT(refused("G**2"), HasSubstr("column 3: '*'; expected a factor: a power is written"));
  EXPECT_THAT(refused("e^99999"), HasSubstr("exponent"));
  EXPECT_THAT(refused("(e + G)^1001"), HasSubstr("powers of sums and waves up to 1000"));
  EXPECT_THAT(refused("cos(l)^1001"), HasSubstr("powers of sums and waves up to 1000"));
  EXPECT_THAT(refused("cos(l)^900*cos(l)^900"), HasSubstr("fewer products"));
  EXPECT_THAT(refused((std::string(101, '(') + "1").c_str()), HasSubstr("no deeper than 100"));
  EXPECT_THAT(refused("1 + \t\x01"), HasSubstr("column 6: '?'"));
  const auto of_doubles = [](const char* text) {
    return message_of([&] { return series::series_from_text<double>(few(), text); });
  };
  EXPECT_THAT(of_doubles("(e + G + cos(l) + sin(g))^1000"), HasSubstr("fewer products"));
  EXPECT_THAT(of_doubles("1e999"), HasSubstr("'1e999' is no finite number of type double"));
}

TEST(SeriesText, RefusesTables) {
  const auto refused = [](const std::string& table) {
    return message_of([&] { return series::series_from_csv<series::Rational>(few(), table); });
  };
  const std::string header = "coefficient,function,e^,G^,l,g\n";
  EXPECT_EQ(refused(header + "1,cos,0,0,1,0\r\n\n"), "");
  EXPECT_THAT(refused("coefficient,function,e^,l,g\n"), HasSubstr("line 1: "));
  EXPECT_THAT(refused(""), HasSubstr("is not the header coefficient,function,e^,G^,l,g"));
  EXPECT_THAT(refused(header + "1,cos,0,0,1\n"), HasSubstr("line 2: "));
  EXPECT_THAT(refused(header + "1,cos,0,0,1,0\n1,tan,0,0,1,0\n"),
              HasSubstr("line 3: 'tan' is neither cos nor sin"));
  EXPECT_THAT(refused(header + "1,cos,0,0.5,1,0\n"), HasSubstr("'0.5' is no exponent"));
  EXPECT_THAT(refused(header + "one,cos,0,0,1,0\n"), HasSubstr("'one' is no number"));
  EXPECT_THAT(refused(header + "1,cos,0,0,99999,0\n"), HasSubstr("the multiplier 99999 of l"));
}

}  // namespace
}  // namespace series_test
