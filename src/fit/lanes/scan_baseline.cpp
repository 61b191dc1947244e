// SPDX-License-Identifier: MIT
// The Fourier scan in the lanes of InstructionSet::baseline.
#include "fit/detail/scan_kernel.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template void scan_in_lanes<InstructionSet::baseline>(const ScanBlock&);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
