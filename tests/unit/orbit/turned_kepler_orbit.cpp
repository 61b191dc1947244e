// SPDX-License-Identifier: MIT
#include "polhode/orbit/turned_kepler_orbit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "budgets.hpp"
#include "polhode/error.hpp"

namespace polhode::test {
namespace {

const KeplerElements elements{1.5, 0.8, 0.2, 0.7, 0.3, -0.4, 0.5, 1.0};
const PrecessingKeplerOrbit inner(elements, {-0.01, 0.02, 0.003});

// The pole of the equator has the ecliptic latitude 90 degrees less the obliquity, longitude 90.
TEST(TurnedKeplerOrbit, TheEquatorialPoleLiesWhereTheSkyHasIt) {
  const KeplerElements in_equator{1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  const auto orbit = TurnedKeplerOrbit::from_equator({in_equator, {}});
  const double eps = 84381.448 / 3600.0 * std::numbers::pi / 180.0;
  const double tol = budget::table_orbit_kepler;
  const Vec3 pole = cross(orbit.position(0.0), orbit.velocity(0.0));
  EXPECT_NEAR(pole.x, 0.0, tol);
  EXPECT_NEAR(pole.y, std::sin(eps), tol);
  EXPECT_NEAR(pole.z, std::cos(eps), tol);
}

TEST(TurnedKeplerOrbit, OneUndoesTheOther) {
  const TurnedKeplerOrbit there = TurnedKeplerOrbit::from_equator(inner);
  EXPECT_EQ(there.angle(), -TurnedKeplerOrbit::from_ecliptic(inner).angle());
  const double c = std::cos(there.angle()), s = std::sin(there.angle());
  for (const double t : {-3.0, 0.0, 17.0}) {
    const Vec3 x = there.position(t), back{x.x, c * x.y - s * x.z, s * x.y + c * x.z};
    EXPECT_LT(norm(back - inner.position(t)), budget::table_orbit_kepler);
  }
  EXPECT_EQ(there.gm(), elements.gm);
}

TEST(TurnedKeplerOrbit, EveryNumberTypeSeesOneOrbit) {
  const TurnedKeplerOrbit orbit(inner, 0.3);
  const Vec3 x = orbit.position(2.0), v = orbit.velocity(2.0);
  const auto d = orbit.position(Dual<double, 1>::variable(2.0, 0));
  const BasicVec3<DoubleDouble> wide = orbit.position(DoubleDouble(2.0));
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(d[i].value, x[i]);
    EXPECT_EQ(d[i].derivative[0], v[i]);
    EXPECT_NEAR(to_double(wide[i]), x[i], budget::table_orbit_kepler);
  }
}

TEST(TurnedKeplerOrbit, RefusesAnAngleThatIsNone) {
  EXPECT_THROW(TurnedKeplerOrbit(inner, std::numeric_limits<double>::infinity()), DomainError);
}

}  // namespace
}  // namespace polhode::test
