// SPDX-License-Identifier: MIT
// Which of Sadov's two regions a pair of actions belongs to, for text that does not say it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "polhode/free/sadov.hpp"
#include "polhode/rotor/body.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// |I_l|/I_g is above (2/pi) arctan kappa in short-axis mode, kappa^2 = I3 (I2 - I1)/(I1 (I3 - I2)).
inline SadovRegion sadov_region(const Body& body, double I_l, double I_g) {
  std::array<double, 3> I{body.moments().x, body.moments().y, body.moments().z};
  std::sort(I.begin(), I.end());
  const double separatrix =
      std::atan2(std::sqrt(I[2] * (I[1] - I[0])), std::sqrt(I[0] * (I[2] - I[1]))) *
      (2.0 / std::numbers::pi);
  return std::fabs(I_l) >= separatrix * I_g ? SadovRegion::short_axis : SadovRegion::long_axis;
}

// The lobe as columns have it: 0 in the short-axis region, where there is none to name.
inline double lobe_column(const SadovState& s) {
  return s.region == SadovRegion::short_axis ? 0.0 : static_cast<double>(s.lobe);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
