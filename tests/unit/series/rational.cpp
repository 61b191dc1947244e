// SPDX-License-Identifier: MIT
// Rational numbers against those of Boost, and what they refuse.
#include <gmock/gmock.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "message_of.hpp"
#include "polhode/series/symbols.hpp"

namespace series_test {
namespace {

using boost::multiprecision::cpp_int;
using boost::multiprecision::cpp_rational;
using polhode::series::Rational;
using polhode::test::message_of;
using testing::HasSubstr;

constexpr std::int64_t largest = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t least = std::numeric_limits<std::int64_t>::min();

// Small, and where 63 bits end.
std::vector<std::int64_t> numbers() {
  std::vector<std::int64_t> all{0,
                                1,
                                -1,
                                2,
                                -3,
                                6,
                                35,
                                largest,
                                -largest,
                                least,
                                largest - 1,
                                std::int64_t{1} << 32,
                                (std::int64_t{1} << 62) + 1};
  std::mt19937_64 draw(1311);
  for (int i = 0; i < 6; ++i) all.push_back(static_cast<std::int64_t>(draw()) >> (10 * i));
  return all;
}

// Boost takes no negative denominator.
cpp_rational oracle(std::int64_t n, std::int64_t d) {
  return d < 0 ? cpp_rational(-cpp_int(n), -cpp_int(d)) : cpp_rational(cpp_int(n), cpp_int(d));
}

TEST(Rational, IsThatOfBoost) {
  std::vector<std::pair<Rational, cpp_rational>> all;
  for (const std::int64_t n : numbers())
    for (const std::int64_t d : numbers())
      if (d != 0) all.emplace_back(Rational(n, d), oracle(n, d));
  for (const auto& [a, of_a] : all) {
    EXPECT_EQ(a.text(), of_a.str());
    EXPECT_EQ((-a).text(), cpp_rational(-of_a).str());
    EXPECT_EQ(static_cast<double>(a), of_a.convert_to<double>());
    for (std::size_t i = 0; i < all.size(); i += 7) {
      const auto& [b, of_b] = all[i];
      ASSERT_EQ((a + b).text(), cpp_rational(of_a + of_b).str());
      ASSERT_EQ((a - b).text(), cpp_rational(of_a - of_b).str());
      ASSERT_EQ((a * b).text(), cpp_rational(of_a * of_b).str());
      ASSERT_EQ(a == b, of_a == of_b);
      ASSERT_EQ(a < b, of_a < of_b);
      if (of_b == 0) continue;
      ASSERT_EQ((a / b).text(), cpp_rational(of_a / of_b).str());
    }
  }
}

TEST(Rational, HasOneFormWhereBigBecomesSmallAgain) {
  const Rational big = Rational(largest) * Rational(largest);
  EXPECT_EQ(big / series::Rational(largest), series::Rational(largest));
  EXPECT_EQ(big - big, series::Rational(0));
  EXPECT_EQ(big * series::Rational(3), series::Rational(3) * big);
}

TEST(Rational, ReadsWhatTextSays) {
  EXPECT_EQ(series::Rational::from_text("-3/4"), series::Rational(-3, 4));
  EXPECT_EQ(series::Rational::from_text("0.1"), series::Rational(1, 10));
  EXPECT_EQ(series::Rational::from_text("010"), series::Rational(10));
  EXPECT_EQ(series::Rational::from_text("1.25e-1"), series::Rational(1, 8));
  EXPECT_EQ(series::Rational::from_text("2.5E+2"), series::Rational(250));
  const Rational big = Rational(largest) * Rational(-largest, 7);
  EXPECT_EQ(series::Rational::from_text(big.text()), big);
}

// n / 2^k, below the normal range too, where a double has fewer digits: a long double holds it
// whole. (strtod of glibc 2.36 is wrong for 0x34fcf391a6815bp-1076.)
TEST(Rational, IsRoundedOnce) {
  std::mt19937_64 draw(77);
  for (int k = 1040; k <= 1140; ++k)
    for (int bits = 1; bits <= 62; ++bits) {
      const std::uint64_t n = draw() >> (64 - bits);
      const auto wanted = static_cast<double>(std::ldexp(static_cast<long double>(n), -k));
      const cpp_int power = cpp_int(1) << k;
      const std::string text = std::to_string(n) + "/" + power.str();
      EXPECT_EQ(static_cast<double>(series::Rational::from_text(text)), wanted) << text;
      EXPECT_EQ(static_cast<double>(series::Rational::from_text("-" + text)), -wanted) << text;
    }
}

TEST(Rational, Refuses) {
  EXPECT_REJECTED(series::Rational(1, 0), "denominator 0");
  EXPECT_REJECTED(series::Rational(1) / series::Rational(0), "division by 0");
  for (const char* const text : {"", "-", "1/", "/2", "1/-2", "x", "1e", "1e--2", "1e+-2", "1.2.3",
                                 " 1", ".", "1e9999", "--1", "+1"})
    EXPECT_REJECTED(series::Rational::from_text(text), "Rational: '") << text;
  EXPECT_REJECTED(series::Rational::from_text("1/0"), "denominator of 0");
  const Rational long_one = Rational::from_text("1e4000");
  EXPECT_THAT(message_of([&] {
                series::Rational x = long_one;
                for (int i = 0; i < 10; ++i) x *= x;
              }),
              HasSubstr("more than 300000 binary digits"));
}

}  // namespace
}  // namespace series_test
