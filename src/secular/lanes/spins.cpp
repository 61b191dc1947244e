// SPDX-License-Identifier: MIT
// Spin axes in the lanes of one set of instructions.
#include "secular/detail/spin_lanes.hpp"

namespace polhode {
inline namespace v0 {
namespace secular {
namespace detail {

template void turned_in_lanes<InstructionSet::POLHODE_ISA>(std::span<const FrozenOrbit>,
                                                           const SpinColumns&, double*,
                                                           std::size_t);

}  // namespace detail
}  // namespace secular
}  // namespace v0
}  // namespace polhode
