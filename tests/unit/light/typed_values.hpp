// SPDX-License-Identifier: MIT
// Written by tools/reference/brightness.py: quadrature of the definition, at 18 digits.
#pragma once

#include <array>

#include "polhode/light/ellipsoid.hpp"

namespace polhode::test {

struct TypedBrightness {
  light::Ellipsoid body;
  Vec3 to_sun;
  Vec3 to_observer;
  double lommel_seeliger;
  double lambert;
};

// clang-format off
inline constexpr std::array<TypedBrightness, 7> typed_brightness{{
    {{1.0, 1.0, 1.0}, {1.0, 0.0, 0.0}, {0.5, 1.0, 0.25},
     0.9194416959985263, 1.1882640833563256},
    {{2.0, 1.5, 1.0}, {1.0, 2.0, -0.5}, {1.5, 1.0, 0.5},
     2.001772170694755, 2.5148043348690154},
    {{2.0, 1.5, 1.0}, {1.0, 2.0, -0.5}, {-1.5, 1.0, 2.0},
     1.0958346464203064, 1.2041548701563838},
    {{1.0, 0.75, 2.5}, {0.25, 1.0, 1.0}, {0.5, 1.0, 0.75},
     2.9550711340213227, 3.9017383879793424},
    {{1.0, 0.75, 2.5}, {0.25, 1.0, 1.0}, {0.5, -1.0, -0.25},
     0.17787847854176236, 0.11234873011852974},
    {{1.25, 1.0, 0.875}, {3.0, -1.0, 2.0}, {-2.5, 1.25, -1.0},
     0.023528240781492595, 0.005176005621860462},
    {{5.0, 1.0, 1.0}, {1.0, 0.25, 0.0}, {1.0, -0.25, 0.5},
     1.0059288048726485, 0.7342938538375477},
}};
// clang-format on

}  // namespace polhode::test
