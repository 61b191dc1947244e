// SPDX-License-Identifier: MIT
// Free rotation in the lanes of InstructionSet::baseline.
#include "free/detail/state_lanes.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template void states_in_lanes<InstructionSet::baseline>(const FreeKernel&, const double*,
                                                        std::size_t, RotorState*);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
