// SPDX-License-Identifier: MIT
// InstructionSet: what a processor can do beyond the least of its kind, as far as packs use it.
//
// Domain      avx2 and avx512 are of x86-64. Elsewhere `baseline` is all there is.
// Accuracy    results do not depend on the set, to the last bit.
// Cost        that of a look at what was found when the program started.
#pragma once

#include <string_view>
#include <vector>

#include "polhode/version.hpp"  // asks for C++20

namespace polhode {
inline namespace v0 {

enum class InstructionSet {
  baseline,  // what every processor of the kind has
  avx2,      // AVX2 and FMA
  avx512     // AVX-512 F, DQ and VL, and those of avx2
};

// "baseline", "AVX2", "AVX-512".
std::string_view instruction_set_name(InstructionSet set);
// Whether this processor has it.
bool supports(InstructionSet set);
// Those that it has, the widest last.
std::vector<InstructionSet> supported_instruction_sets();
InstructionSet widest_instruction_set();

}  // namespace v0
}  // namespace polhode
