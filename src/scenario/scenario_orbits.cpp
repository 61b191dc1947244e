// SPDX-License-Identifier: MIT
// From the values of a file to its orbits.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "polhode/orbit/any_orbit.hpp"
#include "polhode/scenario/schema.hpp"
#include "scenario/detail/orbit_kinds.hpp"
#include "scenario/scenario_parts.hpp"
#include "scenario/value_access.hpp"
#include "scenario/values.hpp"
#include "text/nearest.hpp"
#include "text/word_list.hpp"

namespace polhode {
inline namespace v0 {

const KeplerElements* kepler_elements(const ScenarioOrbit& orbit) {
  if (const auto* fixed = std::get_if<KeplerOrbit>(&orbit.motion)) return &fixed->elements();
  if (const auto* moving = std::get_if<PrecessingKeplerOrbit>(&orbit.motion))
    return &moving->elements();
  return nullptr;
}

AnyOrbit any_orbit(const ScenarioOrbit& orbit) {
  return std::visit([&](const auto& motion) { return AnyOrbit(orbit.name, motion); }, orbit.motion);
}

namespace detail {
namespace {

KeplerElements elements_of(const Values& values, const std::string& path, const std::string& name) {
  const auto key = [&](const char* own) { return path + "." + own; };
  const double gm = number(values, key("gm")), e = number(values, key("eccentricity"));
  if (!(gm > 0.0)) refuse(values, key("gm"), name, "expected a positive gravitational parameter");
  if (!(e >= 0.0) || e == 1.0)
    refuse(values, key("eccentricity"), name,
           "expected 0 <= e < 1 (an ellipse) or e > 1 (a hyperbola); at e = 1 use a number next to "
           "it, with the same pericentre");
  const bool by_axis = has(values, key("semi_major_axis"));
  const bool by_period = has(values, key("period"));
  const std::string size_key = key(by_axis     ? "semi_major_axis"
                                   : by_period ? "period"
                                               : "pericentre");
  const double size = number(values, size_key);
  if (!(size > 0.0))
    refuse(values, size_key, name,
           by_period ? "expected a positive time" : "expected a positive length");
  if ((by_axis || by_period) && e > 1.0)
    refuse(values, size_key, name, "expected pericentre instead, since e > 1 is a hyperbola");
  const double turn = size / (2.0 * std::numbers::pi);
  const double axis = by_period ? std::cbrt(gm * turn * turn) : size;
  return {.gm = gm,
          .pericentre = by_axis || by_period ? pericentre_distance(axis, e) : size,
          .eccentricity = e,
          .inclination = number(values, key("inclination")),
          .node = number(values, key("node")),
          .argument = number(values, key("pericentre_argument")),
          .mean_anomaly = number(values, key("mean_anomaly")),
          .epoch = number(values, key("epoch"))};
}

}  // namespace

std::optional<double> own_gm(const OrbitContext& at) {
  const std::string key = at.key("gm");
  if (!has(at.values(), key)) return std::nullopt;
  const double gm = number(at.values(), key);
  if (!(gm > 0.0))
    refuse(at.values(), key, at.name(), "expected a positive gravitational parameter");
  return gm;
}

std::optional<TimeSpan> run_span(const OrbitContext& at) {
  at.uses.time = true;
  if (!at.file.time) return std::nullopt;
  TimeSpan span;
  const SaveAt& rows = *at.file.time;
  const bool listed = has(at.values(), "time.at");  // in any order
  for (std::int64_t k = 0; k < rows.size(); k = listed ? k + 1 : k + rows.size() - 1) {
    span = {std::min(span.first, rows[k]), std::max(span.last, rows[k])};
    if (rows.size() == 1) break;
  }
  return span;
}

ScenarioOrbit kepler_orbit(const OrbitContext& at) {
  const Values& values = at.values();
  const std::string &path = at.path, &name = at.name();
  const KeplerElements elements = elements_of(values, path, name);
  const SecularRates rates{.node = number(values, path + ".node_rate"),
                           .argument = number(values, path + ".pericentre_rate"),
                           .mean_anomaly = number(values, path + ".mean_anomaly_rate")};
  const PrecessingKeplerOrbit moving =
      built(values, path, name, [&] { return PrecessingKeplerOrbit(elements, rates); });
  return precessing_orbit(at, moving);
}

ScenarioOrbit precessing_orbit(const OrbitContext& at, const PrecessingKeplerOrbit& orbit) {
  const std::string own(key_name(at.path));
  const std::string &axes = orbit_axes(at), &of_state = word(at.values(), "state.axes");
  if (axes != of_state) {
    return {own,
            of_state == "ecliptic-J2000" ? TurnedKeplerOrbit::from_equator(orbit)
                                         : TurnedKeplerOrbit::from_ecliptic(orbit),
            orbit.gm()};
  }
  if (orbit.rates() == SecularRates{}) return {own, KeplerOrbit(orbit.elements()), orbit.gm()};
  return {own, orbit, orbit.gm()};
}

std::string did_you_mean(std::string_view word, std::span<const std::string_view> known) {
  const std::string_view near = nearest(word, known);
  return near.empty() ? "" : "; did you mean " + std::string(near) + "?";
}

const ScenarioOrbit& orbit_named(const std::vector<ScenarioOrbit>& orbits, const Values& values,
                                 const std::string& path, const std::string& name) {
  const std::string& wanted = word(values, path);
  std::vector<std::string_view> known;
  for (const ScenarioOrbit& orbit : orbits) {
    if (orbit.name == wanted) return orbit;
    known.push_back(orbit.name);
  }
  if (known.empty()) refuse(values, path, name, "expected a table [orbit." + wanted + "]");
  refuse(
      values, path, name,
      "expected the name of an orbit of this file: " + one_of(known) + did_you_mean(wanted, known));
}

std::vector<std::string> orbit_paths(const Values& values) {
  std::vector<std::string> paths;
  for (const auto& [path, value] : values)
    if (value.key->path == "orbit.*") paths.push_back(path);
  return paths;
}

ScenarioOrbit orbit_of(const OrbitsContext& at, const std::string& path, OrbitUses& uses) {
  const std::string& kind = word(at.values, path + ".kind");
  const OrbitContext place{at, path, uses};
  return kind == "kepler"  ? kepler_orbit(place)
         : kind == "state" ? state_orbit(place)
         : kind == "table" ? table_orbit(place)
                           : ephemeris_orbit(place);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
