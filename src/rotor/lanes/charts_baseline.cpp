// SPDX-License-Identifier: MIT
// Charts in the lanes of InstructionSet::baseline.
#include "rotor/detail/chart_lanes.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template void converted_in_lanes<InstructionSet::baseline>(const RotorState*, std::size_t,
                                                           AndoyerState*);
template void converted_in_lanes<InstructionSet::baseline>(const RotorState*, std::size_t,
                                                           EulerState*);
template void converted_in_lanes<InstructionSet::baseline>(const AndoyerState*, std::size_t,
                                                           RotorState*);
template void converted_in_lanes<InstructionSet::baseline>(const EulerState*, std::size_t,
                                                           RotorState*);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
