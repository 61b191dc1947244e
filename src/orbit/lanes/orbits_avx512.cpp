// SPDX-License-Identifier: MIT
// Orbits in the lanes of InstructionSet::avx512.
#if defined(__x86_64__)

#include "orbit/detail/orbit_kernels.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template OrbitLanes orbit_kernels<InstructionSet::avx512>();

}  // namespace detail
}  // namespace v0
}  // namespace polhode

#endif
