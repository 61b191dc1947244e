// SPDX-License-Identifier: MIT
// Jacobi's functions in the lanes of InstructionSet::avx512.
#if defined(__x86_64__)

#include "elliptic/detail/jacobi_lanes.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template void jacobi_in_lanes<InstructionSet::avx512, false>(const JacobiColumns&, std::size_t);
template void jacobi_in_lanes<InstructionSet::avx512, true>(const JacobiColumns&, std::size_t);

}  // namespace detail
}  // namespace v0
}  // namespace polhode

#endif
