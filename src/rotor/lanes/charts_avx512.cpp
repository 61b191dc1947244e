// SPDX-License-Identifier: MIT
// Charts in the lanes of InstructionSet::avx512.
#if defined(__x86_64__)

#include "rotor/detail/chart_lanes.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template void converted_in_lanes<InstructionSet::avx512>(const RotorState*, std::size_t,
                                                         AndoyerState*);
template void converted_in_lanes<InstructionSet::avx512>(const RotorState*, std::size_t,
                                                         EulerState*);
template void converted_in_lanes<InstructionSet::avx512>(const AndoyerState*, std::size_t,
                                                         RotorState*);
template void converted_in_lanes<InstructionSet::avx512>(const EulerState*, std::size_t,
                                                         RotorState*);

}  // namespace detail
}  // namespace v0
}  // namespace polhode

#endif
