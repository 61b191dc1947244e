// SPDX-License-Identifier: MIT
// [orbit.NAME] from the positions of Sun, Moon and planets: tabulated once, over the run.
#include <algorithm>
#include <cmath>

#include "polhode/ephemeris/ephemeris.hpp"
#include "polhode/scenario/schema.hpp"
#include "scenario/detail/clock.hpp"
#include "scenario/detail/orbit_kinds.hpp"
#include "scenario/detail/reference_axes.hpp"
#include "scenario/value_access.hpp"
#include "scenario/values.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

// Beyond the run on either side, s: what rounds a time must not leave the table.
constexpr double margin = 60.0;

// What one km is in core units; the place of `target` says what is missing.
double kilometre(const OrbitContext& at) {
  const Units& units = at.file.units;
  if (units.length() == "1")
    refuse(at.values(), at.key("target"), at.name(),
           "expected a unit of length such as units.length = \"km\"");
  return units.to_core(1.0, "km", Dimension::length);
}

// Whose motions they are made of: the Moon's is about the Earth, all others are about the Sun.
std::vector<std::string> sources_of(Planetary target, Planetary centre) {
  const auto is = [&](Planetary body) { return target == body || centre == body; };
  std::vector<std::string> sources{"ephemeris"};
  if (is(Planetary::moon)) sources.push_back("moon");
  if (is(Planetary::moon) != is(Planetary::earth)) sources.push_back("earth");
  for (const Planetary body : {target, centre})
    if (body != Planetary::sun && body != Planetary::earth && body != Planetary::moon)
      sources.push_back("planet");
  return sources;
}

}  // namespace

ScenarioOrbit ephemeris_orbit(const OrbitContext& at) {
  const Values& values = at.values();
  const std::string target_key = at.key("target"), centre_key = at.key("centre");
  const Planetary target = *planetary(word(values, target_key));
  const Planetary centre = *planetary(word(values, centre_key));
  if (target == centre)
    refuse(values, centre_key, at.name(), "expected another body than the target");
  const std::string& axes = word(values, "state.axes");
  if (axes == "inertial")
    refuse(values, target_key, at.name(),
           "expected state.axes = \"ecliptic-J2000\" or \"equator-J2000\", since this orbit has a "
           "place in the sky");
  const Clock clock = clock_of(values, at.file.units, target_key, at.name());
  const double km = kilometre(at);
  const std::optional<TimeSpan> span = run_span(at);
  if (!span)
    refuse(values, target_key, at.name(),
           "expected a table [time], since the positions are tabulated over the run");
  const EphemerisTable table = built(values, target_key, at.name(), [&] {
    return planetary_table(target, centre, clock.epoch, span->first / clock.second - margin,
                           span->last / clock.second + margin);
  });
  PositionTable rows = table.rows;
  for (double& t : rows.times) t *= clock.second;
  for (Vec3& x : rows.positions) x = km * in_other_axes(x, "equator-J2000", axes);
  const std::optional<double> own = own_gm(at);
  std::vector<std::string> sources = sources_of(target, centre);
  if (!own) sources.push_back("DE440");
  return {std::string(key_name(at.path)), TableOrbit(std::move(rows), table.order),
          own ? own : at.file.units.to_core(planetary_gm(target), "km3/s2", Dimension::gm),
          std::move(sources),
          "ephemeris, " + word(values, target_key) + " from " + word(values, centre_key)};
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
