// SPDX-License-Identifier: MIT
// The loop of a run: its span, the times of its samples, and when it is given up.
#include "polhode/dynamics/detail/run.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include "math/number_text.hpp"
#include "polhode/dynamics/detail/finite_span.hpp"
#include "polhode/dynamics/detail/sample_queue.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

void require_finite_span(const std::string& function, double start, double stop) {
  if (!std::isfinite(start) || !std::isfinite(stop))
    throw DomainError(function + ": start " + number_text(start) + " and stop " +
                      number_text(stop) + " must be finite");
}

FiniteSpan::FiniteSpan(double start, double stop) { require_finite_span("Problem", start, stop); }

namespace {

// More than that of SaveAt::steps.
constexpr double slack = 8.0 * std::numeric_limits<double>::epsilon();
// A run does not end that would need this many steps of the length that its last ones had: 1e12 of
// a microsecond are twelve days.
constexpr double most_steps = 1e12;
// The last ones: a step that a jump of a torque has cut is followed by longer ones long before.
constexpr std::int64_t settled = 1000;

}  // namespace

DueTimes::DueTimes(double start, double stop, std::optional<SaveAt> times, bool allows_any_order)
    : forward_(start <= stop),
      stop_(stop),
      reach_of_stop_(stop + (forward_ ? 1.0 : -1.0) * slack *
                                std::fmax(std::fabs(start), std::fabs(stop))),
      times_(std::move(times)) {
  if (!times_) return;
  const auto is_before_last = [&](std::int64_t k) {
    return is_before((*times_)[k], (*times_)[k - 1]);
  };
  if (allows_any_order && times_->is_list())
    for (std::int64_t k = 1; k < times_->size(); ++k)
      is_unordered_ = is_unordered_ || is_before_last(k);
  find_due();
  if (is_unordered_) return;
  while (!is_done() && is_before(due(), start)) pass();
  // the whole list before the first step: a run of hours must not end in this message
  const std::int64_t checked =
      times_->is_list() ? times_->size() : std::min(times_->size(), next_ + 2);
  for (std::int64_t k = next_ + 1; k < checked; ++k)
    if (is_before_last(k))
      throw DomainError("integrate: sample times must run from start " + number_text(start) +
                        " to stop " + number_text(stop) + ": " + number_text((*times_)[k]) +
                        " comes after " + number_text((*times_)[k - 1]));
}

std::optional<double> DueTimes::last() const {
  if (is_done()) return std::nullopt;
  const double last = (*times_)[times_->size() - 1];
  return is_before(last, stop_) ? std::optional(last) : std::nullopt;
}

std::string full_text(double most_bytes, double t) {
  return "the steps up to t = " + number_text(t) + " fill the " + number_text(most_bytes) +
         " bytes that a trajectory may take in memory (most_bytes): take samples at fewer times "
         "and no dense output, a shorter run, or a higher limit";
}

std::string EndJudge::judged(double t, double stop, std::int64_t steps) {
  if (steps < steps_ + settled) return {};
  const double made = std::abs(t - t_) / static_cast<double>(steps - steps_);
  const double left = std::abs(stop - t);
  steps_ = steps;
  t_ = t;
  if (!(left > most_steps * made)) return {};
  double power = std::pow(10.0, std::floor(std::log10(left / made)));
  if (power * made > left) power *= 0.1;  // its logarithm was rounded up
  return "at t = " + number_text(t) + " the last " + number_text(settled) + " steps are " +
         number_text(made) + " each, so reaching the end would take " + number_text(power) +
         " of them and more: is the rotation, an orbit or a torque that fast, does it grow, or is "
         "a damping that stiff? Try a shorter run";
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
