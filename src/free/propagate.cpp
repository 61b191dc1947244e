// SPDX-License-Identifier: MIT
#include "polhode/free/propagate.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <string>

#include "free/detail/body_lanes_declared.hpp"
#include "polhode/error.hpp"
#include "polhode/free/prepare.hpp"

namespace polhode {
inline namespace v0 {
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
