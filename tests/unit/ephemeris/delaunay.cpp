// SPDX-License-Identifier: MIT
// Moon and Sun in Delaunay's arguments: against ERFA's own functions of time.
#include "polhode/ephemeris/delaunay.hpp"

#include <erfa.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "budgets.hpp"
#include "polhode/ephemeris/ephemeris.hpp"
#include "worst.hpp"

namespace polhode {
namespace {

using polhode::test::Worst;

constexpr double degree = std::numbers::pi / 180.0;

// From the ICRS to ecliptic and mean equinox of date.
Vec3 of_date(double T, const Vec3& x) {
  double gamma = 0.0, phi = 0.0, psi = 0.0, eps = 0.0;
  eraPfw06(2451545.0, 36525.0 * T, &gamma, &phi, &psi, &eps);
  double r[3][3], from[3] = {x.x, x.y, x.z}, to[3];
  eraIr(r);
  eraRz(gamma, r);
  eraRx(phi, r);
  eraRz(-psi, r);
  eraRxp(r, from, to);
  return {to[0], to[1], to[2]};
}

// With the terms of Venus and Jupiter, which are left out.
Vec3 whole_moon(double T) {
  const DelaunayArguments a = delaunay_arguments(T);
  const double A1 = (119.75 + 131.849 * T) * degree, A2 = (53.09 + 479264.290 * T) * degree,
               A3 = (313.45 + 481266.484 * T) * degree;
  EclipticPosition moon = moon_of_date(a, T);
  moon.longitude += degree * (0.003958 * std::sin(A1) + 0.000318 * std::sin(A2));
  moon.latitude +=
      degree * (0.000382 * std::sin(A3) + 0.000175 * (std::sin(A1 - a.F) + std::sin(A1 + a.F)));
  return cartesian(moon);
}

TEST(Delaunay, TheMoonIsThatOfErfa) {
  Worst worst;
  for (int k = -40; k <= 40; ++k) {
    const double T = 0.0253 * k;
    double pv[2][3];
    eraMoon98(2451545.0, 36525.0 * T, pv);
    constexpr double au = 149597870.7;
    const Vec3 there = of_date(T, {au * pv[0][0], au * pv[0][1], au * pv[0][2]});
    worst.add(norm(whole_moon(T) - there) / norm(there));
  }
  EXPECT_LT(worst.value(), budget::delaunay_moon);
}

TEST(Delaunay, TheSunIsThereWithinThePerturbationsOfThePlanets) {
  Worst worst;
  for (int k = -40; k <= 40; ++k) {
    const double T = 0.0247 * k;
    const Vec3 there = of_date(T, planetary_position(Planetary::sun, Planetary::earth,
                                                     {TimeScale::TDB, 2451545.0, 36525.0 * T}));
    const Vec3 here = sun_of_date(delaunay_arguments(T), T);
    worst.add(norm(here - there) / norm(there));
  }
  EXPECT_LT(worst.value(), budget::delaunay_sun);
}

TEST(Delaunay, RatesAreTheSlopesOfTheArguments) {
  constexpr double h = 1e-4;
  for (const double T : {-0.9, 0.0, 0.7}) {
    const DelaunayArguments before = delaunay_arguments(T - h), after = delaunay_arguments(T + h),
                            rate = delaunay_rates(T);
    EXPECT_NEAR((after.l - before.l) / (2.0 * h) / rate.l, 1.0, budget::delaunay_rates);
    EXPECT_NEAR((after.lp - before.lp) / (2.0 * h) / rate.lp, 1.0, budget::delaunay_rates);
    EXPECT_NEAR((after.F - before.F) / (2.0 * h) / rate.F, 1.0, budget::delaunay_rates);
    EXPECT_NEAR((after.D - before.D) / (2.0 * h) / rate.D, 1.0, budget::delaunay_rates);
    EXPECT_NEAR((after.Om - before.Om) / (2.0 * h) / rate.Om, 1.0, budget::delaunay_rates);
  }
}

}  // namespace
}  // namespace polhode
