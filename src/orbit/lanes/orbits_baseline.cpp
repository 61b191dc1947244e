// SPDX-License-Identifier: MIT
// Orbits in the lanes of InstructionSet::baseline.
#include "orbit/detail/orbit_kernels.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template OrbitLanes orbit_kernels<InstructionSet::baseline>();

}  // namespace detail
}  // namespace v0
}  // namespace polhode
