// SPDX-License-Identifier: MIT
// Sadov's variables in the lanes of InstructionSet::avx2.
#if defined(__x86_64__)

#include "free/detail/sadov/lanes.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template void sadov_in_lanes<InstructionSet::avx2>(const SadovConstants&, const RotorState*,
                                                   std::size_t, SadovState*, bool*);

}  // namespace detail
}  // namespace v0
}  // namespace polhode

#endif
