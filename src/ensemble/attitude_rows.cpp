// SPDX-License-Identifier: MIT
// Many members at many epochs, in the lanes of the processor.
#include <string>

#include "ensemble/detail/attitude_sums.hpp"
#include "ensemble/detail/spread_sums.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace {

// kernel<isa>(...) of the set, of rows that fit.
template <class Accumulator, class Kernels>
void added_in_lanes(std::span<Accumulator> epochs, std::int64_t first,
                    std::span<const RotorState> states, InstructionSet set,
                    const Kernels& kernels) {
  if (epochs.empty() ? !states.empty() : states.size() % epochs.size() != 0)
    throw DomainError("add_rows: got " + std::to_string(states.size()) + " states at " +
                      std::to_string(epochs.size()) + " epochs; expected as many, or a multiple");
  if (!supports(set))
    throw DomainError("add_rows: got " + std::string(instruction_set_name(set)) +
                      "; expected instructions that this processor has");
  if (states.empty()) return;
  const auto add = [&](auto kernel) {
    kernel(epochs.data(), epochs.size(), first, states.data(), states.size() / epochs.size());
  };
#if defined(__x86_64__)
  if (set == InstructionSet::avx512)
    return add(kernels.template operator()<InstructionSet::avx512>());
  if (set == InstructionSet::avx2) return add(kernels.template operator()<InstructionSet::avx2>());
#endif
  add(kernels.template operator()<InstructionSet::baseline>());
}

}  // namespace

void add_rows(std::span<AttitudeMoments> epochs, std::int64_t first,
              std::span<const RotorState> states, InstructionSet set) {
  added_in_lanes(epochs, first, states, set,
                 []<InstructionSet isa>() { return &detail::add_attitude_rows<isa>; });
}

void add_rows(std::span<AttitudeSpread> epochs, std::int64_t first,
              std::span<const RotorState> states, InstructionSet set) {
  added_in_lanes(epochs, first, states, set,
                 []<InstructionSet isa>() { return &detail::add_spread_rows<isa>; });
}

}  // namespace v0
}  // namespace polhode
