// SPDX-License-Identifier: MIT
#include "polhode/dynamics/detail/sample_queue.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

// More than that of SaveAt::steps.
constexpr double slack = 8.0 * std::numeric_limits<double>::epsilon();

}  // namespace

DueTimes::DueTimes(double start, double stop, std::optional<SaveAt> times)
    : forward_(start <= stop),
      stop_(stop),
      reach_of_stop_(stop + (forward_ ? 1.0 : -1.0) * slack *
                                std::fmax(std::fabs(start), std::fabs(stop))),
      times_(std::move(times)) {
  if (!times_) return;
  while (!is_done() && is_before(due(), start)) ++next_;
  // the whole list before the first step: a run of hours must not end in this message
  const std::int64_t checked =
      times_->is_list() ? times_->size() : std::min(times_->size(), next_ + 2);
  for (std::int64_t k = next_ + 1; k < checked; ++k)
    if (is_before((*times_)[k], (*times_)[k - 1]))
      throw DomainError("integrate: sample times must run from start " + number_text(start) +
                        " to stop " + number_text(stop) + ": " + number_text((*times_)[k]) +
                        " comes after " + number_text((*times_)[k - 1]));
}

std::optional<double> DueTimes::last() const {
  if (is_done()) return std::nullopt;
  const double last = (*times_)[times_->size() - 1];
  return is_before(last, stop_) ? std::optional(last) : std::nullopt;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
