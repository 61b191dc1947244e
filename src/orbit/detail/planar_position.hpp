// SPDX-License-Identifier: MIT
// PlanarKepler::point, for callers that want it inline.
#pragma once

#include "orbit/detail/tabulated_ellipse.hpp"
#include "polhode/orbit/planar_kepler.hpp"

namespace polhode {
inline namespace v0 {

inline BasicPlanarPoint<double> PlanarKepler::point(double t, double rest) const {
  if (table_ && table_->holds(t, rest)) [[likely]]
    return table_->at(t, rest);
  return solved_point(t, rest);
}

}  // namespace v0
}  // namespace polhode
