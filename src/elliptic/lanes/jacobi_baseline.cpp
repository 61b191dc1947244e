// SPDX-License-Identifier: MIT
// Jacobi's functions in the lanes of InstructionSet::baseline.
#include "elliptic/detail/jacobi_lanes.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template void jacobi_in_lanes<InstructionSet::baseline, false>(const JacobiColumns&, std::size_t);
template void jacobi_in_lanes<InstructionSet::baseline, true>(const JacobiColumns&, std::size_t);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
