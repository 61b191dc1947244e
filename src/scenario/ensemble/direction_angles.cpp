// SPDX-License-Identifier: MIT
#include "scenario/ensemble/direction_angles.hpp"

#include <algorithm>
#include <string_view>

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

constexpr std::string_view around[] = {"longitude", "ra", "node", "phi", "precession"};
constexpr std::string_view from_equator[] = {"latitude", "dec"};
constexpr std::string_view from_pole[] = {"inclination", "theta", "obliquity"};

// "latitude" of "state.tumbler.pole.latitude".
std::string_view end_of(std::string_view key) { return key.substr(key.rfind('.') + 1); }

bool is_one(std::span<const std::string_view> names, std::string_view key) {
  return std::ranges::find(names, end_of(key)) != names.end();
}

}  // namespace

std::optional<DirectionAngles> direction_angles(std::span<const std::string> keys) {
  if (keys.size() != 2) return std::nullopt;
  for (std::size_t i = 0; i < 2; ++i) {
    const std::string& tilt = keys[1 - i];
    if (!is_one(around, keys[i])) continue;
    if (is_one(from_equator, tilt)) return DirectionAngles{i, false};
    if (is_one(from_pole, tilt)) return DirectionAngles{i, true};
  }
  return std::nullopt;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
