// SPDX-License-Identifier: MIT
#include "polhode/math/instruction_set.hpp"

namespace polhode {
inline namespace v0 {

std::string_view instruction_set_name(InstructionSet set) {
  switch (set) {
    case InstructionSet::avx2:
      return "AVX2";
    case InstructionSet::avx512:
      return "AVX-512";
    case InstructionSet::baseline:
      break;
  }
  return "baseline";
}

bool supports(InstructionSet set) {
#if defined(__x86_64__)
  if (set == InstructionSet::baseline) return true;
  const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  if (set == InstructionSet::avx2) return avx2;
  return avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
         __builtin_cpu_supports("avx512vl");
#else
  return set == InstructionSet::baseline;
#endif
}

std::vector<InstructionSet> supported_instruction_sets() {
  std::vector<InstructionSet> sets;
  for (const InstructionSet set :
       {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512})
    if (supports(set)) sets.push_back(set);
  return sets;
}

InstructionSet widest_instruction_set() {
  if (supports(InstructionSet::avx512)) return InstructionSet::avx512;
  if (supports(InstructionSet::avx2)) return InstructionSet::avx2;
  return InstructionSet::baseline;
}

}  // namespace v0
}  // namespace polhode
