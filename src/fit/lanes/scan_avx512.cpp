// SPDX-License-Identifier: MIT
// The Fourier scan in the lanes of InstructionSet::avx512.
#if defined(__x86_64__)

#include "fit/detail/scan_kernel.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template void scan_in_lanes<InstructionSet::avx512>(const ScanBlock&);

}  // namespace detail
}  // namespace v0
}  // namespace polhode

#endif
