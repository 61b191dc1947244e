// SPDX-License-Identifier: MIT
// AdaptiveRungeKutta: steps of an explicit pair under error control.
//
// Equations   proportional-integral control of the step (Gustafsson 1991; Hairer, Norsett and
//             Wanner II.4): h' = 0.9 h (tol / err)^(0.7 / p) (err_before / tol)^(0.4 / p), err ~
//             h^p; first step by the same book's rule.
// Units       those of the problem.
// Domain      f as in runge_kutta.hpp. `size` is a callable of (error, y, increment): the error of
//             a step from y in the measure of the tolerance. largest_step = first_step with a loose
//             tolerance is a fixed step.
// Accuracy    one step errs by about the tolerance or less. Where the estimate sinks in rounding,
//             near tolerance 1e-15 in double, a step is good when its error is below the rounding
//             of its own increment: steps do not collapse. A jump of f is passed by a step at the
//             rounding of t where the tolerance asks for less: nothing shorter could be made.
// Errors      none: advance says what happened. What f throws passes through, the state is then
//             that of the last step made.
// Cost        as many calls of f as stages each step, one less for a repeated one.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "polhode/detail/ode/runge_kutta.hpp"
#include "polhode/detail/ode/step_control.hpp"
#include "polhode/ode/detail/least_steps.hpp"

