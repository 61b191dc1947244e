// SPDX-License-Identifier: MIT
// Free rotation in the lanes of one set of instructions.
#include "free/detail/state_lanes.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template void states_in_lanes<InstructionSet::POLHODE_ISA>(const FreeKernel&, const double*,
                                                           std::size_t, RotorState*);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
