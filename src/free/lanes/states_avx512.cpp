// SPDX-License-Identifier: MIT
// Free rotation in the lanes of InstructionSet::avx512.
#if defined(__x86_64__)

#include "free/detail/state_lanes.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template void states_in_lanes<InstructionSet::avx512>(const FreeKernel&, const double*, std::size_t,
                                                      RotorState*);

}  // namespace detail
}  // namespace v0
}  // namespace polhode

#endif
