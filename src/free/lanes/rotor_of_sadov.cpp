// SPDX-License-Identifier: MIT
// States of Sadov's variables in the lanes of one set of instructions.
#include "free/detail/sadov/rotor_lanes.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template void rotors_of_sadov_in_lanes<InstructionSet::POLHODE_ISA>(const SadovConstants&,
                                                                    const SadovState*, std::size_t,
                                                                    RotorState*, bool*);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
