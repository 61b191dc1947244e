// SPDX-License-Identifier: MIT
// A rotor by collocation in the lanes of one set of instructions.
#include "dynamics/collocation/lanes/rotor_kernel.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template RotorLanes rotor_kernels<InstructionSet::POLHODE_ISA>(std::size_t stages);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
