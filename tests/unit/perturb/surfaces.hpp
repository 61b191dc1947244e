// SPDX-License-Identifier: MIT
// Facets at random.
#pragma once

#include <vector>

#include "polhode/shape/surface.hpp"
#include "unit/perturb/support.hpp"

namespace perturb_test {

using namespace polhode;

inline Surface drawn_surface(std::uint64_t seed, int count) {
  Draw draw(seed, 0);
  std::vector<SurfaceFacet> facets;
  for (int i = 0; i < count; ++i) {
    const double s = draw.uniform(0.0, 1.0);
    facets.push_back({drawn_vector(draw),
                      drawn_vector(draw),
                      draw.uniform(0.1, 2.0),
                      {.specular = s,
                       .diffuse = draw.uniform(0.0, 1.0 - s),
                       .emitted = draw.uniform(0.0, 1.0),
                       .normal_accommodation = draw.uniform(0.0, 1.0),
                       .tangential_accommodation = draw.uniform(0.0, 1.0)}});
  }
  return Surface(facets);
}

}  // namespace perturb_test
