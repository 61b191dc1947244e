// SPDX-License-Identifier: MIT
// From the values of a file to its orbits.
#include <algorithm>
#include <optional>
#include <stdexcept>

#include "polhode/orbit/any_orbit.hpp"
#include "polhode/scenario/kinds.hpp"
#include "polhode/scenario/schema.hpp"
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

std::optional<double> OrbitContext::gm() const {
  if (!has("gm")) return std::nullopt;
  const double gm = number("gm");
  if (!(gm > 0.0)) refuse("gm", "expected a positive gravitational parameter");
  return gm;
}

const std::string& OrbitContext::state_axes() const { return detail::word(values(), "state.axes"); }

std::optional<TimeSpan> OrbitContext::run_span() const {
  uses_.time = true;
  if (!rows_) return std::nullopt;
  TimeSpan span;
  const SaveAt& rows = *rows_;
  const bool listed = detail::has(values(), "time.at");  // in any order
  for (std::int64_t k = 0; k < rows.size(); k = listed ? k + 1 : k + rows.size() - 1) {
    span = {std::min(span.first, rows[k]), std::max(span.last, rows[k])};
    if (rows.size() == 1) break;
  }
  if (!listed) span = {std::min(span.first, rows.end()), std::max(span.last, rows.end())};
  return span;
}

namespace detail {

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
  const std::string& name = word(at.values, path + ".kind");
  const OrbitKind* const kind = at.kinds.orbit(name);
  if (kind == nullptr)
    throw std::logic_error("orbit: the schema allows a kind without a description: " + name);
  const KeyValues table(at.values, at.units, path, at.name);
  ScenarioOrbit made =
      table.built("kind", [&] { return kind->made(OrbitContext(table, at.time, uses)); });
  made.name = key_name(path);
  made.kind = name;
  return made;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
