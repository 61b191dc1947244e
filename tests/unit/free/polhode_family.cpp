// SPDX-License-Identifier: MIT
// From an action back to its polhode, and the two actions of the family.
#include "free/detail/polhode_family.hpp"

#include <gtest/gtest.h>

#include "budgets.hpp"
#include "polhode/free/detail/axis_order.hpp"
#include "polhode/math/double_double.hpp"
#include "polhode/math/dual.hpp"
#include "unit/free/support.hpp"

namespace {

using namespace free_test;
using namespace polhode;
using polhode::detail::FamilyMember;
namespace detail = polhode::detail;
using DD = DoubleDouble;
using polhode::detail::AxisOrder;

constexpr double values_of_v[] = {-500.0, -60.0, -8.0, -1.0, 0.0, 2.0, 9.0, 40.0};
constexpr double kappas[] = {0.0, 1e-20, 1e-3, 1.0, 40.0, 1e12};
const double allowed = budget::family_eps * epsilon<DD>();

TEST(PolhodeFamily, MemberKeepsBothComplements) {
  for (const double kap2 : kappas) {
    for (const double v : values_of_v) {
      const FamilyMember<DD> f = detail::family_member(DD(kap2), DD(v));
      const DD w = exp(DD(v));
      EXPECT_LE(std::abs((f.r2 * (DD(1.0) + DD(kap2) * w) / w - DD(1.0)).hi), allowed);
      EXPECT_LE(std::abs((DD(kap2) * f.r2 + f.kp2 - DD(1.0)).hi), allowed);
    }
  }
}

TEST(PolhodeFamily, ActionsAddUpToTheMomentum) {
  for (const double kap2 : kappas) {
    for (const double v : values_of_v) {
      const FamilyMember<DD> f = detail::family_member(DD(kap2), DD(v));
      const DD sum = detail::action_deficit(DD(kap2), f) + detail::action_ratio(DD(kap2), f);
      EXPECT_LE(std::abs((sum - DD(1.0)).hi), allowed) << kap2 << " " << v;
    }
  }
}

// [SA "IellSadov, range"] On the separatrix the action is (2/pi) arctan kappa.
TEST(PolhodeFamily, ActionOfTheSeparatrix) {
  for (const double kap2 : {1e-3, 1.0, 40.0}) {
    const FamilyMember<DD> f{DD(1.0) / DD(kap2), DD(0.0)};
    const DD kappa = sqrt(DD(kap2));
    const DD ratio = DD(2.0) / DD::pi() * atan2(DD(1.0), kappa);
    EXPECT_LE(std::abs((detail::action_deficit(DD(kap2), f) - ratio).hi), allowed) << kap2;
  }
}

// [SA "dI_l/dlambda"]
TEST(PolhodeFamily, SlopeIsTheDerivative) {
  using D1 = Dual<DD, 1>;
  for (const double kap2 : {1e-3, 1.0, 40.0}) {
    for (const double v : {-8.0, -1.0, 0.0, 2.0, 9.0}) {
      const FamilyMember<DD> f = detail::family_member(DD(kap2), DD(v));
      const D1 r2 = D1::variable(f.r2, 0);
      const D1 kp2 = D1(f.kp2) - D1(DD(kap2)) * (r2 - D1(f.r2));
      const D1 deficit = detail::action_deficit(D1(DD(kap2)), FamilyMember<D1>{r2, kp2});
      const DD slope = detail::action_deficit_slope(DD(kap2), f);
      EXPECT_LE(std::abs((deficit.derivative[0] / slope - DD(1.0)).hi),
                budget::family_derivative_eps * epsilon<DD>())
          << kap2 << " " << v;
    }
  }
}

// The root of action_deficit(v) = d, for any member, gives back the member.
TEST(PolhodeFamily, RootInvertsTheAction) {
  for (const double kap2 : kappas) {
    for (const double v : values_of_v) {
      const DD k(kap2);
      const FamilyMember<DD> f = detail::family_member(k, DD(v));
      const DD target = detail::action_deficit(k, f);
      const auto excess = [&](const DD& x) {
        return log(detail::action_deficit(k, detail::family_member(k, x)) / target);
      };
      const DD high = detail::family_end(k);
      const FamilyMember<DD> found =
          detail::family_member(k, detail::family_root(excess, detail::family_start<DD>(), high));
      const DD again = detail::action_deficit(k, found);
      EXPECT_LE(relative(again.hi, target.hi), budget::family_root) << kap2 << " " << v;
      if (v < high.hi - 50.0) {
        EXPECT_LE(relative(found.r2.hi, f.r2.hi), budget::family_root);
      }
    }
  }
}

TEST(PolhodeFamily, RootAtAnEndOrBeyondIsThatEnd) {
  const auto f = [](const DD& x) { return x - DD(5.0); };
  EXPECT_EQ(detail::family_root(f, DD(6.0), DD(9.0)), DD(6.0));
  EXPECT_EQ(detail::family_root(f, DD(-2.0), DD(4.0)), DD(4.0));
  EXPECT_NEAR(detail::family_root(f, DD(-2.0), DD(9.0)).hi, 5.0, budget::family_root);
  const auto steep = [](const DD& x) { return x < DD(0.3) ? DD(-1e-30) : DD(1e30); };
  EXPECT_NEAR(detail::family_root(steep, DD(-600.0), DD(400.0)).hi, 0.3, budget::family_root);
}

// A curve of a member has its modulus, its amplitudes and the momentum.
TEST(PolhodeFamily, CurveOfAMember) {
  const BasicVec3<DD> I{DD(3.0), DD(4.0), DD(6.0)};
  for (const bool long_axis : {false, true}) {
    const DD kap2 = detail::kappa_squared(detail::primed_moments(I, long_axis));
    for (const double v : {-500.0, -8.0, 0.0, 9.0, 40.0}) {
      const FamilyMember<DD> f = detail::family_member(kap2, DD(v));
      const auto c = detail::family_curve(I, long_axis, DD(1.25), f);
      EXPECT_EQ(c.long_axis, long_axis);
      EXPECT_LE(std::abs((c.r2 / f.r2 - DD(1.0)).hi), allowed);
      EXPECT_LE(std::abs((c.kp2 / f.kp2 - DD(1.0)).hi), allowed);
      EXPECT_LE(std::abs((c.k2 / (kap2 * f.r2) - DD(1.0)).hi), allowed);
      EXPECT_LE(std::abs((c.a1 * c.a1 + c.a3 * c.a3 - DD(1.25 * 1.25)).hi), allowed);
    }
  }
}

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
