// SPDX-License-Identifier: MIT
// [orbit.NAME] from the positions of Sun, Moon and planets: tabulated once, over the run.
#include "polhode/ephemeris/ephemeris.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "scenario/detail/built_in_kinds.hpp"
#include "scenario/detail/clock.hpp"
#include "scenario/detail/reference_axes.hpp"
#include "scenario/kinds/orbits/shared_keys.hpp"
#include "scenario/tables/head.hpp"
#include "text/number_text.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

struct Arguments {
  std::optional<double> gm;
  std::string target, centre;
};

template <auto at>
consteval KindKey<Arguments> body_key(std::string_view name, std::string_view help) {
  return word_key<at>(name, "sun|mercury|venus|earth|moon|mars|jupiter|saturn|uranus|neptune", help)
      .required();
}

constexpr KindKey<Arguments> keys[] = {
    orbit_gm_key<&Arguments::gm>(),
    body_key<&Arguments::target>(
        "target",
        "The body whose positions these are, from 1000 to 3000. It needs `state.epoch`, "
        "`state.axes` of J2000, a unit of length, and [time].")
        .example("\"moon\""),
    body_key<&Arguments::centre>("centre", "The body it is seen from, without light time.")
        .example("\"earth\""),
};

// Beyond the run on either side, s: what rounds a time must not leave the table.
constexpr double margin = 60.0, day = 86400.0;

// What one km is in core units; the place of `target` says what is missing.
double kilometre(const OrbitContext& at) {
  const Units& units = at.units();
  if (units.length() == "1")
    at.refuse("target", "expected a unit of length such as units.length = \"km\"");
  return units.to_core(1.0, "km", Dimension::length);
}

// Whose motions they are made of: the Moon's is about the Earth, all others are about the Sun.
std::vector<std::string> sources_of(ephemeris::Planetary target, ephemeris::Planetary centre) {
  const auto is = [&](ephemeris::Planetary body) { return target == body || centre == body; };
  std::vector<std::string> sources{"ephemeris"};
  if (is(ephemeris::Planetary::moon)) sources.push_back("moon");
  if (is(ephemeris::Planetary::moon) != is(ephemeris::Planetary::earth)) sources.push_back("earth");
  for (const ephemeris::Planetary body : {target, centre})
    if (body != ephemeris::Planetary::sun && body != ephemeris::Planetary::earth &&
        body != ephemeris::Planetary::moon)
      sources.push_back("planet");
  return sources;
}

// Where the run leaves the years for which the theories were compared: "; outside 1900 to 2100, off
// by up to some 12 arcsec".
std::string note_of_years(ephemeris::Planetary target, ephemeris::Planetary centre,
                          const Clock& clock, const TimeSpan& span) {
  const ephemeris::PlanetaryYears best = ephemeris::best_years(target, centre);
  const auto january = [](int year) {
    return ephemeris::calendar_date(ephemeris::TimeScale::TT, {.year = year});
  };
  const auto at = [&](double t) { return ephemeris::date_after(clock.epoch, t / clock.second); };
  if (ephemeris::seconds_between(january(best.first), at(span.first)) >= 0.0 &&
      ephemeris::seconds_between(at(span.last), january(best.last + 1)) >= 0.0)
    return {};
  // planets come near, for a month or two
  constexpr double look_s = 20.0 * 86400.0;
  const double looks =
      std::clamp(std::ceil((span.last - span.first) / clock.second / look_s), 16.0, 4000.0);
  double worst = 0.0;
  for (double k = 0.0; k <= looks; ++k)
    worst = std::max(
        worst, ephemeris::planetary_error(target, centre,
                                          at(span.first + (k / looks) * (span.last - span.first))));
  return "; outside " + std::to_string(best.first) + " to " + std::to_string(best.last) +
         ", off by up to some " + polhode::detail::number_text(std::ceil(worst)) + " arcsec";
}

ScenarioOrbit made(const Arguments& a, const OrbitContext& at) {
  const ephemeris::Planetary target = *ephemeris::planetary(a.target),
                             centre = *ephemeris::planetary(a.centre);
  if (target == centre) at.refuse("centre", "expected another body than the target");
  const std::string axes = at.state_axes();
  if (axes == "inertial")
    at.refuse("target",
              "expected state.axes = \"ecliptic-J2000\" or \"equator-J2000\", since this orbit has "
              "a place in the sky");
  const Clock clock = clock_of(at.file_values(), at.key_path("target"));
  const double km = kilometre(at);
  const std::optional<TimeSpan> span = at.run_span();
  if (!span)
    at.refuse("target", "expected a table [time], since the positions are tabulated over the run");
  // light that is fitted or simulated arrives later than it leaves, by less than a day within the
  // planets
  const double light = head_table(at.file_values())->kind == "fit" ? day : margin;
  const ephemeris::EphemerisTable table = at.built("target", [&] {
    return ephemeris::planetary_table(target, centre, clock.epoch,
                                      span->first / clock.second - light,
                                      span->last / clock.second + light);
  });
  PositionTable rows = table.rows;
  for (double& t : rows.times) t *= clock.second;
  for (Vec3& x : rows.positions) x = km * in_other_axes(x, "equator-J2000", axes);
  const std::optional<double> own = positive_gm(at, a.gm);
  std::vector<std::string> sources = sources_of(target, centre);
  if (!own) sources.push_back("DE440");
  return {
      {},
      TableOrbit(std::move(rows), table.order),
      own ? own : at.units().to_core(ephemeris::planetary_gm(target), "km3/s2", Dimension::gm),
      std::move(sources),
      "ephemeris, " + a.target + " from " + a.centre + note_of_years(target, centre, clock, *span)};
}

}  // namespace

OrbitKind ephemeris_kind() {
  OrbitKind kind = orbit_kind<Arguments>(
      "ephemeris", "Sun, Moon and planets as they move (docs/guide/orbits.md).", keys, made);
  kind.is_dated = true;
  return kind;
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
