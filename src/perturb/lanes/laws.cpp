// SPDX-License-Identifier: MIT
// The laws of terms in the lanes of one set of instructions.
#include "perturb/lanes/library_laws.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

#define POLHODE_INSTANTIATE(LAW) POLHODE_LAW_IN_LANES(POLHODE_ISA, LAW)
POLHODE_EACH_LAW(POLHODE_INSTANTIATE)
#define POLHODE_INSTANTIATE_OF_VECTORS(LAW, VECTORS) \
  POLHODE_VECTORS_IN_LANES(POLHODE_ISA, LAW, VECTORS)
POLHODE_EACH_LAW_OF_VECTORS(POLHODE_INSTANTIATE_OF_VECTORS)

}  // namespace detail
}  // namespace v0
}  // namespace polhode
