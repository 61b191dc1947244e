// SPDX-License-Identifier: MIT
#include "polhode/free/states_on_grid.hpp"

#include <cstddef>
#include <string>

#include "free/detail/grid_frame.hpp"
#include "polhode/error.hpp"
#include "polhode/free/detail/primed_arc.hpp"
#include "polhode/math/double_double.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// src/free/lanes, one source for each set.
template <InstructionSet isa>
void grid_in_lanes(const FreeKernel& kernel, const GridFrame& frame, const TimeGrid& grid,
                   std::uint64_t first, std::size_t count, RotorState* states);

}  // namespace detail
namespace {

constexpr std::uint64_t most_states = std::uint64_t{1} << 53;

detail::GridFrame frame_of(const FreeKernel& k) {
  using Wide = BasicQuaternion<DoubleDouble>;
  const Wide left = detail::converted<DoubleDouble>(k.left);
  const Wide right = detail::converted<DoubleDouble>(k.right);
  const Wide now = left * right, on = left * (Wide{0.0, 0.0, 0.0, 1.0} * right);
  return {detail::values_of(now), detail::values_of(on)};
}

}  // namespace

void states_on_grid(const FreeKernel& kernel, const TimeGrid& grid, std::uint64_t first,
                    std::span<RotorState> states, InstructionSet set) {
  if (first > most_states || states.size() > most_states - first)
    throw DomainError("states_on_grid: got states " + std::to_string(first) + " to " +
                      std::to_string(first + states.size()) + "; expected indices up to 2^53");
  if (!supports(set))
    throw DomainError("states_on_grid: got " + std::string(instruction_set_name(set)) +
                      "; expected instructions that this processor has");
  const detail::GridFrame frame = frame_of(kernel);
  const auto in_lanes = [&](auto* grid_in_lanes) {
    grid_in_lanes(kernel, frame, grid, first, states.size(), states.data());
  };
#if defined(__x86_64__)
  if (set == InstructionSet::avx512)
    return in_lanes(&detail::grid_in_lanes<InstructionSet::avx512>);
  if (set == InstructionSet::avx2) return in_lanes(&detail::grid_in_lanes<InstructionSet::avx2>);
#endif
  in_lanes(&detail::grid_in_lanes<InstructionSet::baseline>);
}

}  // namespace v0
}  // namespace polhode
