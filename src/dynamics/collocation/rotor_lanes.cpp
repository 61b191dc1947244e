// SPDX-License-Identifier: MIT
#include "dynamics/collocation/rotor_step.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// src/dynamics/collocation/lanes, one source for each set.
template <InstructionSet isa>
RotorLanes rotor_kernels(std::size_t stages);

RotorLanes rotor_lanes(std::size_t stages, [[maybe_unused]] InstructionSet set) {
#if defined(__x86_64__)
  if (set == InstructionSet::avx512) return rotor_kernels<InstructionSet::avx512>(stages);
  if (set == InstructionSet::avx2) return rotor_kernels<InstructionSet::avx2>(stages);
#endif
  return rotor_kernels<InstructionSet::baseline>(stages);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
