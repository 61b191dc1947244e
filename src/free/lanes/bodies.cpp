// SPDX-License-Identifier: MIT
// Many bodies in the lanes of one set of instructions.
#include "free/detail/body_lanes.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template void bodies_in_lanes<InstructionSet::POLHODE_ISA>(const BodyRows&, std::span<RotorState>,
                                                           bool*);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
