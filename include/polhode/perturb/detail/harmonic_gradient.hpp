// SPDX-License-Identifier: MIT
// The gradients of the harmonic polynomials of degree 3 and 4.
#pragma once

#include <cstddef>

#include "polhode/math/vector.hpp"
#include "polhode/shape/mass_properties.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// A harmonic polynomial of a degree by its gradient: p = x . grad p / degree.
template <int degree>
struct HarmonicGradient {
  shape::BasicMoments<double, degree - 1> by[3];

  bool operator==(const HarmonicGradient&) const = default;
};
// p_3 and p_4 of the header.
HarmonicGradient<3> potential_gradient(const shape::BasicMoments<double, 3>& m);
HarmonicGradient<4> potential_gradient(const shape::BasicMoments<double, 4>& m);

// The ten products of three from the six products of two.
template <Number T>
shape::BasicMoments<T, 3> cubes_of(const shape::BasicMoments<T, 2>& s, const BasicVec3<T>& n) {
  return {s[0] * n.x, s[0] * n.y, s[0] * n.z, s[3] * n.x, s[4] * n.x,
          s[5] * n.x, s[3] * n.y, s[3] * n.z, s[5] * n.y, s[5] * n.z};
}

template <int degree, Number T>
BasicVec3<T> gradient(const HarmonicGradient<degree>& p,
                      const shape::BasicMoments<T, degree - 1>& monomials) {
  BasicVec3<T> sum;
  for (int i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < monomials.size(); ++k)  // 6 or 10
      sum[i] = sum[i] + monomials[k] * p.by[i][k];
  return sum;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
