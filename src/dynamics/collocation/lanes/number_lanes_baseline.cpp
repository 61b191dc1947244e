// SPDX-License-Identifier: MIT
// Any numbers by collocation in the lanes of InstructionSet::baseline.
#include "dynamics/collocation/lanes/number_kernel.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template NumberLanes number_kernels<InstructionSet::baseline>(std::size_t stages);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
