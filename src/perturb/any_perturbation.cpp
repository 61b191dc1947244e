// SPDX-License-Identifier: MIT
// AnyPerturbation: its errors, and the laws of the library's own terms for the instructions of the
// processor.
#include "polhode/perturb/any_perturbation.hpp"

#include "perturb/lanes/library_laws.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

void term_cannot(const std::string& name, std::string_view what) {
  throw DomainError("AnyPerturbation: term \"" + name + "\" " + std::string(what));
}

#define POLHODE_ELSEWHERE(LAW)                                            \
  extern POLHODE_LAW_IN_LANES(baseline, LAW) extern POLHODE_LAW_IN_LANES( \
      avx2, LAW) extern POLHODE_LAW_IN_LANES(avx512, LAW)
POLHODE_EACH_LAW(POLHODE_ELSEWHERE)

#define POLHODE_VECTORS_ELSEWHERE(LAW, VECTORS)                                            \
  extern POLHODE_VECTORS_IN_LANES(baseline, LAW, VECTORS) extern POLHODE_VECTORS_IN_LANES( \
      avx2, LAW, VECTORS) extern POLHODE_VECTORS_IN_LANES(avx512, LAW, VECTORS)
POLHODE_EACH_LAW_OF_VECTORS(POLHODE_VECTORS_ELSEWHERE)

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

template <class Law, std::size_t vectors>
VectorsOnStages<Law> library_law_of_vectors([[maybe_unused]] InstructionSet set) {
#if defined(__x86_64__)
  if (set == InstructionSet::avx512)
    return &vectors_on_stages<InstructionSet::avx512, Law, vectors>;
  if (set == InstructionSet::avx2) return &vectors_on_stages<InstructionSet::avx2, Law, vectors>;
#endif
  return &vectors_on_stages<InstructionSet::baseline, Law, vectors>;
}

#define POLHODE_INSTANTIATE_OF_VECTORS(LAW, VECTORS) \
  template VectorsOnStages<LAW> library_law_of_vectors<LAW, VECTORS>(InstructionSet);
POLHODE_EACH_LAW_OF_VECTORS(POLHODE_INSTANTIATE_OF_VECTORS)

}  // namespace detail
}  // namespace v0
}  // namespace polhode
