// SPDX-License-Identifier: MIT
// Orbits in the lanes of one set of instructions.
#include "orbit/detail/orbit_kernels.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template OrbitLanes orbit_kernels<InstructionSet::POLHODE_ISA>();

}  // namespace detail
}  // namespace v0
}  // namespace polhode
