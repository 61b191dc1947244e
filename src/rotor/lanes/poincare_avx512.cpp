// SPDX-License-Identifier: MIT
// Poincare-type sets in the lanes of InstructionSet::avx512.
#if defined(__x86_64__)

#include "rotor/detail/poincare_lanes.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template void converted_in_lanes<InstructionSet::avx512>(const RotorState*, std::size_t,
                                                         PoincareState*, PolesOfSets);
template void converted_in_lanes<InstructionSet::avx512>(const PoincareState*, std::size_t,
                                                         RotorState*);

}  // namespace detail
}  // namespace v0
}  // namespace polhode

#endif
