// SPDX-License-Identifier: MIT
// Packed rows at the ends of their range, and what symbols and series refuse.
#include <gmock/gmock.h>

#include "message_of.hpp"
#include "polhode/series/product.hpp"
#include "polhode/series/symbols.hpp"
#include "unit/series/support.hpp"

namespace series_test {
namespace {

using namespace polhode;
using polhode::test::message_of;
using testing::HasSubstr;

using Row = std::vector<int>;

std::uint64_t word(const series::PackedFields& fields, const Row& row) {
  std::uint64_t packed = fields.zero();
  for (std::size_t i = 0; i < row.size(); ++i)
    packed = fields.with(packed, static_cast<int>(i), row[i]);
  return packed;
}
Row row(const series::PackedFields& fields, std::uint64_t packed) {
  Row all;
  for (int i = 0; i < fields.count(); ++i) all.push_back(fields.at(packed, i));
  return all;
}
bool fits(const series::PackedFields& fields, const Row& row) {
  for (const int n : row)
    if (n < fields.least() || n > fields.greatest()) return false;
  return true;
}

TEST(PackedFields, AddsRowsWithoutCarries) {
  for (int count = 0; count <= series::PackedFields::most; ++count) {
    const series::PackedFields fields(count);
    Draw draw(1800 + static_cast<unsigned>(count));
    for (int trial = 0; trial < 300; ++trial) {
      Row a, b, sum, difference, negative;
      for (int i = 0; i < count; ++i) {
        const auto drawn_end = [&] {
          const int ends[] = {fields.least(), fields.greatest(), 0,
                              draw.integer(fields.least(), fields.greatest())};
          return ends[draw.integer(0, 3)];
        };
        a.push_back(drawn_end());
        b.push_back(drawn_end());
        sum.push_back(a.back() + b.back());
        difference.push_back(a.back() - b.back());
        negative.push_back(-a.back());
      }
      const std::uint64_t of_a = word(fields, a), of_b = word(fields, b);
      ASSERT_EQ(row(fields, of_a), a);
      ASSERT_EQ(row(fields, fields.sum(of_a, of_b)), sum);
      ASSERT_EQ(row(fields, fields.difference(of_a, of_b)), difference);
      ASSERT_EQ(row(fields, fields.negative(of_a)), negative);
      ASSERT_TRUE(fields.fits(of_a));
      ASSERT_EQ(fields.fits(fields.sum(of_a, of_b)), fits(fields, sum));
      ASSERT_EQ(fields.fits(fields.difference(of_a, of_b)), fits(fields, difference));
      ASSERT_EQ(fields.fits(fields.negative(of_a)), fits(fields, negative));
      ASSERT_EQ(of_a < of_b, a < b);
      ASSERT_EQ(fields.is_negative(of_a), a < Row(a.size(), 0));
      ASSERT_EQ(of_a & series::TermKey::function_bit, 0U);
    }
  }
  EXPECT_EQ(series::PackedFields(3).greatest(), 16383);
  EXPECT_EQ(series::PackedFields(5).greatest(), 1023);
  EXPECT_EQ(series::PackedFields(9).greatest(), 31);
  EXPECT_EQ(series::PackedFields(12).least(), -8);
}

TEST(Symbols, Refuse) {
  using Names = std::vector<std::string>;
  const auto refused = [](Names variables, Names angles,
                          std::vector<series::ConjugatePair> pairs = {}) {
    return message_of([&] { return series::Symbols(variables, angles, pairs); });
  };
  EXPECT_EQ(refused({"a", "B_1", "c'"}, {"_l"}), "");
  EXPECT_THAT(refused({"1a"}, {}), HasSubstr("'1a' is no name"));
  EXPECT_THAT(refused({}, {"cos"}), HasSubstr("'cos' is no name"));
  EXPECT_THAT(refused({""}, {}), HasSubstr("'' is no name"));
  EXPECT_THAT(refused({"a", "b"}, {"a"}), HasSubstr("a is there twice"));
  EXPECT_THAT(refused(Names(13, "a"), {}), HasSubstr("13 variables, at most 12"));
  EXPECT_THAT(refused({"G"}, {"g"}, {{"G", "g"}}),
              HasSubstr("momentum 'g' of a pair is no variable"));
  EXPECT_THAT(refused({"G"}, {"g"}, {{"h", "G"}}), HasSubstr("coordinate 'h'"));
  EXPECT_THAT(refused({"G"}, {"g", "l"}, {{"g", "G"}, {"l", "G"}}), HasSubstr("G is in two pairs"));
  EXPECT_THAT(refused({"G"}, {}, {{"G", "G"}}), HasSubstr("G is in two pairs"));
  const series::Symbols symbols({"e"}, {"l"});
  EXPECT_REJECTED(symbols.variable("l"), "no variable 'l'; there are variables e; angles l");
  EXPECT_REJECTED(symbols.angle("e"), "no angle 'e'");
}

TEST(Series, RefusesWhatLeavesItsRange) {
  const series::Symbols symbols({"a", "b", "c", "d", "e"}, {"l", "g"});
  const series::Rational one(1);
  const Exact high = series::monomial(symbols, one, {{"d", 1000}});
  const Exact fast = series::cosine(symbols, one, {}, {{"l", 1}, {"g", -16000}});
  const Exact slow = series::cosine(symbols, one, {}, {{"l", 1}, {"g", 16000}});
  EXPECT_REJECTED(high * high, "the exponent 2000 of d is out of [-1024, 1023]");
  EXPECT_REJECTED(fast * fast, "the multiplier -32000 of g");
  EXPECT_REJECTED(fast * slow, "the multiplier 32000 of g");
  EXPECT_REJECTED(series::monomial(symbols, one, {{"a", 600}, {"a", 600}}),
                  "the exponent 1200 of a");
  EXPECT_REJECTED(series::power(series::monomial(symbols, one, {{"e", 2}}), -700),
                  "of e is out of");
  const Exact lowest = series::monomial(symbols, one, {{"b", -1024}});
  EXPECT_REJECTED(series::derivative(lowest, "b"), "exponent -1025 of b");
  EXPECT_REJECTED(series::inverse(lowest), "exponent 1024 of b");
  // -2^14 turned round is one too many.
  EXPECT_REJECTED(series::cosine(symbols, one, {}, {{"l", -16384}}), "multiplier 16384 of l");
  EXPECT_REJECTED(series::angles_replaced(fast, {{"l", {{"g", -16000}}}}),
                  "multiplier -32000 of g");
  EXPECT_REJECTED(series::angles_replaced(fast, {{"l", {{"g", 1 << 30}}}}), "out of range");
}

TEST(Series, RefusesOtherSymbolsAndUnknownOnes) {
  const series::Symbols symbols({"e"}, {"l"}), others({"e", "G"}, {"l"}, {{"l", "G"}});
  const series::Symbols unpaired({"e", "G"}, {"l"});
  const Exact a = series::constant(symbols, series::Rational(1)),
              b = series::constant(others, series::Rational(1)),
              c = series::constant(unpaired, series::Rational(1));
  for (const std::string& message :
       {message_of([&] { return a + b; }), message_of([&] { return a - b; }),
        message_of([&] { return a * b; }), message_of([&] { return series::bracket(a, b); }),
        message_of([&] { return series::bracket(b, c); }),
        message_of([&] { return series::product_size(a, b); }),
        message_of([&] { return series::substituted(a, "e", b); })})
    EXPECT_THAT(message, HasSubstr("two sets of symbols, variables e"));
  EXPECT_FALSE(a == b);
  EXPECT_REJECTED(series::derivative(a, "x"), "no variable 'x'");
  EXPECT_REJECTED(series::monomial(symbols, series::Rational(1), {{"l", 1}}), "no variable 'l'");
  EXPECT_REJECTED(series::substituted(a, "l", a), "no variable 'l'");
  EXPECT_REJECTED(series::angles_replaced(a, {{"e", {}}}), "no angle 'e'");
  EXPECT_REJECTED(series::angles_replaced(a, {{"l", {}}, {"l", {}}}), "l is there twice");
  EXPECT_REJECTED(series::product(a, a, {{{"l", 1}}, 3}), "no variable 'l'");
  EXPECT_REJECTED(series::product(a, a, {{{"e", -1}}, 3}), "weight -1 of e");
}

TEST(Series, RefusesWhatDoesNotEndOrFit) {
  const series::Symbols symbols({"e", "s"}, {"l", "g"});
  Draw draw(1900);
  const series::Rational one(1);
  const Exact wave = series::cosine(symbols, one, {{"e", 1}}, {{"l", 1}});
  EXPECT_REJECTED(series::displaced(wave, "l", series::constant(symbols, one)),
                  "has not ended after 200 orders");
  EXPECT_REJECTED(series::inverse(wave), "one term without an angle");
  EXPECT_REJECTED(series::power(wave + wave * wave, -1), "a series of 3 terms");
  const Exact a = drawn_series(symbols, draw, 30);
  const series::Truncation small{{}, 0, 10000};
  const std::string message = message_of([&] { return series::product(a, a, small); });
  EXPECT_THAT(message, HasSubstr("pairs of terms may become"));
  EXPECT_THAT(message, HasSubstr("raise Truncation::most_bytes"));
  EXPECT_REJECTED(series::power(a, 3, small), "more than the 1e-05 GB");
  EXPECT_EQ(series::product(wave, wave, small), wave * wave);
}

}  // namespace
}  // namespace series_test
