// SPDX-License-Identifier: MIT
// Even grids of free rotation in the lanes of one set of instructions.
#include "free/detail/grid_lanes.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template void grid_in_lanes<InstructionSet::POLHODE_ISA>(const FreeKernel&, const GridFrame&,
                                                         const TimeGrid&, std::uint64_t,
                                                         std::size_t, RotorState*);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
