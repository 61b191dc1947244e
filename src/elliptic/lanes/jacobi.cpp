// SPDX-License-Identifier: MIT
// Jacobi's functions in the lanes of one set of instructions.
#include "elliptic/detail/jacobi_lanes.hpp"

namespace polhode {
inline namespace v0 {
namespace elliptic {
namespace detail {

template void jacobi_in_lanes<InstructionSet::POLHODE_ISA, false>(const JacobiColumns&,
                                                                  std::size_t);
template void jacobi_in_lanes<InstructionSet::POLHODE_ISA, true>(const JacobiColumns&, std::size_t);

}  // namespace detail
}  // namespace elliptic
}  // namespace v0
}  // namespace polhode
