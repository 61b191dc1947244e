// SPDX-License-Identifier: MIT
// Tides of the spin over ages. Oracles: the momentum of spin and orbit together, the other method,
// what lunar laser ranging says of the Moon, and the theory without tides.
#include "polhode/secular/tidal_spin.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/dynamics/integrate_model.hpp"
#include "polhode/secular/orbit_history.hpp"
#include "worst.hpp"

namespace {

using namespace polhode;

constexpr double turn = 2.0 * std::numbers::pi, arcsec = turn / 1296000.0;
constexpr double year = 365.25 * 86400.0, Myr = 1e6 * year;  // s

// Earth and Moon, in million years: k2 and lag of Neron de Surgy & Laskar (1997).
constexpr double k2 = 0.305, lag = 638.0, R = 6378.1366e3, factor = 0.3307;
constexpr double gm_moon = 4.9028001e12, gm_earth = 3.986004e14, distance = 384399e3;
constexpr double gm_sun = 1.32712440041e20, au = 149597870.7e3;

secular::TidalRates earth() {
  const double month = std::sqrt((gm_earth + gm_moon) / distance) / distance;
  const double mass = gm_moon / gm_earth;
  const double momentum = mass / (1.0 + mass) * month * (distance / R) * (distance / R) / factor;
  return {.spin = 7.292115e-5 * Myr,
          .orbit = std::sqrt(gm_sun / au) / au * Myr,
          .star = secular::tidal_rate(k2, lag, gm_sun, gm_sun / gm_earth, R, factor, au) * Myr,
          .satellite = secular::tidal_rate(k2, lag, gm_moon, mass, R, factor, distance) * Myr,
          .satellite_orbit = month * Myr,
          .satellite_momentum = momentum * Myr};
}
constexpr secular::PrecessionRates rates{.star = 17.37e6 * arcsec, .satellites = 37.5e6 * arcsec};
const secular::ElementSeries orbit({{4.249e6 * arcsec, 0.0189, 0.53}},
                                   {{-18.85e6 * arcsec, 0.0080, 4.28}});
const secular::ElementSeries circle({{0.0, 0.0, 0.0}}, {{0.0, 0.0, 0.0}});

secular::TidalSpin start(double obliquity) {
  return {{0.0, std::sin(obliquity), std::cos(obliquity)}};
}

template <class M, class S>
S moved(const M& model, const S& from, double time, const Method& method) {
  const Keep last{.samples = SaveAt::times({time}), .dense = false};
  return integrate(BasicProblem<M>{model, from, 0.0, time, method}, last).samples().back().s;
}
const Splitting fine{.step = 0.002, .scheme = SplittingScheme::order8};

// 3.82 cm a year (Dickey et al. 1994), for which k2 and lag were chosen; the day grows by 2.3 ms a
// century (Stephenson & Morrison 1995), of which this theory gives 0.2 more to the Sun.
TEST(TidalSpin, TheMoonGoesAwayAsLaserRangingSays) {
  const Vec3 pole{0.0, 0.0, 1.0};
  const secular::TidalSpin change =
      secular::detail::tidal_change(earth(), 0.0, pole, start(0.4091));
  EXPECT_NEAR(change.distance * distance / 1e6, 0.0382, budget::tidal_recession);
  const double day = -change.spin * 86164.1 * 1e-4;  // s a century
  EXPECT_NEAR(day, 2.3e-3, budget::tidal_day);
  EXPECT_GT(change.s.y * std::cos(0.4091) - change.s.z * std::sin(0.4091), 0.0);
}

// On an orbit that stays, what the spin loses along its normal the Moon gains.
TEST(TidalSpin, TheMomentumAlongTheNormalStays) {
  secular::TidalRates tides = earth();
  tides.star = 0.0;
  const secular::TidalPrecession model(circle, rates, tides);
  const auto momentum = [&](const secular::TidalSpin& at) {
    return tides.spin * at.spin * at.s.z + tides.satellite_momentum * std::sqrt(at.distance);
  };
  const secular::TidalSpin from = start(0.4);
  for (const double time : {-500.0, 800.0}) {
    const secular::TidalSpin to = moved(model, from, time, Splitting{.step = 0.05});
    EXPECT_NEAR(momentum(to) / momentum(from), 1.0, budget::tidal_momentum);
    EXPECT_GT((to.distance - 1.0) * time, 0.0);
    EXPECT_LT((to.spin - 1.0) * time, 0.0);
    EXPECT_NEAR(norm(to.s), 1.0, budget::secular_rounding);
  }
}

TEST(TidalSpin, TheSplittingIsTheAdaptiveMethod) {
  const secular::TidalPrecession model(orbit, rates, earth());
  const secular::TidalSpin a = moved(model, start(0.4), -5.0, Adaptive{1e-13}),
                           b = moved(model, start(0.4), -5.0, fine);
  EXPECT_LT(norm(a.s - b.s), budget::tidal_methods);
  EXPECT_NEAR(a.spin, b.spin, budget::tidal_methods);
  EXPECT_NEAR(a.distance, b.distance, budget::tidal_methods);
}

// On an orbit that stays, the frozen motion is all there is: a step of any scheme is as exact as
// the tides are slow.
TEST(TidalSpin, StepsMayBeLongOnAnOrbitThatStays) {
  const secular::PrecessionRates slow{.star = 0.05, .satellites = 0.1};
  const secular::TidalPrecession model(
      secular::ElementSeries({{0.0, 0.2, 0.0}}, {{0.0, 0.05, 1.2}}), slow, earth());
  const secular::TidalSpin a = moved(model, start(0.5), -400.0, Adaptive{1e-13});
  for (const SplittingScheme scheme : {SplittingScheme::order2, SplittingScheme::order8}) {
    const secular::TidalSpin b =
        moved(model, start(0.5), -400.0, Splitting{.step = 2.0, .scheme = scheme});
    EXPECT_LT(norm(a.s - b.s), budget::tidal_long_steps);
    EXPECT_NEAR(a.spin, b.spin, budget::tidal_long_steps);
  }
}

// Below the synchronous distance a satellite comes down, and the equations end.
TEST(TidalSpin, ARunEndsWhereASatelliteComesDown) {
  const secular::TidalRates tides{.spin = 5.0,
                                  .orbit = 1.0,
                                  .satellite = 0.1,
                                  .satellite_orbit = 10.0,
                                  .satellite_momentum = 3.0};
  const secular::TidalPrecession model(orbit, secular::PrecessionRates{.star = 1.0}, tides);
  for (const Method& method :
       {Method(Adaptive{}), Method(Splitting{.step = 0.1, .scheme = SplittingScheme::order8})}) {
    const Keep rows{.samples = SaveAt::times({0.0, 0.1, 500.0}), .dense = false};
    const auto run = integrate(
        BasicProblem<secular::TidalPrecession<secular::ElementSeries>>{model, start(0.4), 0.0,
                                                                       500.0, method},
        rows);
    EXPECT_FALSE(run.outcome().ok());
    EXPECT_GE(run.samples().size(), 2U);
    EXPECT_LT(run.outcome().t, 1.0);
  }
}

TEST(TidalSpin, WithoutTidesItIsTheTheoryWithout) {
  const secular::TidalPrecession model(orbit, rates,
                                       secular::TidalRates{.spin = 1.0, .orbit = 1.0});
  const secular::SpinPrecession<secular::ElementSeries> plain(orbit, rates);
  const secular::TidalSpin a = moved(model, start(0.4), 1.0, fine);
  const secular::SpinAxis b = moved(plain, secular::SpinAxis{start(0.4).s}, 1.0, fine);
  EXPECT_LT(norm(a.s - b.s), budget::tidal_methods);
  EXPECT_EQ(a.spin, 1.0);
  EXPECT_EQ(a.distance, 1.0);
}

// Star alone, e = 0: where the spin is that of the orbit and the axis its normal, nothing changes;
// above, a spin slows down (Hut 1981: at e > 0 the balance lies at N / f).
TEST(TidalSpin, TheSpinOfBalanceIsHuts) {
  const double e2 = 0.09;
  const double N = 1.0 + 7.5 * e2 + 5.625 * e2 * e2 + 0.3125 * e2 * e2 * e2,
               f = (1.0 + 3.0 * e2 + 0.375 * e2 * e2) * std::pow(1.0 - e2, 1.5);
  const secular::TidalRates balance{.spin = N / f, .orbit = 1.0, .star = 0.1};
  const secular::TidalSpin change =
      secular::detail::tidal_change(balance, e2, {0.0, 0.0, 1.0}, start(0.0));
  EXPECT_NEAR(change.spin, 0.0, budget::secular_rounding);
}

TEST(TidalSpin, WhatIsNone) {
  secular::TidalRates of = earth();
  of.spin = 0.0;
  EXPECT_MESSAGE(require_valid(of), "TidalRates: spin 0 must be positive");
  of = earth();
  of.satellite_momentum = 0.0;
  EXPECT_MESSAGE(require_valid(of),
                 "TidalRates: satellite_momentum 0 must be positive where there is a satellite");
  EXPECT_MESSAGE(secular::tidal_rate(0.3, -1.0, 1.0, 1.0, 1.0, 1.0, 1.0),
                 "tidal_rate: lag -1 must not be negative");
  EXPECT_MESSAGE(secular::tidal_rate(0.3, 1.0, 1.0, 1.0, 0.0, 1.0, 1.0),
                 "tidal_rate: radius 0 must be positive");
}

}  // namespace
