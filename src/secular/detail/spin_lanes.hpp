// SPDX-License-Identifier: MIT
// SpinPrecession::frozen of as many axes at a time as a register holds; compiled once for each set
// of instructions.
#pragma once

#include "math/pack_functions.hpp"
#include "polhode/secular/spin_precession.hpp"
#include "secular/detail/spin_axes.hpp"

namespace polhode {
inline namespace v0 {
namespace secular {
namespace detail {

// Packs at a time: their chains of operations overlap.
inline constexpr std::size_t packs_of_spins = 4;

template <InstructionSet isa>
[[gnu::flatten]] void turned_in_lanes(std::span<const FrozenOrbit> orbits,
                                      const SpinColumns& bodies, double* axes, std::size_t stride) {
  using T = Pack<isa>;
  double *const x = axes, *const y = axes + stride, *const z = axes + 2 * stride;
  const std::size_t packs = (bodies.count + T::width - 1) / T::width;
  for (std::size_t first = 0; first < packs; first += packs_of_spins) {
    const std::size_t end = packs < first + packs_of_spins ? packs : first + packs_of_spins;
    for (const FrozenOrbit& orbit : orbits) {
      const BasicVec3<T> n{T(orbit.normal.x), T(orbit.normal.y), T(orbit.normal.z)};
      for (std::size_t i = first * T::width; i < end * T::width; i += T::width) {
        const BasicVec3<T> s{T::loaded(x + i), T::loaded(y + i), T::loaded(z + i)};
        const BasicPrecessionRates<T> rates{
            T::loaded(bodies.star + i), T::loaded(bodies.satellites + i),
            T::loaded(bodies.geodetic + i), T::loaded(bodies.drift + i)};
        const T angle = -rates.turning(orbit.t, orbit.e2, dot(s, n)) * T(orbit.h);
        const BasicVec3<T> next = turned_axis(s, n, sincos_of_small(T(T(0.5) * angle)));
        next.x.store(x + i);
        next.y.store(y + i);
        next.z.store(z + i);
      }
    }
  }
}

}  // namespace detail
}  // namespace secular
}  // namespace v0
}  // namespace polhode
