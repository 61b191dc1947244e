// SPDX-License-Identifier: MIT
#include "polhode/ephemeris/ephemeris.hpp"

#include <erfa.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace {

constexpr double au_km = 149597870.7;  // IAU 2012
constexpr double day_in_s = 86400.0;
constexpr int table_order = 12;
constexpr std::size_t most_rows = 20'000'000;  // some 500 MB

struct Entry {
  std::string_view name;
  int of_plan94;     // its number of the planet
  double gm;         // km^3/s^2, DE440
  double first_day;  // spacing that is tried first, in days
  // arcsec: at most in the years from `first_year` to 2100, and in all
  double best_error;
  double far_error;
  int first_year;
};
// Park et al. (2021), table 2; errors as ERFA states them, and in all years as they are against
// DE406 (docs/guide/orbits.md).
constexpr std::array<Entry, 10> entries = {
    {{"sun", 0, 132712440041.279419, 8.0, 0.0, 0.0, 1000},
     {"mercury", 1, 22031.868551, 2.0, 7.1, 7.1, 1800},
     {"venus", 2, 324858.592000, 4.0, 7.1, 7.8, 1800},
     {"earth", 0, 398600.435507, 8.0, 0.02, 0.02, 1900},
     {"moon", 0, 4902.800118, 1.0, 18.3, 25.0, 1950},
     {"mars", 4, 42828.375816, 8.0, 26.5, 41.0, 1800},
     {"jupiter", 5, 126712764.100000, 16.0, 78.3, 79.0, 1800},
     {"saturn", 6, 37940584.841800, 16.0, 88.2, 131.0, 1800},
     {"uranus", 7, 5794556.400000, 16.0, 86.5, 112.0, 1800},
     {"neptune", 8, 6836527.100580, 16.0, 11.5, 46.0, 1800}}};

const Entry& entry(Planetary body) { return entries[static_cast<std::size_t>(body)]; }

[[noreturn]] void fail(const char* function, const std::string& what) {
  throw DomainError(std::string(function) + ": " + what);
}

void require_two(const char* function, Planetary target, Planetary centre) {
  if (target == centre)
    fail(function, "target and centre must not both be " + std::string(entry(target).name));
}

// From J2000.
double centuries(const Date& tdb) { return ((tdb.day - 2451545.0) + tdb.fraction) / 36525.0; }

// What plan94 is meant for; the Moon and the Earth as far as they were compared with something.
void require_years(const Date& tdb) {
  if (!(std::fabs(centuries(tdb)) <= 10.0))
    fail("planetary_position", "date JD " + detail::number_text(tdb.day + tdb.fraction) +
                                   " must be in the years 1000 to 3000");
}

using Posvel = std::array<std::array<double, 3>, 2>;
double (*rows(Posvel& pv))[3] { return reinterpret_cast<double(*)[3]>(pv.data()); }

Vec3 km(const Posvel& pv) { return {au_km * pv[0][0], au_km * pv[0][1], au_km * pv[0][2]}; }

Vec3 earth_from_sun(const Date& tdb) {
  Posvel heliocentric{}, barycentric{};
  eraEpv00(tdb.day, tdb.fraction, rows(heliocentric), rows(barycentric));  // 1: not 1900 to 2100
  return km(heliocentric);
}

// TT and TDB are the same here: 2 ms are 2 m.
Vec3 moon_from_earth(const Date& tdb) {
  Posvel pv{};
  eraMoon98(tdb.day, tdb.fraction, rows(pv));
  return km(pv);
}

Vec3 from_sun(Planetary body, const Date& tdb) {
  if (body == Planetary::sun) return {};
  if (body == Planetary::earth) return earth_from_sun(tdb);
  if (body == Planetary::moon) return earth_from_sun(tdb) + moon_from_earth(tdb);
  Posvel pv{};
  const int status = eraPlan94(tdb.day, tdb.fraction, entry(body).of_plan94, rows(pv));
  if (status != 0 && status != 1)
    fail("planetary_position", "no position of " + std::string(entry(body).name));
  return km(pv);
}

bool is_moon_and_earth(Planetary a, Planetary b) {
  return a == Planetary::moon && b == Planetary::earth;
}

Vec3 position_at(Planetary target, Planetary centre, const Date& tdb) {
  require_years(tdb);
  if (is_moon_and_earth(target, centre) || is_moon_and_earth(centre, target)) {
    const Vec3 x = moon_from_earth(tdb);
    return target == Planetary::moon ? x : -x;
  }
  return from_sun(target, tdb) - from_sun(centre, tdb);
}

struct Span {
  Planetary target;
  Planetary centre;
  Date epoch;  // TT
  double first;
  double last;

