// SPDX-License-Identifier: MIT
// Sadov's variables in the lanes of one set of instructions.
#include "free/detail/sadov/lanes.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template void sadov_in_lanes<InstructionSet::POLHODE_ISA>(const SadovConstants&, const RotorState*,
                                                          std::size_t, SadovState*, bool*);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
