// SPDX-License-Identifier: MIT
// Dates and positions of the Sun, the Moon and planets: time per call. A position has no error of
// its own to show (that of its theory stands in the header); a table of positions has, in km and of
// the distance. Dates: what a change of scale and back loses, in s.
#include "polhode/ephemeris/ephemeris.hpp"

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>

#include "worst.hpp"

namespace {

using namespace polhode;
using polhode::test::Worst;

constexpr double day = 86400.0;
const ephemeris::Date epoch = ephemeris::calendar_date(ephemeris::TimeScale::TT, {2020, 2, 3});

ephemeris::Date days_after(ephemeris::TimeScale scale, double days) {
  return {scale, epoch.day, epoch.fraction + days};
}

// Arguments: from and to, as in TimeScale.
void date_conversion(benchmark::State& state) {
  const auto from = static_cast<ephemeris::TimeScale>(state.range(0));
  const auto to = static_cast<ephemeris::TimeScale>(state.range(1));
  Worst worst;
  double days = 0.0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(ephemeris::converted(days_after(from, days), to));
    days += 0.01;
  }
  for (int i = 0; i < 256; ++i) {
    const ephemeris::Date date = days_after(from, 5.1 * i),
                          back = ephemeris::converted(ephemeris::converted(date, to), from);
    worst.add(std::fabs(ephemeris::seconds_between(date, back)));
  }
  state.counters["error"] = worst.value();
}

void date_of_calendar(benchmark::State& state) {
  double second = 0.0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        ephemeris::calendar_date(ephemeris::TimeScale::UTC, {2020, 2, 3, 4, 5, second}));
    second = second < 59.0 ? second + 0.37 : 0.0;
  }
}

// Arguments: target and centre, as in Planetary.
void position(benchmark::State& state) {
  const auto target = static_cast<ephemeris::Planetary>(state.range(0));
  const auto centre = static_cast<ephemeris::Planetary>(state.range(1));
  double days = 0.0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        ephemeris::planetary_position(target, centre, days_after(ephemeris::TimeScale::TT, days)));
    days += 0.01;
  }
}

// A position of the Moon or the Sun from a table of a year; the error is that between rows.
void position_from_table(benchmark::State& state) {
  const auto target = static_cast<ephemeris::Planetary>(state.range(0));
  const double span = 365.25 * day;
  const ephemeris::EphemerisTable table =
      ephemeris::planetary_table(target, ephemeris::Planetary::earth, epoch, 0.0, span);
  const TableOrbit orbit(table.rows, table.order);
  Worst worst;
  double t = 0.0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(orbit.position(t));
    t = t < span - 60.0 ? t + 60.0 : 0.0;
  }
  for (int i = 0; i < 64; ++i) {
    const double at = 1.37 * day + 5.6789 * day * i;
    const Vec3 x = ephemeris::planetary_position(target, ephemeris::Planetary::earth,
                                                 ephemeris::date_after(epoch, at));
    worst.add(norm(orbit.position(at) - x) / norm(x));
  }
  state.counters["error"] = worst.value();
  state.counters["km"] = table.error;
  state.counters["rows"] = static_cast<double>(table.rows.times.size());
}

void tabulate_a_year(benchmark::State& state) {
  const auto target = static_cast<ephemeris::Planetary>(state.range(0));
  for (auto _ : state)
    benchmark::DoNotOptimize(
        ephemeris::planetary_table(target, ephemeris::Planetary::earth, epoch, 0.0, 365.25 * day)
            .error);
}

void teme_axes(benchmark::State& state) {
  double days = 0.0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        ephemeris::j2000_from_teme(days_after(ephemeris::TimeScale::UTC, days)));
    days += 0.01;
  }
}

constexpr auto moon = static_cast<std::int64_t>(ephemeris::Planetary::moon);
constexpr auto sun = static_cast<std::int64_t>(ephemeris::Planetary::sun);
constexpr auto earth = static_cast<std::int64_t>(ephemeris::Planetary::earth);
constexpr auto mars = static_cast<std::int64_t>(ephemeris::Planetary::mars);
constexpr auto utc = static_cast<std::int64_t>(ephemeris::TimeScale::UTC);
constexpr auto tt = static_cast<std::int64_t>(ephemeris::TimeScale::TT);
constexpr auto tdb = static_cast<std::int64_t>(ephemeris::TimeScale::TDB);

BENCHMARK(date_conversion)->Args({utc, tt})->Args({tt, tdb});
BENCHMARK(date_of_calendar);
BENCHMARK(position)
    ->Args({moon, earth})
    ->Args({sun, earth})
    ->Args({mars, sun})
    ->Args({mars, earth})
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(position_from_table)->Arg(moon)->Arg(sun);
BENCHMARK(tabulate_a_year)->Arg(moon)->Arg(sun)->Unit(benchmark::kMillisecond);
BENCHMARK(teme_axes)->Unit(benchmark::kMicrosecond);

}  // namespace
