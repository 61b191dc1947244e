// SPDX-License-Identifier: MIT
#include "polhode/free/states_at.hpp"

#include <cstddef>
#include <string>

#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// src/free/lanes, one source for each set.
template <InstructionSet isa>
void states_in_lanes(const FreeKernel& kernel, const double* times, std::size_t count,
                     RotorState* states);

}  // namespace detail
namespace {

// Fewer are not worth the kernel's copies in all lanes.
constexpr std::size_t fewest = 8;

}  // namespace

void states_at(const FreeKernel& kernel, std::span<const double> times,
               std::span<RotorState> states, InstructionSet set) {
  if (states.size() != times.size())
    throw DomainError("states_at: got room for " + std::to_string(states.size()) + " states at " +
                      std::to_string(times.size()) + " times; expected as many");
  if (!supports(set))
    throw DomainError("states_at: got " + std::string(instruction_set_name(set)) +
                      "; expected instructions that this processor has");
  if (times.size() < fewest) {
    for (std::size_t i = 0; i < times.size(); ++i) states[i] = evaluate(kernel, times[i]);
    return;
  }
  const auto in_lanes = [&](auto* states_in_lanes) {
    states_in_lanes(kernel, times.data(), times.size(), states.data());
  };
#if defined(__x86_64__)
  if (set == InstructionSet::avx512)
    return in_lanes(&detail::states_in_lanes<InstructionSet::avx512>);
  if (set == InstructionSet::avx2) return in_lanes(&detail::states_in_lanes<InstructionSet::avx2>);
#endif
  in_lanes(&detail::states_in_lanes<InstructionSet::baseline>);
}

}  // namespace v0
}  // namespace polhode
