// SPDX-License-Identifier: MIT
// Charts in the lanes of one set of instructions.
#include "rotor/detail/chart_lanes.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template void converted_in_lanes<InstructionSet::POLHODE_ISA>(const RotorState*, std::size_t,
                                                              AndoyerState*);
template void converted_in_lanes<InstructionSet::POLHODE_ISA>(const RotorState*, std::size_t,
                                                              EulerState*);
template void converted_in_lanes<InstructionSet::POLHODE_ISA>(const AndoyerState*, std::size_t,
                                                              RotorState*);
template void converted_in_lanes<InstructionSet::POLHODE_ISA>(const EulerState*, std::size_t,
                                                              RotorState*);

template void converted_in_lanes<InstructionSet::POLHODE_ISA>(const RotorState*, std::size_t,
                                                              PoincareState*, PolesOfSets);
template void converted_in_lanes<InstructionSet::POLHODE_ISA>(const PoincareState*, std::size_t,
                                                              RotorState*);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
