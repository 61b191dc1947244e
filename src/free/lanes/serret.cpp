// SPDX-License-Identifier: MIT
// Serret's elements in the lanes of one set of instructions, both ways.
#include "free/detail/sadov/lanes.hpp"
#include "free/detail/sadov/serret_rotor_lanes.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template void serret_in_lanes<InstructionSet::POLHODE_ISA>(const SadovConstants&, const RotorState*,
                                                           const TimesOfStates&, std::size_t,
                                                           SerretState*, bool*);
template void rotors_of_serret_in_lanes<InstructionSet::POLHODE_ISA>(const SadovConstants&,
                                                                     const SerretState*,
                                                                     const TimesOfStates&,
                                                                     std::size_t, RotorState*,
                                                                     bool*);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
