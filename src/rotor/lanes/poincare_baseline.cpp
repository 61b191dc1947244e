// SPDX-License-Identifier: MIT
// Poincare-type sets in the lanes of InstructionSet::baseline.
#include "rotor/detail/poincare_lanes.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template void converted_in_lanes<InstructionSet::baseline>(const RotorState*, std::size_t,
                                                           PoincareState*, PolesOfSets);
template void converted_in_lanes<InstructionSet::baseline>(const PoincareState*, std::size_t,
                                                           RotorState*);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
