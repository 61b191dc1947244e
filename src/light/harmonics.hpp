// SPDX-License-Identifier: MIT
// Real spherical harmonics of mean square 1 over the sphere, sin(|m| phi) for m < 0; Y_lm at place
// l^2 + l + m.
#pragma once

#include <vector>

#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {
namespace light {

// At a direction of length 1.
std::vector<double> spherical_harmonics(int degree, const Vec3& direction);

}  // namespace light
}  // namespace v0
}  // namespace polhode
