// SPDX-License-Identifier: MIT
// Many bodies in the lanes of InstructionSet::avx512.
#if defined(__x86_64__)

#include "free/detail/body_lanes.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template void bodies_in_lanes<InstructionSet::avx512>(const BodyRows&, std::span<RotorState>,
                                                      bool*);

}  // namespace detail
}  // namespace v0
}  // namespace polhode

#endif
