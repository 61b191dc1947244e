// SPDX-License-Identifier: MIT
#include "polhode/ephemeris/ephemeris.hpp"

#include <erfa.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace ephemeris {
namespace {

constexpr double astronomical_unit = 149597870.7;  // IAU 2012
constexpr double day = 86400.0;
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

[[noreturn]] void refuse(const char* function, const std::string& what) {
  throw DomainError(std::string(function) + ": " + what);
}

void require_two(const char* function, Planetary target, Planetary centre) {
  if (target == centre)
    refuse(function, "target and centre must not both be " + std::string(entry(target).name));
}

// From J2000.
double centuries(const Date& tdb) { return ((tdb.day - 2451545.0) + tdb.fraction) / 36525.0; }

// What plan94 is meant for; the Moon and the Earth as far as they were compared with something.
void require_years(const Date& tdb) {
  if (!(std::fabs(centuries(tdb)) <= 10.0))
    refuse("planetary_position", "date JD " + polhode::detail::number_text(tdb.day + tdb.fraction) +
                                     " must be in the years 1000 to 3000");
}

using Posvel = std::array<std::array<double, 3>, 2>;
double (*rows(Posvel& pv))[3] { return reinterpret_cast<double(*)[3]>(pv.data()); }

Vec3 km(const Posvel& pv) {
  return {astronomical_unit * pv[0][0], astronomical_unit * pv[0][1], astronomical_unit * pv[0][2]};
}

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
    refuse("planetary_position", "no position of " + std::string(entry(body).name));
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
  Date tt(double t) const { return date_after(epoch, t); }
  Vec3 at(double t) const { return position_at(target, centre, converted(tt(t), TimeScale::TDB)); }
};

// TDB - TT from one number a day: its 787 terms cost three times what a position of the Moon does,
// and the fastest of them take days. To 2e-16 s, where a date is known to 1e-11 s.
class DailyExcess {
 public:
  explicit DailyExcess(const Span& span)
      : first_(std::floor(span.tt(span.first).day) - beside), table_(table_of(span, first_)) {}

  Date tdb(const Date& tt) const {
    Date result{TimeScale::TDB, 0.0, 0.0};
    const double excess = table_.position((tt.day - first_) + tt.fraction).x;
    eraTttdb(tt.day, tt.fraction, excess, &result.day, &result.fraction);  // 0, always
    return result;
  }
  static std::size_t days(const Span& span) {
    const double whole = std::floor(span.tt(span.last).day) - std::floor(span.tt(span.first).day);
    return static_cast<std::size_t>(whole) + 2 * beside;
  }

 private:
  static constexpr int order = 16, beside = order / 2 + 1;

  static TableOrbit table_of(const Span& span, double first) {
    PositionTable daily;
    for (std::size_t k = 0; k < days(span); ++k) {
      daily.times.push_back(static_cast<double>(k));
      daily.positions.push_back({eraDtdb(first, static_cast<double>(k), 0.0, 0.0, 0.0, 0.0)});
    }
    return TableOrbit(std::move(daily), order);
  }

  double first_;
  TableOrbit table_;
};

// The largest difference between rows, relative to the distance, and in km.
struct Misfit {
  double relative = 0.0;
  double km = 0.0;
};

// Rows at even steps, of which only those are asked for that somebody needs.
class Rows {
 public:
  Rows(const Span& span, std::size_t count) : span_(span), known_(count, false) {
    const double step = (span.last - span.first) / static_cast<double>(count - 1);
    for (std::size_t k = 0; k < count; ++k)
      table_.times.push_back(k + 1 == count ? span.last
                                            : span.first + static_cast<double>(k) * step);
    table_.positions.resize(count);
  }

  // In the middle of windows all along, the first and the last among them, where the polynomial is
  // one-sided.
  Misfit misfit() {
    constexpr std::size_t probes = 40;
    const std::vector<double>& t = table_.times;
    const std::size_t intervals = t.size() - 1;
    std::array<std::size_t, probes> rows{};
    for (std::size_t i = 0; i < probes; ++i) {
      rows[i] = intervals <= probes ? i % intervals : i * (intervals - 1) / (probes - 1);
      find_around(rows[i]);
    }
    const TableOrbit orbit(table_, table_order);
    Misfit worst;
    for (const std::size_t k : rows) {
      const double middle = 0.5 * (t[k] + t[k + 1]);
      const Vec3 truth = span_.at(middle);
      const double apart = norm(orbit.position(middle) - truth);
      worst = {std::max(worst.relative, apart / norm(truth)), std::max(worst.km, apart)};
    }
    return worst;
  }

  PositionTable all() && {
    if (known_.size() > 3 * DailyExcess::days(span_) / 2) {
      const DailyExcess excess(span_);
      find(0, known_.size(), [&](double t) {
        return position_at(span_.target, span_.centre, excess.tdb(span_.tt(t)));
      });
    } else {
      find(0, known_.size(), [&](double t) { return span_.at(t); });
    }
    return std::move(table_);
  }

 private:
  template <class At>
  void find(std::size_t first, std::size_t end, const At& at) {
    for (std::size_t k = first; k < end; ++k) {
      if (known_[k]) continue;
      table_.positions[k] = at(table_.times[k]);
      known_[k] = true;
    }
  }
  // What the polynomial in the interval after row k goes through, and a row on either side.
  void find_around(std::size_t k) {
    constexpr std::size_t window = table_order, before = window / 2;
    const std::size_t first = std::min(k > before ? k - before : 0, known_.size() - window);
    find(first, std::min(first + window + 2, known_.size()), [&](double t) { return span_.at(t); });
  }

  Span span_;
  PositionTable table_;
  std::vector<bool> known_;
};

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
    refuse("planetary_table",
           "times " + polhode::detail::tuple_text({first, last}) + " must rise and be finite");
  const Span span{target, centre, converted(epoch, TimeScale::TT), first, last};
  const double length = (last - first) / day;
  double spacing = std::min(entry(target).first_day, entry(centre).first_day);
  std::optional<Rows> best;
  Misfit least;
  for (;;) {
    const double needed = std::ceil(length / spacing) + 1.0;
    if (needed > static_cast<double>(most_rows))
      refuse("planetary_table", "a span of " + polhode::detail::number_text(length) +
                                    " days must have at most " + std::to_string(most_rows) +
                                    " rows");
    const auto count = std::max(static_cast<std::size_t>(needed), std::size_t{table_order});
    Rows rows(span, count);
    const Misfit worst = rows.misfit();
    const bool better = !best || worst.relative < 0.5 * least.relative;
    if (better) {
      best = std::move(rows);
      least = worst;
    }
    if (least.relative <= tolerance || !better)
      return {std::move(*best).all(), least.km, table_order};
    spacing *= 0.5;
  }
}

}  // namespace ephemeris
}  // namespace v0
}  // namespace polhode
