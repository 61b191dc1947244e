// SPDX-License-Identifier: MIT
// Tabulated orbits: polynomials exactly, order of convergence, a Kepler orbit, continuity.
#include "polhode/orbit/table_orbit.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/error.hpp"
#include "polhode/orbit/any_orbit.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "worst.hpp"

namespace polhode {
namespace {

using polhode::test::smaller;
using polhode::test::Worst;
using ::testing::HasSubstr;

std::vector<double> even_times(double first, double step, int rows) {
  std::vector<double> t;
  for (int k = 0; k < rows; ++k) t.push_back(first + step * k);
  return t;
}

// Spacings between a half and three halves.
std::vector<double> uneven_times(double first, double step, int rows) {
  std::mt19937_64 random(1);
  std::vector<double> t{first};
  for (int k = 1; k < rows; ++k)
    t.push_back(t.back() + step * (0.5 + static_cast<double>(random() % 1024) / 1024.0));
  return t;
}

template <class Position, class Velocity>
PositionTable sampled(const std::vector<double>& times, const Position& x, const Velocity& v,
                      bool slopes) {
  PositionTable table{times, {}, {}};
  for (const double t : times) {
    table.positions.push_back(x(t));
    if (slopes) table.velocities.push_back(v(t));
  }
  return table;
}

// of degree 7, of order one between -1 and 1
Vec3 polynomial(double t) {
  const double t2 = t * t, t4 = t2 * t2;
  return {t4 * t2 * t - 0.5 * t2, 1.0 - t4 * t + t2 * t, 0.25 * t4 * t2 - t};
}
Vec3 polynomial_slope(double t) {
  const double t2 = t * t, t4 = t2 * t2;
  return {7.0 * t4 * t2 - t, -5.0 * t4 + 3.0 * t2, 1.5 * t4 * t - 1.0};
}

TEST(TableOrbit, PolynomialsBelowTheOrderAreExact) {
  for (const bool slopes : {false, true})
    for (const auto& times : {even_times(-1.0, 0.125, 17), uneven_times(-1.0, 0.125, 17)}) {
      const TableOrbit orbit(sampled(times, polynomial, polynomial_slope, slopes), 8);
      EXPECT_EQ(orbit.order(), 8);
      for (int k = 0; k <= 200; ++k) {
        const double t = times.front() + (times.back() - times.front()) * k / 200.0;
        EXPECT_LT(norm(orbit.position(t) - polynomial(t)),
                  budget::table_orbit_polynomial * norm(polynomial(times.back())));
        EXPECT_LT(norm(orbit.velocity(t) - polynomial_slope(t)),
                  budget::table_orbit_slope * norm(polynomial_slope(times.back())));
      }
    }
}

TEST(TableOrbit, RowsComeBackAsTheyAre) {
  const auto times = uneven_times(3.0, 0.25, 30);
  const PositionTable table = sampled(times, polynomial, polynomial_slope, true);
  const TableOrbit orbit(table);
  for (std::size_t k = 0; k + 1 < times.size(); ++k)
    EXPECT_EQ(orbit.position(times[k]), table.positions[k]);
}

Vec3 wave(double t) { return {std::sin(t), std::cos(2.0 * t), std::sin(t + 1.0)}; }
Vec3 wave_slope(double t) { return {std::cos(t), -2.0 * std::sin(2.0 * t), std::cos(t + 1.0)}; }

double largest_error(const TableOrbit& orbit) {
  Worst largest;
  for (int k = 0; k <= 3000; ++k) {
    const double t = orbit.first_time() + (orbit.last_time() - orbit.first_time()) * k / 3000.0;
    largest.add(norm(orbit.position(t) - wave(t)));
  }
  return largest.value();
}

TEST(TableOrbit, HalfTheSpacingGainsTheOrder) {
  for (const bool slopes : {false, true})
    for (const int order : {4, 8, 12}) {
      const auto error = [&](int rows) {
        return largest_error(TableOrbit(
            sampled(even_times(0.0, 12.0 / (rows - 1), rows), wave, wave_slope, slopes), order));
      };
      const int rows = order == 4 ? 97 : 49;
      EXPECT_NEAR(std::log2(error(rows) / error(2 * rows - 1)), order, budget::table_orbit_order)
          << order << slopes;
    }
}

TEST(TableOrbit, AKeplerOrbitIsThereToTwelveDigits) {
  const KeplerOrbit truth({.gm = 1.0, .pericentre = 0.7, .eccentricity = 0.3, .inclination = 0.4});
  const auto x = [&](double t) { return truth.position(t); };
  const auto v = [&](double t) { return truth.velocity(t); };
  const double period = 2.0 * std::numbers::pi / truth.mean_motion();
  for (const bool slopes : {false, true})
    for (const auto& times :
         {even_times(0.0, period / 400, 801), uneven_times(0.0, period / 600, 1201)}) {
      const TableOrbit orbit(sampled(times, x, v, slopes));
      for (int k = 0; k <= 1000; ++k) {
        const double t = smaller(times.back(), 2.0 * period) * k / 1000.0;
        EXPECT_LT(norm(orbit.position(t) - x(t)), budget::table_orbit_kepler);
        EXPECT_LT(norm(orbit.velocity(t) - v(t)), budget::table_orbit_kepler_velocity);
      }
    }
}

TEST(TableOrbit, IsContinuousAtItsRows) {
  for (const bool slopes : {false, true})
    for (const auto& times : {even_times(1.0, 0.5, 40), uneven_times(1.0, 0.5, 40)}) {
      const TableOrbit orbit(sampled(times, wave, wave_slope, slopes));
      for (std::size_t k = 1; k + 1 < times.size(); ++k) {
        const double before = std::nextafter(times[k], 0.0), after = std::nextafter(times[k], 1e9);
        EXPECT_LT(norm(orbit.position(after) - orbit.position(before)),
                  budget::table_orbit_continuous);
        if (slopes) {
          EXPECT_LT(norm(orbit.velocity(after) - orbit.velocity(before)),
                    budget::table_orbit_continuous);
        }
      }
    }
}

TEST(TableOrbit, NumberTypesAgree) {
  const auto times = even_times(0.0, 0.25, 41);
  const TableOrbit orbit(sampled(times, wave, wave_slope, false));
  for (const double t : {0.0, 0.1, 4.3, 9.99, 10.0}) {
    const BasicVec3<DoubleDouble> wide = orbit.position(DoubleDouble(t));
    EXPECT_LT(norm(orbit.position(t) - Vec3{wide.x.hi, wide.y.hi, wide.z.hi}),
              budget::table_orbit_continuous);
    using Time = Dual<double, 6>;
    const BasicVec3<Time> moved = orbit.position(Time::variable(t, 2));
    EXPECT_EQ(moved.x.value, orbit.position(t).x);
    EXPECT_EQ(moved.y.derivative[2], orbit.velocity(t).y);
    const AnyOrbit any("table", orbit);
    EXPECT_EQ(any.velocity(t), orbit.velocity(t));
  }
  EXPECT_LT(norm(orbit.position(4.0, 1e-9) - orbit.position(4.0 + 1e-9)),
            budget::table_orbit_continuous);
}

TEST(TableOrbit, OutsideItIsNowhere) {
  const TableOrbit orbit(sampled(even_times(0.0, 0.25, 41), wave, wave_slope, false));
  EXPECT_TRUE(std::isnan(orbit.position(-1e-9).x));
  EXPECT_TRUE(std::isnan(orbit.position(10.0 + 1e-9).z));
  EXPECT_TRUE(std::isnan(orbit.position(std::nan("")).y));
  EXPECT_TRUE(std::isnan(orbit.velocity(11.0).y));
  EXPECT_TRUE(orbit.covers(10.0, 0.0));
  EXPECT_FALSE(orbit.covers(0.0, 10.1));
}

TEST(TableOrbit, InAnOverhangTheEndsGoOn) {
  for (const bool slopes : {false, true})
    for (const auto& times : {even_times(-1.0, 0.125, 17), uneven_times(-1.0, 0.125, 17)}) {
      const TableOrbit orbit(sampled(times, polynomial, polynomial_slope, slopes), 8, 0.0625);
      EXPECT_EQ(orbit.overhang(), 0.0625);
      for (const double t : {times.front() - 0.0625, times.back() + 0.0625}) {
        EXPECT_LT(norm(orbit.position(t) - polynomial(t)),
                  budget::table_orbit_overhang * norm(polynomial(times.back())));
        EXPECT_LT(norm(orbit.velocity(t) - polynomial_slope(t)),
                  budget::table_orbit_overhang * norm(polynomial_slope(times.back())));
      }
      EXPECT_TRUE(orbit.covers(times.front() - 0.0625, times.back() + 0.0625));
      EXPECT_FALSE(orbit.covers(times.front() - 0.0626, times.back()));
      EXPECT_TRUE(std::isnan(orbit.position(times.front() - 0.0626).x));
      EXPECT_TRUE(std::isnan(orbit.position(times.back() + 0.0626).x));
      EXPECT_EQ(TableOrbit(orbit.table(), 8).overhang(), 0.0);
    }
}

TEST(TableOrbit, WhatIsNoTableIsRefused) {
  const auto error = [](PositionTable table, int order = 0, double overhang = 0.0) {
    return test::message_of([&] { TableOrbit orbit(std::move(table), order, overhang); });
  };
  const auto rows = [](std::vector<double> times) {
    return sampled(times, wave, wave_slope, false);
  };
  EXPECT_THAT(error(rows({0, 1, 2})), HasSubstr("3 rows must be 4 at least"));
  EXPECT_THAT(error(rows({})), HasSubstr("0 rows must be 4 at least"));
  EXPECT_THAT(error(rows({0, 1, 1, 2})), HasSubstr("row 2: time 1 must be after 1"));
  EXPECT_THAT(error(rows({0, 2, 1, 3})), HasSubstr("row 2: time 1 must be after 2"));
  EXPECT_THAT(error(rows({0, 1, 2, std::nan("")})), HasSubstr("row 3: time nan must be finite"));
  EXPECT_THAT(error(rows(even_times(0, 1, 9)), 10), HasSubstr("9 rows must be 10 at least"));
  EXPECT_THAT(error(rows(even_times(0, 1, 40)), 7), HasSubstr("order 7 must be a multiple of 2"));
  EXPECT_THAT(error(rows(even_times(0, 1, 40)), 18), HasSubstr("from 2 to 16"));
  EXPECT_THAT(error({even_times(0, 1, 9), {Vec3{}}}), HasSubstr("must be as many of each"));
  for (const double overhang : {-1.0, 1.5, std::nan("")})
    EXPECT_THAT(error(rows(even_times(0, 1, 9)), 0, overhang),
                HasSubstr("must be from 0 to the mean spacing 1"));
  PositionTable holed = rows({0, 1, 2, 3});
  holed.positions[1].y = std::numeric_limits<double>::infinity();
  EXPECT_THAT(error(holed), HasSubstr("row 1: position and velocity must be finite"));
}

// Rounding alone is left of a wave by so many rows, and high orders must not magnify it at the
// ends.
TEST(TableOrbit, HighOrdersKeepTheirDigitsAtTheEnds) {
  for (const bool slopes : {false, true})
    for (const auto& times : {even_times(0.0, 0.02, 300), uneven_times(0.0, 0.02, 300)})
      for (const int order : slopes ? std::vector{12, 16, 24, 32} : std::vector{10, 12, 16})
        EXPECT_LT(largest_error(TableOrbit(sampled(times, wave, wave_slope, slopes), order)),
                  budget::table_orbit_ends)
            << order << slopes;
}

// Rows of a Kepler orbit of unit semi-major axis, and the error of a table of them relative to the
// distance.
struct KeplerRows {
  explicit KeplerRows(double e) : truth({.gm = 1.0, .pericentre = 1.0 - e, .eccentricity = e}) {}

