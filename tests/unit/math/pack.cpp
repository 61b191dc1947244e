// SPDX-License-Identifier: MIT
// Pack for any processor: every lane is what a double alone would be.
#include "polhode/detail/math/pack.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace {

using P = polhode::Pack<polhode::InstructionSet::baseline>;
constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

std::uint64_t bits(double x) {
  return std::bit_cast<std::uint64_t>(std::isnan(x) ? not_a_number : x);
}

std::vector<double> values() {
  std::vector<double> v{0.0,    0.5,     0.49999999999999994, 1.0,    1.5,          2.5,
                        3.7,    0x1p51,  0x1p52 - 0.5,        0x1p52, 0x1p53 + 2.0, 1e300,
                        5e-324, infinite};
  const std::size_t n = v.size();
  for (std::size_t i = 0; i < n; ++i) v.push_back(-v[i]);
  v.push_back(not_a_number);
  return v;
}

// f of packs and of doubles.
template <class F>
void expect_lanes(const F& f) {
  for (const double a : values())
    for (const double b : values()) {
      P x(a), y(b);
      x.lanes[1] = b;
      y.lanes[1] = a;
      const P r = f(x, y);
      EXPECT_EQ(bits(r.lanes[0]), bits(f(a, b))) << a << ", " << b;
      EXPECT_EQ(bits(r.lanes[1]), bits(f(b, a))) << b << ", " << a;
    }
}

TEST(Pack, ComputesAsDoublesDo) {
  using polhode::select;
  using std::abs, std::exp, std::floor, std::rint, std::sqrt;
  expect_lanes([](const auto& a, const auto& b) { return a + b; });
  expect_lanes([](const auto& a, const auto& b) { return a - b; });
  expect_lanes([](const auto& a, const auto& b) { return a * b; });
  expect_lanes([](const auto& a, const auto& b) { return a / b; });
  expect_lanes([](const auto& a, const auto&) { return -a; });
  expect_lanes([](const auto& a, const auto&) { return abs(a); });
  expect_lanes([](const auto& a, const auto&) { return sqrt(a); });
  expect_lanes([](const auto& a, const auto&) { return rint(a); });
  expect_lanes([](const auto& a, const auto&) { return floor(a); });
  expect_lanes([](const auto& a, const auto&) { return exp(a); });
  expect_lanes([](const auto& a, const auto& b) { return select(a < b, a, b); });
  expect_lanes([](const auto& a, const auto& b) { return select(a <= b, b, a); });
  expect_lanes([](const auto& a, const auto& b) { return select(a == b, a, -b); });
  expect_lanes([](const auto& a, const auto& b) { return select(a != b, a, -b); });
  expect_lanes([](const auto& a, const auto& b) { return select(a > b && !(b >= a), a, -b); });
  expect_lanes([](const auto& a, const auto& b) { return select(a > b || b == a, a, -b); });
  expect_lanes([](const auto& a, const auto& b) { return select((a > b) != (b > a), a, -b); });
  expect_lanes([](const auto& a, const auto& b) { return select((a > b) == (b > a), a, -b); });
}

TEST(Pack, KeepsTheSignOfZero) { EXPECT_TRUE(std::signbit(P(-0.0).lanes[0])); }

TEST(Pack, AnyAndAllLookAtEveryLane) {
  P one(0.0);
  one.lanes[1] = 1.0;
  const auto is_one = one == P(1.0), is_small = one <= P(1.0), is_two = one == P(2.0);
  EXPECT_TRUE(any(is_one));
  EXPECT_FALSE(all(is_one));
  EXPECT_TRUE(all(is_small));
  EXPECT_FALSE(any(is_two));
}

TEST(Pack, ReadsAndWritesNumbersWhereverTheyLie) {
  const double from[] = {1.0, 2.0, 3.0, 4.0};
  double to[4] = {};
  P::loaded(from + 1).store(to + 1);
  EXPECT_EQ(to[1], 2.0);
  EXPECT_EQ(to[2], 3.0);
  EXPECT_EQ(to[0], 0.0);
  EXPECT_EQ(to[3], 0.0);
}

}  // namespace
