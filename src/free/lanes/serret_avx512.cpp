// SPDX-License-Identifier: MIT
// Serret's elements in the lanes of InstructionSet::avx512, both ways.
#if defined(__x86_64__)

#include "free/detail/sadov/lanes.hpp"
#include "free/detail/sadov/serret_rotor_lanes.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template void serret_in_lanes<InstructionSet::avx512>(const SadovConstants&, const RotorState*,
                                                      const TimesOfStates&, std::size_t,
                                                      SerretState*, bool*);
template void rotors_of_serret_in_lanes<InstructionSet::avx512>(const SadovConstants&,
                                                                const SerretState*,
                                                                const TimesOfStates&, std::size_t,
                                                                RotorState*, bool*);

}  // namespace detail
}  // namespace v0
}  // namespace polhode

#endif
