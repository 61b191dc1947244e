// SPDX-License-Identifier: MIT
#include "polhode/rotor/many_states.hpp"

#include <cstddef>
#include <string>

#include "polhode/error.hpp"
#include "rotor/detail/chart_lanes_declared.hpp"

namespace polhode {
inline namespace v0 {
namespace {

template <class To, class From>
void converted(const char* function, std::span<const From> states, std::span<To> results,
               InstructionSet set) {
  if (results.size() != states.size())
    throw DomainError(std::string(function) + ": got room for " + std::to_string(results.size()) +
                      " results of " + std::to_string(states.size()) + " states; expected as many");
  if (!supports(set))
    throw DomainError(std::string(function) + ": got " + std::string(instruction_set_name(set)) +
                      "; expected instructions that this processor has");
  const auto in_lanes = [&](auto* converted_in_lanes) {
    converted_in_lanes(states.data(), states.size(), results.data());
  };
  using detail::converted_in_lanes;
#if defined(__x86_64__)
  if (set == InstructionSet::avx512)
    return in_lanes(&converted_in_lanes<InstructionSet::avx512, To, From>);
  if (set == InstructionSet::avx2)
    return in_lanes(&converted_in_lanes<InstructionSet::avx2, To, From>);
#endif
  in_lanes(&converted_in_lanes<InstructionSet::baseline, To, From>);
}

}  // namespace

void to_andoyer(std::span<const RotorState> states, std::span<AndoyerState> results,
                InstructionSet set) {
  converted("to_andoyer", states, results, set);
}
void to_euler(std::span<const RotorState> states, std::span<EulerState> results,
              InstructionSet set) {
  converted("to_euler", states, results, set);
}
void to_rotor(std::span<const AndoyerState> states, std::span<RotorState> results,
              InstructionSet set) {
  converted("to_rotor", states, results, set);
}
void to_rotor(std::span<const EulerState> states, std::span<RotorState> results,
              InstructionSet set) {
  converted("to_rotor", states, results, set);
}

}  // namespace v0
}  // namespace polhode
