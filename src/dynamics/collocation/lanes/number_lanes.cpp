// SPDX-License-Identifier: MIT
// Any numbers by collocation in the lanes of one set of instructions.
#include "dynamics/collocation/lanes/number_kernel.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template NumberLanes number_kernels<InstructionSet::POLHODE_ISA>(std::size_t stages);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
