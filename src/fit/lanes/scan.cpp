// SPDX-License-Identifier: MIT
// The Fourier scan in the lanes of one set of instructions.
#include "fit/detail/scan_kernel.hpp"

namespace polhode {
inline namespace v0 {
namespace fit {
namespace detail {

template void scan_in_lanes<InstructionSet::POLHODE_ISA>(const ScanBlock&);

}  // namespace detail
}  // namespace fit
}  // namespace v0
}  // namespace polhode
