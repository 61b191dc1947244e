// SPDX-License-Identifier: MIT
// What kernels ask of numbers and of packs of them.
#include "polhode/math/number.hpp"

#include <gtest/gtest.h>

#include "lanes.hpp"
#include "polhode/math/double_double.hpp"
#include "polhode/math/dual.hpp"
#include "polhode/math/quaternion.hpp"

namespace polhode::test {
namespace {

using Pack = Lanes<double, 3>;

static_assert(Number<double> && Real<double>);
static_assert(Number<DoubleDouble> && Number<Dual<double, 2>>);
static_assert(Number<Pack> && !Real<Pack>);
static_assert(std::same_as<Mask<double>, bool>);
static_assert(std::same_as<Mask<Pack>, LaneMask<3>>);

Pack pack(double a, double b, double c) {
  Pack p;
  p.lane = {a, b, c};
  return p;
}

TEST(Number, ScalarsSelectByBool) {
  EXPECT_EQ(select(true, 1.0, 2.0), 1.0);
  EXPECT_EQ(select(false, Vec3{1.0, 2.0, 3.0}, Vec3{}), Vec3{});
  EXPECT_TRUE(any(true) && all(true));
  EXPECT_EQ(any(false) || all(false), false);
}

TEST(Number, PacksSelectLaneByLane) {
  const Pack a = pack(1.0, 5.0, 3.0), b = pack(2.0, 4.0, 3.0);
  const Pack less = select(a < b, a, b);
  EXPECT_EQ(less.lane, (std::array<double, 3>{1.0, 4.0, 3.0}));
  EXPECT_TRUE(any(a < b));
  EXPECT_EQ(all(a < b), false);
  const BasicVec3<Pack> v = select(a < b, BasicVec3<Pack>{a, a, a}, BasicVec3<Pack>{b, b, b});
  EXPECT_EQ(v.y.lane, less.lane);
}

// A side that no lane takes is not computed.
TEST(Number, WhereLeavesOutWhatNobodyTakes) {
  int first = 0, second = 0;
  const auto f = [&] { return ++first, pack(1.0, 1.0, 1.0); };
  const auto g = [&] { return ++second, pack(2.0, 2.0, 2.0); };
  const Pack zero = pack(0.0, 0.0, 0.0), mixed = pack(-1.0, 0.0, 1.0);
  EXPECT_EQ(where(zero < zero, f, g).lane[0], 2.0);
  EXPECT_EQ(first, 0);
  EXPECT_EQ(where(zero == zero, f, g).lane[0], 1.0);
  EXPECT_EQ(second, 1);
  EXPECT_EQ(where(mixed < zero, f, g).lane, (std::array<double, 3>{1.0, 2.0, 2.0}));
  EXPECT_EQ(where(
                true, [] { return 1.0; }, [] { return 2.0; }),
            1.0);
}

TEST(Number, EachLaneGoesAlone) {
  const Pack sum =
      each_lane([](double x, double y) { return x + y; }, pack(1.0, 2.0, 3.0), pack(4.0, 5.0, 6.0));
  EXPECT_EQ(sum.lane, (std::array<double, 3>{5.0, 7.0, 9.0}));
}

}  // namespace
}  // namespace polhode::test