  PositionTable at(const std::vector<double>& times, bool slopes) const {
    return sampled(
        times, [&](double t) { return truth.position(t); },
        [&](double t) { return truth.velocity(t); }, slopes);
  }
  double error(const TableOrbit& orbit) const {
    Worst largest;
    const std::vector<double>& t = orbit.table().times;
    for (std::size_t k = 1; k < t.size(); ++k)
      for (const double part : {0.125, 0.25, 0.5, 0.75, 0.875}) {
        const double at = t[k - 1] + part * (t[k] - t[k - 1]);
        largest.add(norm(orbit.position(at) - truth.position(at)) / norm(truth.position(at)));
      }
    return largest.value();
  }

  KeplerOrbit truth;
};

// The rows on either side of a gap are even.
std::vector<double> times_with_gap(double step, int rows_before, int rows, double gap) {
  std::vector<double> t = even_times(0.0, step, rows);
  for (int k = rows_before; k < rows; ++k) t[static_cast<std::size_t>(k)] += gap;
  return t;
}

TEST(TableOrbit, AGapInALongTableIsInTheEstimate) {
  const KeplerRows rows(0.1);
  for (const bool slopes : {false, true})
    for (const int count : {59002, 99002}) {
      const TableOrbit orbit(rows.at(times_with_gap(0.01, 20000, count, 10.0), slopes));
      EXPECT_GT(interpolation_error(orbit), budget::table_orbit_estimate_coarse) << slopes << count;
    }
}

// At some lengths two orders agree in the middle of the gap.
TEST(TableOrbit, AGapOfAnyLengthIsInTheEstimate) {
  for (const double e : {0.0, 0.3})
    for (const bool slopes : {false, true})
      for (double gap = 7.0; gap < 20.0; gap *= 1.003) {
        const TableOrbit orbit(KeplerRows(e).at(times_with_gap(0.01, 20, 40, gap), slopes));
        EXPECT_GT(interpolation_error(orbit), budget::table_orbit_estimate_coarse)
            << e << slopes << gap;
      }
}

// Orders above 12 fall to 12 there.
TEST(TableOrbit, TheEndsOfHighOrdersAreInTheEstimate) {
  for (const double e : {0.0, 0.3})
    for (const bool slopes : {false, true})
      for (const int order : slopes ? std::vector{16, 24, 32} : std::vector{14, 16})
        for (const double step : {0.3, 0.6}) {
          const KeplerRows rows(e);
          const TableOrbit orbit(rows.at(even_times(0.0, step, 60), slopes), order);
          const double error = rows.error(orbit), estimate = interpolation_error(orbit);
          EXPECT_GT(estimate, budget::table_orbit_estimate_least * error) << e << order << step;
          EXPECT_LT(estimate, budget::table_orbit_estimate_most * error) << e << order << step;
        }
}

TEST(TableOrbit, TwoOrThreeRowsWithVelocitiesAreJudged) {
  constexpr double turn = 2.0 * std::numbers::pi;
  for (const double e : {0.0, 0.1, 0.3, 0.7})
    for (const int count : {2, 3})
      for (const double first : {0.0, 1.0, 3.0}) {
        const KeplerRows rows(e);
        const auto orbit = [&](double step) {
          return TableOrbit(rows.at(even_times(first, step, count), true));
        };
        // 0.0108 rad: 10 s of a low orbit
        for (const double step : {0.0108, 0.05, 0.2, 0.5}) {
          const double error = rows.error(orbit(step));
          const double estimate = interpolation_error(orbit(step));
          EXPECT_GT(estimate, budget::table_orbit_estimate_least * error) << e << step;
          EXPECT_LT(estimate, budget::table_orbit_estimate_most * error) << e << step;
        }
        // after whole revolutions the rows agree
        for (const double step : {3.2, 5.4, turn, 1.001 * turn, 2.0 * turn})
          EXPECT_GT(interpolation_error(orbit(step)), budget::table_orbit_estimate_coarse)
              << e << step;
      }
  const PositionTable lines{{0, 1, 2}, {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}}};
  EXPECT_TRUE(std::isnan(interpolation_error(TableOrbit(lines, 2))));
}

TEST(TableOrbit, AsManyRowsAsTheOrderNeedsAreEnough) {
  EXPECT_EQ(TableOrbit(sampled(even_times(0, 1, 8), wave, wave_slope, false), 8).order(), 8);
  EXPECT_EQ(TableOrbit(sampled(even_times(0, 1, 4), wave, wave_slope, true), 8).order(), 8);
  EXPECT_THROW(TableOrbit(sampled(even_times(0, 1, 7), wave, wave_slope, false), 8), DomainError);
  EXPECT_THROW(TableOrbit(sampled(even_times(0, 1, 3), wave, wave_slope, true), 8), DomainError);
}

TEST(TableOrbit, FewRowsMakeALowOrder) {
  EXPECT_EQ(TableOrbit(sampled(even_times(0, 1, 5), wave, wave_slope, false)).order(), 4);
  EXPECT_EQ(TableOrbit(sampled(even_times(0, 1, 50), wave, wave_slope, false)).order(), 10);
  EXPECT_EQ(TableOrbit(sampled(even_times(0, 1, 50), wave, wave_slope, true)).order(), 12);
  EXPECT_TRUE(
      TableOrbit(sampled(even_times(1e9, 0.1, 50), wave, wave_slope, true)).is_evenly_spaced());
  EXPECT_FALSE(
      TableOrbit(sampled(uneven_times(0, 1, 50), wave, wave_slope, true)).is_evenly_spaced());
}

}  // namespace
}  // namespace polhode
