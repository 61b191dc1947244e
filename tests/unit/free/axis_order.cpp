// SPDX-License-Identifier: MIT
#include "polhode/free/detail/axis_order.hpp"

#include <gtest/gtest.h>

#include "budgets.hpp"
#include "polhode/math/double_double.hpp"
#include "unit/free/support.hpp"

namespace {

using namespace free_test;
using namespace polhode;
using polhode::detail::AxisOrder;
namespace detail = polhode::detail;

std::vector<AxisOrder> all_orders() {
  std::vector<AxisOrder> orders;
  for (const Turn& t : proper_turns()) orders.push_back({t.axis, t.sign});
  return orders;
}

TEST(AxisOrder, ThereAre24Rotations) { EXPECT_EQ(all_orders().size(), 24U); }

// The quaternion turns components as the permutation does, to the last digit of its type.
template <class T>
void expect_quaternions(double epsilon) {
  const BasicVec3<T> v{T(0.3), T(-0.7), T(1.9)};
  for (const AxisOrder& p : all_orders()) {
    const BasicQuaternion<T> q = detail::quaternion_of<T>(p);
    const BasicVec3<T> d = rotate(q, v) - detail::reordered(p, v);
    EXPECT_LE(to_double(norm(d)), budget::axis_order_eps * epsilon);
    const T n2 = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z;
    EXPECT_LE(std::abs(to_double(n2 - T(1.0))), budget::axis_order_eps * epsilon);
  }
}
TEST(AxisOrder, QuaternionOfEveryRotation) {
  expect_quaternions<double>(eps);
  expect_quaternions<DoubleDouble>(epsilon<DoubleDouble>());
}

TEST(AxisOrder, RestoredIsTheInverse) {
  const Vec3 v{0.3, -0.7, 1.9};
  for (const AxisOrder& p : all_orders()) {
    EXPECT_EQ(detail::restored(p, detail::reordered(p, v)), v);
    EXPECT_EQ(detail::reordered(p, detail::restored(p, v)), v);
  }
}

TEST(AxisOrder, ComposedIsOneAfterTheOther) {
  const Vec3 v{0.3, -0.7, 1.9};
  for (const AxisOrder& first : all_orders()) {
    for (const AxisOrder& second : all_orders()) {
      EXPECT_EQ(detail::reordered(detail::composed(first, second), v),
                detail::reordered(second, detail::reordered(first, v)));
    }
  }
}

TEST(AxisOrder, AscendingMomentsByAProperRotation) {
  for (const Vec3& moments : {Vec3{3, 4, 6}, Vec3{3, 3, 5}, Vec3{2, 5, 5}, Vec3{2, 2, 2}}) {
    for (const Turn& t : proper_turns()) {
      const Vec3 m{moments[t.axis[0]], moments[t.axis[1]], moments[t.axis[2]]};
      const AxisOrder p = detail::ascending_order(m);
      const std::array<double, 3> sorted{m[p.axis[0]], m[p.axis[1]], m[p.axis[2]]};
      EXPECT_EQ(sorted, (std::array<double, 3>{moments.x, moments.y, moments.z}));
      const Vec3 x = detail::reordered(p, Vec3{1, 0, 0}), y = detail::reordered(p, Vec3{0, 1, 0});
      EXPECT_EQ(cross(x, y), detail::reordered(p, Vec3{0, 0, 1}));
    }
  }
}

TEST(AxisOrder, EqualMomentsKeepTheirOrder) {
  EXPECT_EQ(detail::ascending_order({2, 2, 2}).axis, (std::array<int, 3>{0, 1, 2}));
  EXPECT_EQ(detail::ascending_order({3, 3, 5}).axis, (std::array<int, 3>{0, 1, 2}));
  EXPECT_EQ(detail::ascending_order({5, 3, 3}).axis, (std::array<int, 3>{1, 2, 0}));
  EXPECT_EQ(detail::ascending_order({3, 4, 6}).sign, (std::array<double, 3>{1.0, 1.0, 1.0}));
}

}  // namespace
