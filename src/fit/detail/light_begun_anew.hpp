// SPDX-License-Identifier: MIT
// States from which a solution of a search is begun anew: least squares of light curves have leasts
// beside each other that random starts reach seldom.
#pragma once

#include <vector>

#include "fit/detail/light_relations.hpp"
#include "polhode/fit/light_fit.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// The images; the shape with b and c exchanged; half a turn about the momentum; the momentum turned
// to the other side, and by 0.5 rad to four sides.
std::vector<BrightEllipsoid> begun_anew(const BrightEllipsoid& body, const LightGeometry& geometry);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