  // `t` s after the epoch
  Vec3 at(double t) const {
    return position_at(target, centre, converted(date_after(epoch, t), TimeScale::TDB));
  }
  PositionTable rows(std::size_t count) const {
    PositionTable table;
    const double step = (last - first) / static_cast<double>(count - 1);
    for (std::size_t k = 0; k < count; ++k) {
      table.times.push_back(k + 1 == count ? last : first + static_cast<double>(k) * step);
      table.positions.push_back(at(table.times.back()));
    }
    return table;
  }
};

// The largest difference between rows, relative to the distance, and in km: in the middle of
// windows all along, the first and the last among them, where the polynomial is one-sided.
struct Misfit {
  double relative = 0.0;
  double km = 0.0;
};
Misfit misfit(const Span& span, const TableOrbit& orbit) {
  constexpr std::size_t probes = 40;
  const std::vector<double>& t = orbit.table().times;
  const std::size_t intervals = t.size() - 1;
  Misfit worst;
  for (std::size_t i = 0; i < probes; ++i) {
    const std::size_t k = intervals <= probes ? i % intervals : i * (intervals - 1) / (probes - 1);
    const double middle = 0.5 * (t[k] + t[k + 1]);
    const Vec3 truth = span.at(middle);
    const double apart = norm(orbit.position(middle) - truth);
    worst = {std::max(worst.relative, apart / norm(truth)), std::max(worst.km, apart)};
  }
  return worst;
}

}  // namespace

std::string_view name(Planetary body) { return entry(body).name; }

std::string_view planetary_names() {
  return "sun|mercury|venus|earth|moon|mars|jupiter|saturn|uranus|neptune";
}

std::optional<Planetary> planetary(std::string_view name) {
  for (std::size_t k = 0; k < entries.size(); ++k)
    if (entries[k].name == name) return static_cast<Planetary>(k);
  return std::nullopt;
}

double planetary_gm(Planetary body) { return entry(body).gm; }

PlanetaryYears best_years(Planetary target, Planetary centre) {
  return {std::max(entry(target).first_year, entry(centre).first_year), 2100};
}

namespace {

// Seen from the Sun, of the Moon from the Earth.
double own_error(Planetary body, double T) {
  constexpr double growth = 0.009;  // of the Earth's, arcsec a century squared
  const double year = 2000.0 + 100.0 * T;
  const Entry& of = entry(body);
  if (year >= of.first_year && year <= 2100.0) return of.best_error;
  return body == Planetary::earth ? of.far_error + growth * T * T : of.far_error;
}

}  // namespace

double planetary_error(Planetary target, Planetary centre, const Date& date) {
  require_two("planetary_error", target, centre);
  const Date tdb = converted(date, TimeScale::TDB);
  const double T = centuries(tdb);
  if (!(std::fabs(T) <= 10.0)) return std::numeric_limits<double>::quiet_NaN();
  if (is_moon_and_earth(target, centre) || is_moon_and_earth(centre, target))
    return own_error(Planetary::moon, T);
  // arcsec of a body's own distance make a length, whichever place it is seen from
  const auto length = [&](Planetary body) {
    if (body != Planetary::moon) return own_error(body, T) * norm(from_sun(body, tdb));
    return own_error(Planetary::earth, T) * norm(earth_from_sun(tdb)) +
           own_error(body, T) * norm(moon_from_earth(tdb));
  };
  return (length(target) + length(centre)) / norm(position_at(target, centre, tdb));
}

Vec3 planetary_position(Planetary target, Planetary centre, const Date& date) {
  require_two("planetary_position", target, centre);
  return position_at(target, centre, converted(date, TimeScale::TDB));
}

// Half the spacing until the rows are dense enough, or until it no longer helps: then what is left
// is rounding.
EphemerisTable planetary_table(Planetary target, Planetary centre, const Date& epoch, double first,
                               double last, double tolerance) {
  planetary_position(target, centre, epoch);  // refuses
  if (!(first < last) || !std::isfinite(last - first))
    fail("planetary_table",
         "times " + detail::tuple_text({first, last}) + " must rise and be finite");
  const Span span{target, centre, converted(epoch, TimeScale::TT), first, last};
  const double length = (last - first) / day_in_s;
  double spacing = std::min(entry(target).first_day, entry(centre).first_day);
  EphemerisTable best{};
  double least = 0.0;
  for (;;) {
    const double needed = std::ceil(length / spacing) + 1.0;
    if (needed > static_cast<double>(most_rows))
      fail("planetary_table", "a span of " + detail::number_text(length) +
                                  " days must have at most " + std::to_string(most_rows) + " rows");
    const auto count = std::max(static_cast<std::size_t>(needed), std::size_t{table_order});
    PositionTable rows = span.rows(count);
    const Misfit worst = misfit(span, TableOrbit(rows, table_order));
    const bool better = best.rows.times.empty() || worst.relative < 0.5 * least;
    if (better) {
      best = {std::move(rows), worst.km, table_order};
      least = worst.relative;
    }
    if (least <= tolerance || !better) return best;
    spacing *= 0.5;
  }
}

}  // namespace v0
}  // namespace polhode
