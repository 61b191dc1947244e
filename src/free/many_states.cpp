// SPDX-License-Identifier: MIT
// Free rotation of many states: one motion at many times or on an even grid of times, and many
// bodies at one time each.
#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <string>

#include "free/detail/lanes_declared.hpp"
#include "free/prepare.hpp"
#include "polhode/detail/free/states_at.hpp"
#include "polhode/detail/free/states_on_grid.hpp"
#include "polhode/error.hpp"
#include "polhode/free/detail/normalized_arc.hpp"
#include "polhode/free/propagate.hpp"
#include "polhode/math/double_double.hpp"

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

namespace {

constexpr std::size_t most_at_once = 1024;

void require_supported(InstructionSet set) {
  if (!supports(set))
    throw DomainError("propagate: got " + std::string(instruction_set_name(set)) +
                      "; expected instructions that this processor has");
}

const double* row(const NumberRows& rows, std::size_t i) { return rows.first + i * rows.step; }

NumberRows from(const NumberRows& rows, std::size_t i) { return {row(rows, i), rows.step}; }

// What lanes left over, as FreeRotation.
RotorState one_by_one(const BodyRows& rows, std::size_t i) {
  const double *I = row(rows.moments, i), *s = row(rows.states, i);
  const RotorState state{{s[0], s[1], s[2], s[3]}, {s[4], s[5], s[6]}};
  return evaluate(prepare(Body(I[0], I[1], I[2]), state, *row(rows.epochs, i)),
                  *row(rows.times, i));
}

void in_lanes(const BodyRows& rows, std::span<RotorState> results, bool* left,
              [[maybe_unused]] InstructionSet set) {
#if defined(__x86_64__)
  if (set == InstructionSet::avx512)
    return detail::bodies_in_lanes<InstructionSet::avx512>(rows, results, left);
  if (set == InstructionSet::avx2)
    return detail::bodies_in_lanes<InstructionSet::avx2>(rows, results, left);
#endif
  detail::bodies_in_lanes<InstructionSet::baseline>(rows, results, left);
}

void require_fitting(const char* what, std::size_t got, std::size_t results) {
  if (got != results && got != 1)
    throw DomainError("propagate: got " + std::to_string(got) + " " + what + " and room for " +
                      std::to_string(results) + " results; expected as many, or one for all");
}

}  // namespace

std::vector<FailedBody> propagate(const BodyRows& rows, std::span<RotorState> results,
                                  InstructionSet set) {
  require_supported(set);
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<FailedBody> failed;
  for (std::size_t first = 0; first < results.size(); first += most_at_once) {
    const auto part = results.subspan(first, std::min(most_at_once, results.size() - first));
    const BodyRows of_part{from(rows.moments, first), from(rows.states, first),
                           from(rows.times, first), from(rows.epochs, first)};
    std::array<bool, most_at_once> left;
    std::fill_n(left.begin(), part.size(), true);
    in_lanes(of_part, part, left.data(), set);
    for (std::size_t i = 0; i < part.size(); ++i) {
      if (!left[i]) continue;
      try {
        part[i] = one_by_one(of_part, i);
      } catch (const DomainError& e) {
        part[i] = {{nan, nan, nan, nan}, {nan, nan, nan}};
        failed.push_back({first + i, e.what()});
      }
    }
  }
  return failed;
}

std::vector<FailedBody> propagate(std::span<const Body> bodies, std::span<const RotorState> states,
                                  std::span<const double> times, double t0,
                                  std::span<RotorState> results, InstructionSet set) {
  require_supported(set);
  const std::size_t n = results.size();
  require_fitting("bodies", bodies.size(), n);
  require_fitting("states", states.size(), n);
  require_fitting("times", times.size(), n);
  if (n == 0) return {};
  static_assert(sizeof(Body) % sizeof(double) == 0 && sizeof(RotorState) == 7 * sizeof(double));
  const auto step = [n](std::size_t given, std::size_t size) {
    return given == n ? size / sizeof(double) : 0;
  };
  return propagate({{&bodies[0].moments().x, step(bodies.size(), sizeof(Body))},
                    {&states[0].q.w, step(states.size(), sizeof(RotorState))},
                    {&times[0], step(times.size(), sizeof(double))},
                    {&t0, 0}},
                   results, set);
}

}  // namespace v0
}  // namespace polhode
