// SPDX-License-Identifier: MIT
// Moments of attitudes in the lanes of one set of instructions.
#include "ensemble/detail/attitude_lanes.hpp"

namespace polhode {
inline namespace v0 {
namespace ensemble {
namespace detail {

template void add_attitude_rows<InstructionSet::POLHODE_ISA>(AttitudeMoments*, std::size_t,
                                                             std::int64_t, const RotorState*,
                                                             std::size_t);
template void add_spread_rows<InstructionSet::POLHODE_ISA>(AttitudeSpread*, std::size_t,
                                                           std::int64_t, const RotorState*,
                                                           std::size_t);

}  // namespace detail
}  // namespace ensemble
}  // namespace v0
}  // namespace polhode
