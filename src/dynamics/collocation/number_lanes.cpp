// SPDX-License-Identifier: MIT
#include "dynamics/collocation/number_lanes.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// src/dynamics/collocation/lanes, one source for each set.
template <InstructionSet isa>
NumberLanes number_kernels(std::size_t stages);

NumberLanes number_lanes(std::size_t stages, [[maybe_unused]] InstructionSet set) {
#if defined(__x86_64__)
  if (set == InstructionSet::avx512) return number_kernels<InstructionSet::avx512>(stages);
  if (set == InstructionSet::avx2) return number_kernels<InstructionSet::avx2>(stages);
#endif
  return number_kernels<InstructionSet::baseline>(stages);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
