// SPDX-License-Identifier: MIT
#include "orbit/detail/orbit_lanes.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// src/orbit/lanes, one source for each set.
template <InstructionSet isa>
OrbitLanes orbit_kernels();

OrbitLanes orbit_lanes([[maybe_unused]] InstructionSet set) {
#if defined(__x86_64__)
  if (set == InstructionSet::avx512) return orbit_kernels<InstructionSet::avx512>();
  if (set == InstructionSet::avx2) return orbit_kernels<InstructionSet::avx2>();
#endif
  return orbit_kernels<InstructionSet::baseline>();
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
