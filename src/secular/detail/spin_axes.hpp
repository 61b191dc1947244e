// SPDX-License-Identifier: MIT
// The motion of spin axes while their orbit stays: of one, and of many, one in each lane.
#pragma once

#include <cstddef>
#include <span>

#include "polhode/detail/math/trigonometry.hpp"
#include "polhode/math/instruction_set.hpp"
#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {
namespace secular {
namespace detail {

// s turned about n by twice the angle of these sines: 1 - cos without cancellation. What rounding
// does to the length is taken out to first order.
template <class T>
[[gnu::always_inline]] inline BasicVec3<T> turned_axis(const BasicVec3<T>& s, const BasicVec3<T>& n,
                                                       const SinCos<T>& half) {
  const T twice = T(2.0) * half.sin;
  const BasicVec3<T> across = cross(n, s);
  const BasicVec3<T> next =
      s + T(twice * half.cos) * across + T(twice * half.sin) * cross(n, across);
  return T(T(1.5) - T(0.5) * dot(next, next)) * next;
}

// The rates of many bodies, in columns that are filled up to a multiple of 8, and how many they
// are.
struct SpinColumns {
  std::size_t count;
  const double* star;
  const double* satellites;
  const double* geodetic;
  const double* drift;
};

// An orbit that stays for h as it is at t.
struct FrozenOrbit {
  double t;
  double h;
  double e2;
  Vec3 normal;
};

// Moves the axes of bodies, three columns that begin `stride` apart, along orbits one after the
// other.
template <InstructionSet isa>
void turned_in_lanes(std::span<const FrozenOrbit> orbits, const SpinColumns& bodies, double* axes,
                     std::size_t stride);

}  // namespace detail
}  // namespace secular
}  // namespace v0
}  // namespace polhode
