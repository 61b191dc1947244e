// SPDX-License-Identifier: MIT
#include "polhode/rotor/many_states.hpp"

#include <cstddef>
#include <string>

#include "polhode/error.hpp"
#include "rotor/detail/chart_lanes_declared.hpp"

namespace polhode {
inline namespace v0 {
namespace {

template <class To, class From, class... How>
void converted(const char* function, std::span<const From> states, std::span<To> results,
               InstructionSet set, How... how) {
  if (results.size() != states.size())
    throw DomainError(std::string(function) + ": got room for " + std::to_string(results.size()) +
                      " results of " + std::to_string(states.size()) + " states; expected as many");
  if (!supports(set))
    throw DomainError(std::string(function) + ": got " + std::string(instruction_set_name(set)) +
                      "; expected instructions that this processor has");
  const From* const from = states.data();
  using detail::converted_in_lanes;
#if defined(__x86_64__)
  if (set == InstructionSet::avx512)
    return converted_in_lanes<InstructionSet::avx512>(from, states.size(), results.data(), how...);
  if (set == InstructionSet::avx2)
    return converted_in_lanes<InstructionSet::avx2>(from, states.size(), results.data(), how...);
#endif
  converted_in_lanes<InstructionSet::baseline>(from, states.size(), results.data(), how...);
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
void to_poincare(std::span<const RotorState> states, Pole pole_J, Pole pole_I,
                 std::span<PoincareState> results, InstructionSet set) {
  converted("to_poincare", states, results, set, detail::PolesOfSets{false, pole_J, pole_I});
}
void nearest_poincare(std::span<const RotorState> states, std::span<PoincareState> results,
                      InstructionSet set) {
  converted("nearest_poincare", states, results, set,
            detail::PolesOfSets{true, Pole::zero, Pole::zero});
}
void to_rotor(std::span<const PoincareState> states, std::span<RotorState> results,
              InstructionSet set) {
  converted("to_rotor", states, results, set);
}

}  // namespace v0
}  // namespace polhode
