// SPDX-License-Identifier: MIT
// Sample times and trajectories: their checks.
#include "polhode/trajectory/trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/math/double_double.hpp"
#include "polhode/trajectory/save_at.hpp"

namespace polhode {
inline namespace v0 {

namespace {

constexpr double most_rows = 9007199254740992.0;  // 2^53: every k is a double

void require_finite(double start, double stop) {
  if (!std::isfinite(start) || !std::isfinite(stop) || !std::isfinite(stop - start))
    throw DomainError("SaveAt: start " + detail::number_text(start) + " and stop " +
                      detail::number_text(stop) + " must be finite");
}

}  // namespace

SaveAt SaveAt::steps(double start, double stop, double step) {
  require_finite(start, stop);
  const double span = stop - start;
  if (!std::isfinite(step) || step == 0.0 || span / step < 0.0)
    throw DomainError("SaveAt: a step of " + detail::number_text(step) + " does not lead from " +
                      detail::number_text(start) + " to " + detail::number_text(stop) +
                      "; expected one that is not 0 and has the sign of stop - start");
  // 3 * 0.1 is beyond 0.3 by one unit in the last place, and is meant to be there
  const double slack =
      4.0 * std::numeric_limits<double>::epsilon() * std::fmax(std::fabs(start), std::fabs(stop));
  const double beyond = std::floor(span / step) + 2.0;
  if (!(beyond < most_rows))
    throw DomainError("SaveAt: a step of " + detail::number_text(step) +
                      " makes more than 2^53 rows");
  double last = std::fmax(0.0, beyond - 4.0);
  const auto inside = [&](double k) {
    const double t = std::fma(k, step, start);
    return step > 0.0 ? t <= stop + slack : t >= stop - slack;
  };
  while (last < beyond && inside(last + 1.0)) last += 1.0;  // at most six times
  SaveAt result;
  result.start_ = start;
  result.stop_ = stop;
  result.step_ = step;
  result.size_ = static_cast<std::int64_t>(last) + 1;
  return result;
}

SaveAt SaveAt::count(double start, double stop, std::int64_t rows) {
  require_finite(start, stop);
  if (rows < 1 || static_cast<double>(rows) > most_rows)
    throw DomainError("SaveAt: a count of " + std::to_string(rows) + " is not from 1 to 2^53");
  if (rows == 1 && start != stop) throw DomainError("SaveAt: a count of 1 needs start = stop");
  SaveAt result;
  result.start_ = start;
  result.stop_ = stop;
  result.size_ = rows;
  return result;
}

SaveAt SaveAt::times(std::vector<double> at) {
  for (const double t : at)
    if (!std::isfinite(t))
      throw DomainError("SaveAt: time " + detail::number_text(t) + " must be finite");
  SaveAt result;
  result.size_ = static_cast<std::int64_t>(at.size());
  result.at_ = std::move(at);
  return result;
}

double SaveAt::end() const {
  const double last = (*this)[size_ - 1];
  if (is_list()) return last;
  // a whole number of steps, to the rounding of start and stop
  constexpr double roundings = 4.0 * std::numeric_limits<double>::epsilon();
  if (std::fabs(stop_ - last) <= roundings * std::fmax(std::fabs(start_), std::fabs(stop_)))
    return last;
  return start_ <= stop_ ? std::fmax(last, stop_) : std::fmin(last, stop_);
}

double SaveAt::operator[](std::int64_t k) const {
  if (!at_.empty()) return at_[static_cast<std::size_t>(k)];
  const double row = static_cast<double>(k);
  if (step_ != 0.0) return std::fma(row, step_, start_);
  if (k == 0) return start_;
  if (k == size_ - 1) return stop_;
  const DoubleDouble span = DoubleDouble::sum(stop_, -start_);
  return static_cast<double>(start_ + span * row / DoubleDouble(static_cast<double>(size_ - 1)));
}

void require_inside(double t, double start, double stop) {
  const double low = std::min(start, stop), high = std::max(start, stop);
  if (!(low <= t && t <= high))
    throw DomainError("Trajectory::at: t = " + detail::number_text(t) + " must be from " +
                      detail::number_text(low) + " to " + detail::number_text(high));
}

void no_dense_output() {
  throw DomainError(
      "Trajectory::at: no dense output: the run was not asked for it (dense), or its samples "
      "alone were saved");
}

template class BasicTrajectory<SystemState>;

}  // namespace v0
}  // namespace polhode
