// SPDX-License-Identifier: MIT
// What others call words of scenarios.
#pragma once

#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "text/nearest.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// Our word for one of others, or one that is spelt much the same; else nothing. The axes of the
// ICRF are those of the equator of J2000 to 0.02 arcsec.
inline std::string_view meant_word(std::string_view word,
                                   const std::vector<std::string_view>& allowed) {
  constexpr std::pair<std::string_view, std::string_view> names[] = {
      {"ICRF", "equator-J2000"},      {"ICRS", "equator-J2000"},       {"GCRF", "equator-J2000"},
      {"GCRS", "equator-J2000"},      {"J2000", "equator-J2000"},      {"EME2000", "equator-J2000"},
      {"FK5", "equator-J2000"},       {"equatorial", "equator-J2000"}, {"equator", "equator-J2000"},
      {"ecliptic", "ecliptic-J2000"}, {"ECLIPJ2000", "ecliptic-J2000"}};
  for (const auto& [theirs, ours] : names)
    if (theirs == word && std::find(allowed.begin(), allowed.end(), ours) != allowed.end())
      return ours;
  return nearest(word, allowed);
}

// What makes an orbit of two-line elements.
constexpr std::string_view satellites_command =
    "python -m polhode.satellites TLE --from DATE --to DATE --out orbit.csv makes a table, for "
    "kind = \"table\" with file = \"orbit.csv\"";

inline bool is_of_satellites(std::string_view word) {
  constexpr std::string_view theirs[] = {"tle", "TLE",   "sgp4",  "SGP4",   "omm",
                                         "OMM", "line1", "line2", "line_1", "line_2"};
  return std::find(std::begin(theirs), std::end(theirs), word) != std::end(theirs);
}

// What to say of a word that is none of those allowed.
inline std::string meaning_of(std::string_view word, const std::vector<std::string_view>& allowed) {
  const bool orbits = std::find(allowed.begin(), allowed.end(), "ephemeris") != allowed.end();
  if (orbits && is_of_satellites(word)) return std::string(satellites_command);
  const std::string_view near = meant_word(word, allowed);
  return near.empty() ? "" : "did you mean \"" + std::string(near) + "\"?";
}

// Our key for one of REBOUND's, or of other programs, if it is among these.
inline std::string_view meant_key(std::string_view name,
                                  const std::vector<std::string_view>& keys) {
  constexpr std::pair<std::string_view, std::string_view> names[] = {
      {"a", "semi_major_axis"},
      {"e", "eccentricity"},
      {"ecc", "eccentricity"},
      {"inc", "inclination"},
      {"i", "inclination"},
      {"incl", "inclination"},
      {"Omega", "node"},
      {"raan", "node"},
      {"RAAN", "node"},
      {"omega", "pericentre_argument"},
      {"pomega", "pericentre_argument"},
      {"varpi", "pericentre_argument"},
      {"M", "mean_anomaly"},
      {"P", "period"},
      {"l", "mean_longitude"}};
  for (const auto& [theirs, ours] : names)
    if (theirs == name && std::find(keys.begin(), keys.end(), ours) != keys.end()) return ours;
  return {};
}

// What to say of a key of the table `path` behind the keys that there are.
inline std::string meaning_of_key(std::string_view path, std::string_view name) {
  if (!path.starts_with("orbit.")) return "";
  if (name == "pomega" || name == "varpi")
    return "; pericentre_argument counts from the node: it is " + std::string(name) + " - node";
  return is_of_satellites(name) ? "; " + std::string(satellites_command) : "";
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
