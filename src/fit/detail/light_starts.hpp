// SPDX-License-Identifier: MIT
// Starts of a search, drawn by their number, and their short fits.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "polhode/fit/light_search.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

struct LightTrial {
  BrightEllipsoid body;
  double cost;  // what was minimised
};

// Midway between the first and the last time.
double epoch_of(std::span<const LightCurve> curves);

// None where no body was found that has the periods.
std::optional<LightTrial> light_trial(const LightSearch& search, std::uint64_t number);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
