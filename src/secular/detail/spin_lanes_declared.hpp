// SPDX-License-Identifier: MIT
// Many spin axes on one orbit, one in each lane; instantiated in src/secular/lanes for each set of
// instructions.
#pragma once

#include <cstddef>
#include <span>

#include "polhode/math/instruction_set.hpp"
#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

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
}  // namespace v0
}  // namespace polhode
