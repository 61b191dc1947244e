// SPDX-License-Identifier: MIT
// What others call words of scenarios.
#pragma once

#include <algorithm>
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

}  // namespace detail
}  // namespace v0
}  // namespace polhode
