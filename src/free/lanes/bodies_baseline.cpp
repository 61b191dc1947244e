// SPDX-License-Identifier: MIT
// Many bodies in the lanes of InstructionSet::baseline.
#include "free/detail/body_lanes.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template void bodies_in_lanes<InstructionSet::baseline>(const BodyRows&, std::span<RotorState>,
                                                        bool*);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