namespace polhode {
inline namespace v0 {

enum class StepOutcome {
  made,
  not_finite,  // no step, however small, gives finite numbers
  too_small,   // steps at the rounding of t, one after the other, are still too long
};

template <class Tableau, Real T, std::size_t N, class F, class Size>
class AdaptiveRungeKutta {
 public:
  using Values = std::array<T, N>;

  AdaptiveRungeKutta(F f, Size size, double t, const Values& y, const StepControl& control)
      : f_(std::move(f)),
        size_(std::move(size)),
        control_(control),
        h_(control.first_step),
        t_(t),
        state_{y} {}

  // One step towards `stop`, ending there or before.
  StepOutcome advance(double stop) {
    const DoubleDouble rest = DoubleDouble(stop) - t_;
    if (!rate_known_) {
      rate_ = called(t_, state_.y);
      rate_known_ = true;
    }
    if (!(h_ > 0.0)) h_ = first_step(rest.hi);
    StepOutcome why = StepOutcome::too_small;
    for (bool repeated = false;; repeated = true) {
      double length = step_towards(std::abs(rest.hi), h_, control_);
      const bool is_least = length < smallest_step(t_) && length < std::abs(rest.hi);
      if (is_least) {
        if (least_steps_ >= detail::most_least_steps || why != StepOutcome::too_small) return why;
        length = std::min(smallest_step(t_), std::abs(rest.hi));
      }
      trial_ = std::copysign(length, rest.hi);
      const auto step = runge_kutta_step<Tableau>(f_, t_, state_.y, rate_, trial_);
      evaluations_ += Tableau::stages - 1;
      const double error = size_(step.error, state_.y, step.increment);
      // In units of what can be asked for: the tolerance, or the rounding of the increment.
      const double excess =
          error / std::max(control_.tolerance,
                           8.0 * epsilon<T>() * size_(step.increment, state_.y, step.increment));
      if (excess <= 1.0 ||
          (is_least && std::isfinite(excess) &&
           size_(step.increment, state_.y, Values{}) < detail::largest_least_step)) {
        const bool ends = length == std::abs(rest.hi);
        state_.add(step.increment);
        t_ = ends ? DoubleDouble(stop) : t_ + trial_;
        rate_known_ = false;
        ++steps_;
        least_steps_ = excess <= 1.0 ? 0 : least_steps_ + 1;
        // A step cut short by the end says little of the next one.
        if (!ends || length > h_) h_ = length;
        h_ = h_ * accepted_factor(std::min(excess, 1.0), repeated);
        return StepOutcome::made;
      }
      ++rejected_;
      why = std::isfinite(excess) ? StepOutcome::too_small : StepOutcome::not_finite;
      if (is_least) return why;
      h_ = length * rejected_factor(excess);
    }
  }

  // Where a step begins: what its owner keeps to go back there.
  struct Savepoint {
    DoubleDouble t;
    CompensatedState<T, N> state;
    double before;
  };
  Savepoint savepoint() const { return {t_, state_, before_}; }
  // Back to where the step made last began, as if it had not been made. The next one is as long as
  // it was, or shorter; the work counts.
  void roll_back(const Savepoint& savepoint) {
    t_ = savepoint.t;
    state_ = savepoint.state;
    before_ = savepoint.before;
    h_ = std::abs(trial_);
    rate_known_ = false;
    --steps_;
    ++rejected_;
  }
  // f where the step made last began.
  const Values& rate_before() const { return rate_; }

  const DoubleDouble& time() const { return t_; }
  const CompensatedState<T, N>& state() const { return state_; }
  // For invariants that the owner restores between steps.
  CompensatedState<T, N>& state() { return state_; }
  const F& field() const { return f_; }
  // For what of f its owner changes between steps.
  F& field() { return f_; }
  // From the next step on, none is longer.
  void limit_steps(double largest) { control_.largest_step = largest; }
  // The step tried last, with its sign.
  double trial() const { return trial_; }

  std::int64_t steps() const { return steps_; }
  std::int64_t rejected() const { return rejected_; }
  std::int64_t evaluations() const { return evaluations_; }
  // Calls of f that its owner made in addition to the steps.
  void count(std::int64_t evaluations) { evaluations_ += evaluations; }

  // Every number that the steps to come depend on, between two steps, by reference: `visit` keeps
  // them or puts them back.
  template <class Visit>
  void serialize(Visit& visit) {
    visit.all(h_, t_, state_.y, state_.carry, before_, trial_, least_steps_, steps_, rejected_,
              evaluations_);
    rate_known_ = false;  // as after every step
  }

 private:
  static constexpr double exponent = 1.0 / Tableau::error_order;

  Values called(const DoubleDouble& t, const Values& y) {
    ++evaluations_;
    return f_(t, y);
  }

  double first_step(double rest) {
    const double d1 = size_(rate_, state_.y, Values{});
    if (!(d1 > 0.0) || !std::isfinite(d1)) return std::abs(rest);
    const double h0 = std::min(0.01 / d1, std::abs(rest));
    const double h = std::copysign(h0, rest);
    Values change = called(t_ + h, detail::moved(state_.y, h, rate_));
    for (std::size_t i = 0; i < N; ++i) change[i] = change[i] - rate_[i];
    const double d2 = size_(change, state_.y, Values{}) / h0;
    if (!std::isfinite(d2)) return h0;
    return std::min(100.0 * h0, std::pow(0.01 * control_.tolerance / std::max(d1, d2), exponent));
  }

  double accepted_factor(double excess, bool repeated) {
    const double ratio = std::log2(std::max(excess, 1e-10));
    const double factor = 0.9 * std::exp2(exponent * (0.4 * before_ - 0.7 * ratio));
    before_ = std::max(ratio, -13.0);  // 1e-4, as usual: a lucky step is soon forgotten
    return std::clamp(factor, 0.2, repeated ? 1.0 : 5.0);
  }

  static double rejected_factor(double excess) {
    if (!std::isfinite(excess)) return 0.1;
    return std::clamp(0.9 * std::pow(excess, -exponent), 0.1, 0.9);
  }

  F f_;
  Size size_;
  StepControl control_;
  double h_;
  DoubleDouble t_;
  CompensatedState<T, N> state_;
  Values rate_{};
  bool rate_known_ = false;
  double before_ = 0.0;  // log2 of the last error over what was asked for
  double trial_ = 0.0;
  int least_steps_ = 0;  // steps in a row that were too long and could not be shorter
  std::int64_t steps_ = 0;
  std::int64_t rejected_ = 0;
  std::int64_t evaluations_ = 0;
};

}  // namespace v0
}  // namespace polhode
