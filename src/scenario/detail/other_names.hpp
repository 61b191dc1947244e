// SPDX-License-Identifier: MIT
// What others call words of scenarios.
#pragma once

#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
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

// An orbital element: its name in REBOUND and other programs, the key of [orbit.NAME] to suggest,
// and our column, which is empty if there is none.
struct ElementName {
  std::string_view theirs, key, column;
};
constexpr ElementName element_names[] = {{"a", "semi_major_axis", "a"},
                                         {"e", "eccentricity", "e"},
                                         {"ecc", "eccentricity", "e"},
                                         {"inc", "inclination", "i"},
                                         {"i", "inclination", "i"},
                                         {"incl", "inclination", "i"},
                                         {"Omega", "node", "Omega"},
                                         {"raan", "node", "Omega"},
                                         {"RAAN", "node", "Omega"},
                                         {"omega", "pericentre_argument", "omega"},
                                         {"argp", "pericentre_argument", "omega"},
                                         {"aop", "pericentre_argument", "omega"},
                                         {"pomega", "pericentre_argument", "varpi"},
                                         {"Pomega", "pericentre_argument", "varpi"},
                                         {"varpi", "pericentre_argument", "varpi"},
                                         {"M", "mean_anomaly", "M"},
                                         {"f", "mean_anomaly", ""},
                                         {"nu", "mean_anomaly", ""},
                                         {"true_anomaly", "mean_anomaly", ""},
                                         {"P", "period", ""},
                                         {"l", "mean_longitude", "lambda"},
                                         {"lambda", "mean_longitude", "lambda"}};

// Our key for one of these, if it is among those allowed.
inline std::string_view meant_key(std::string_view name,
                                  const std::vector<std::string_view>& keys) {
  for (const ElementName& one : element_names)
    if (one.theirs == name && std::find(keys.begin(), keys.end(), one.key) != keys.end())
      return one.key;
  return {};
}

// Our column for one of these, for one of our keys, or for a name that is spelt much the same.
inline std::string_view meant_column(std::string_view name,
                                     const std::vector<std::string_view>& columns) {
  for (const ElementName& one : element_names)
    if ((one.theirs == name || one.key == name) &&
        std::find(columns.begin(), columns.end(), one.column) != columns.end())
      return one.column;
  return nearest(name, columns);
}

// What to say of a key of the table `path`, which may mean ours, behind the keys that there are.
inline std::string meaning_of_key(std::string_view path, std::string_view name) {
  if (!path.starts_with("orbit.")) return "";
  const std::string theirs(name);
  if (name == "pomega" || name == "Pomega" || name == "varpi")
    return "; pericentre_argument counts from the node: it is " + theirs + " - node";
  if (name == "f" || name == "nu" || name == "true_anomaly")
    return "; " + theirs + " is the true anomaly: expected the mean anomaly, E - e sin E with " +
           "tan(E/2) = sqrt((1 - e)/(1 + e)) tan(" + theirs + "/2)";
  return is_of_satellites(name) ? "; " + std::string(satellites_command) : "";
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
