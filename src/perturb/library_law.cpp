// SPDX-License-Identifier: MIT
#include "perturb/lanes/library_laws.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

#define POLHODE_ELSEWHERE(LAW)                                            \
  extern POLHODE_LAW_IN_LANES(baseline, LAW) extern POLHODE_LAW_IN_LANES( \
      avx2, LAW) extern POLHODE_LAW_IN_LANES(avx512, LAW)
POLHODE_EACH_LAW(POLHODE_ELSEWHERE)

template <class Law>
LawOnStages<Law> library_law([[maybe_unused]] InstructionSet set) {
#if defined(__x86_64__)
  if (set == InstructionSet::avx512) return &law_on_stages<InstructionSet::avx512, Law>;
  if (set == InstructionSet::avx2) return &law_on_stages<InstructionSet::avx2, Law>;
#endif
  return &law_on_stages<InstructionSet::baseline, Law>;
}

#define POLHODE_INSTANTIATE(LAW) template LawOnStages<LAW> library_law<LAW>(InstructionSet);
POLHODE_EACH_LAW(POLHODE_INSTANTIATE)

}  // namespace detail
}  // namespace v0
}  // namespace polhode
