// SPDX-License-Identifier: MIT
// How messages call a light curve and its points, from 1.
#pragma once

#include <cstddef>
#include <string>

#include "polhode/light/light_curve.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// "light curve NAME", or "light curve" of one without a name.
inline std::string in_words(const LightCurve& curve) {
  return "light curve" + (curve.name.empty() ? "" : " " + curve.name);
}
// "light curve NAME: point 3"
inline std::string in_words(const LightCurve& curve, std::size_t point) {
  return in_words(curve) + ": point " + std::to_string(point + 1);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
