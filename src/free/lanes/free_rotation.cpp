// SPDX-License-Identifier: MIT
// Free rotation, Sadov's variables and Serret's elements in the lanes of one set of instructions.
#include "free/detail/body_lanes.hpp"
#include "free/detail/grid_lanes.hpp"
#include "free/detail/sadov/lanes.hpp"
#include "free/detail/sadov/rotor_lanes.hpp"
#include "free/detail/state_lanes.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template void states_in_lanes<InstructionSet::POLHODE_ISA>(const FreeKernel&, const double*,
                                                           std::size_t, RotorState*);

template void grid_in_lanes<InstructionSet::POLHODE_ISA>(const FreeKernel&, const GridFrame&,
                                                         const TimeGrid&, std::uint64_t,
                                                         std::size_t, RotorState*);

template void bodies_in_lanes<InstructionSet::POLHODE_ISA>(const BodyRows&, std::span<RotorState>,
                                                           bool*);

template void sadov_in_lanes<InstructionSet::POLHODE_ISA>(const SadovConstants&, const RotorState*,
                                                          std::size_t, SadovState*, bool*);

template void rotors_of_sadov_in_lanes<InstructionSet::POLHODE_ISA>(const SadovConstants&,
                                                                    const SadovState*, std::size_t,
                                                                    RotorState*, bool*);

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
