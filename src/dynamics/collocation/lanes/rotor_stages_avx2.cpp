// SPDX-License-Identifier: MIT
// A rotor by collocation in the lanes of InstructionSet::avx2.
#if defined(__x86_64__)

#include "dynamics/collocation/lanes/rotor_kernel.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template RotorLanes rotor_kernels<InstructionSet::avx2>(std::size_t stages);

}  // namespace detail
}  // namespace v0
}  // namespace polhode

#endif
