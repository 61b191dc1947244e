// SPDX-License-Identifier: MIT
// Steps by Gauss collocation, solved by sweeps, under control or of one length.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "dynamics/adaptive/switching_functions.hpp"
#include "dynamics/collocation/rotor_stages.hpp"
#include "dynamics/collocation/step_control.hpp"
#include "math/number_text.hpp"
#include "polhode/detail/ode/adaptive_runge_kutta.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// `Stages`: see rotor_stages.hpp.
template <class Stages>
class BasicCollocationSolver {
 public:
  using StagesOf = Stages;
  using Values = typename Stages::Values;
  using State = typename Stages::State;
  using Rates = typename Stages::Rates;
  using Polynomial = StepPolynomial<Stages>;

  BasicCollocationSolver(std::shared_ptr<const typename Stages::Field> field, std::size_t stages,
                         InstructionSet set, double t, const Values& y,
                         const CollocationControl& control)
      : rates_{field},
        set_(set),
        stages_(std::move(field), stages, set),
        control_(control),
        next_(control, stages),
        t_(t),
        state_{y, zeros_like(y)},
        polynomials_{Polynomial{{}, state_, 0.0, blank(stages_)},
                     Polynomial{{}, state_, 0.0, blank(stages_)}} {}

  // One step towards `stop`, ending there or before.
  StepOutcome advance(double stop) {
    stop_ = stop;
    rest_ = (DoubleDouble(stop) - t_).hi;
    if (!(next_.h > 0.0)) next_.h = first_step(rest_);
    repeated_ = false;
    try_step(next_.towards(std::abs(rest_)));
    for (;;) {
      sweeps_ = 0;
      const SweepsEnd end = swept_by(stages_, sweeps_);
      if (const std::optional<StepOutcome> outcome = ended(end)) return *outcome;
    }
  }

  struct Savepoint {
    DoubleDouble t;
    State state;
    Polynomial last;
  };
  Savepoint savepoint() const { return {t_, state_, last()}; }
  // Back to where the step made last began, as if it had not been made. The next one is as long as
  // it was, or shorter; the work counts.
  void roll_back(const Savepoint& savepoint) {
    t_ = savepoint.t;
    state_ = savepoint.state;
    polynomials_[last_] = savepoint.last;
    refined_.h = 0.0;
    if (!control_.is_fixed) next_.cut(std::abs(trial_));
    --steps_;
    ++rejected_;
  }

  const DoubleDouble& time() const { return t_; }
  const State& state() const { return state_; }
  // For what their owner restores or changes between steps.
  State& state() { return state_; }
  const Rates& field() const { return rates_; }
  Rates& field() { return rates_; }
  // How long the next step is to be, where it is under control.
  double wanted() const { return control_.is_fixed ? 0.0 : next_.h; }
  void want(double length) {
    if (!control_.is_fixed) next_.h = std::min(length, next_.largest_step());
  }
  // From the next step on, none under control is longer.
  void limit_steps(double largest) { next_.limit(largest); }
  // Why a step was not made, where it is the solver that cannot make it; else empty.
  std::string refusal(StepOutcome outcome) const {
    if (!control_.is_fixed || outcome != StepOutcome::too_small) return {};
    return "the sweeps of a step of " + number_text(std::abs(trial_)) +
           " from t = " + number_text(t_.hi) +
           " do not converge: take a shorter step, or leave it out for steps under control";
  }
  EdgeRule edge_rule() const { return {control_.step.tolerance, power_error(stages_.scheme())}; }
  double trial() const { return trial_; }
  std::size_t stages() const { return stages_.scheme().stages; }
  // The step made last.
  const Polynomial& last() const { return polynomials_[last_]; }
  // The same step by twice as many stages. A polynomial of s stages is of order s + 1 inside the
  // step, though its end is of order 2 s; this one is of order 2 s + 1 all along.
  const Polynomial& refined() {
    const Polynomial& step = last();
    if (refined_.h != 0.0) return refined_;
    if (!fine_) {
      fine_ = std::make_unique<Stages>(rates_.field, 2 * stages(), set_);
      in_fine_ = refinement(stages_.scheme(), fine_->scheme());
      refined_.rates = blank(*fine_);
    }
    fine_->begin(step.t, step.start, step.h, rates_.sides.get());
    fine_->guess(step.rates, in_fine_, stages_);
    std::int64_t sweeps = 0;
    const SweepsEnd end = swept_by(*fine_, sweeps);
    if (!is_counted_) evaluations_ += sweeps * static_cast<std::int64_t>(2 * stages());
    is_counted_ = true;
    refined_.t = step.t;
    refined_.start = step.start;
    refined_.h = step.h;
    if (end == SweepsEnd::converged)
      fine_->coefficients(refined_.rates);
    else
      refined_.rates = step.rates;
    return refined_;
  }

  std::int64_t steps() const { return steps_; }
  std::int64_t rejected() const { return rejected_; }
  std::int64_t evaluations() const { return evaluations_; }
  void count(std::int64_t evaluations) { evaluations_ += evaluations; }

  template <class Visit>
  void serialize(Visit& visit) {
    visit.all(next_.h, t_, state_.y, state_.carry, trial_, steps_, rejected_, evaluations_);
    next_.serialize(visit);
    visit(is_counted_);
    refined_.h = 0.0;
    Polynomial& step = polynomials_[last_];
    visit.all(step.t, step.start.y, step.start.carry, step.h);
    for (StageRow& row : step.rates) visit.all(static_cast<std::array<double, most_stages>&>(row));
  }

 private:
  // Of all motions that are solved one after the other.
  static constexpr std::int64_t slow_sweeps = [] {
    if constexpr (requires { Stages::motions; })
      return 18 * Stages::motions;
    else
      return 18;
  }();

  // Sweeps go on until they change no more than that.
  double enough() const { return control_.is_fixed ? 0.0 : 0.01 * control_.step.tolerance; }
  typename Stages::Rows blank(const Stages& stages) const { return stages.blank(state_.y.size()); }

  SweepsEnd swept_by(Stages& stages, std::int64_t& sweeps) const {
    if constexpr (requires { stages.solved(enough(), sweeps); })
      return stages.solved(enough(), sweeps);
    else
      return swept(stages, enough(), sweeps);
  }
  void try_step(double length) {
    trial_ = std::copysign(length, rest_);
    stages_.begin(t_, state_, trial_, rates_.sides.get());
    is_guessed_ = guessed(trial_);
    if (!is_guessed_) stages_.guess_start();
  }
  // What has come of the step that was tried.
  std::optional<StepOutcome> ended(SweepsEnd end) {
    if (is_guessed_ && end != SweepsEnd::converged) {  // a guess that led nowhere
      stages_.guess_start();
      end = swept_by(stages_, sweeps_);
    }
    const double length = std::abs(trial_);
    StepOutcome why = StepOutcome::too_small;
    evaluations_ += sweeps_ * static_cast<std::int64_t>(stages_.scheme().stages);
    if (end == SweepsEnd::converged) {
      Polynomial& step = polynomials_[1 - last_];
      stages_.coefficients(step.rates);
      const State next = stages_.finished();
      const double error = estimate(step.rates, next);
      if (std::isfinite(error) && (control_.is_fixed || error <= control_.step.tolerance)) {
        made(step, next, length == std::abs(rest_));
        if (!control_.is_fixed) next_.made(length, error, repeated_, sweeps_ > slow_sweeps);
        return StepOutcome::made;
      }
      if (!std::isfinite(error)) why = StepOutcome::not_finite;
      next_.shorten(length, error);
    } else {
      if (end == SweepsEnd::not_finite) why = StepOutcome::not_finite;
      if (!control_.is_fixed) next_.h = 0.5 * length;
    }
    ++rejected_;
    repeated_ = true;
    const double shorter = next_.towards(std::abs(rest_));
    if (control_.is_fixed || shorter < smallest_step(t_)) return why;
    try_step(shorter);
    return std::nullopt;
  }
  // By the polynomial of the last step, if there is any; far beyond its step it says nothing.
  bool guessed(double h) {
    const double ratio = last().h == 0.0 ? 0.0 : h / last().h;
    if (!(0.0 < ratio && ratio < 2.0)) return false;
    if (ratio != ratio_) {
      at_stages_ = continuation(stages_.scheme(), ratio);
      ratio_ = ratio;
    }
    stages_.guess(last().rates, at_stages_, stages_);
    return true;
  }

  void made(Polynomial& step, const State& next, bool ends) {
    step.t = t_;
    step.start = state_;
    step.h = trial_;
    last_ = 1 - last_;
    refined_.h = 0.0;
    is_counted_ = false;
    state_ = next;
    t_ = ends ? DoubleDouble(stop_) : t_ + stages_.length();
    ++steps_;
  }

  double estimate(const typename Stages::Rows& rates, const State& next) {
    Values increment = zeros_like(state_.y);
    for (std::size_t n = 0; n < rates.size(); ++n) increment[n] = next.y[n] - state_.y[n];
    const StepEstimate<typename Stages::Field, Values> error{*rates_.field, stages(), trial_,
                                                             state_.y, increment};
    const double whole = error.of_motion(rates);
    if constexpr (requires { stages_.drive(drive_); }) {
      if (!stages_.drive(drive_)) return whole;
      const double known = larger(whole, error.of_effects(drive_, stages_.has_unnamed_kinks()));
      if (control_.is_fixed || stages_.is_smooth() || !(known <= control_.step.tolerance))
        return known;
      evaluations_ += 2;
      const auto effects = [&](const DoubleDouble& t, const Values& y) {
        return stages_.effects(rates_.stretch.inside(t), y, rates_.sides.get());
      };
      return larger(known, error.of_ends(drive_, effects(t_, state_.y),
                                         effects(t_ + trial_, next.y), stages_.scheme().c[0]));
    } else {
      return larger(whole, error.of_tail(rates));
    }
  }
  // Half a radian, or what the terms need to make half of the momentum.
  double first_step(double rest) {
    ++evaluations_;
    const double rate =
        rates_.field->error_size(rates_(t_, state_.y), state_.y, zeros_like(state_.y));
    const double whole = std::min(std::abs(rest), next_.largest_step());
    return rate > 0.0 && std::isfinite(rate) ? std::min(0.5 / rate, whole) : whole;
  }

  Rates rates_;
  InstructionSet set_;
  Stages stages_;
  std::unique_ptr<Stages> fine_;  // of twice as many stages
  StageMatrix in_fine_{};
  DriveRows drive_{};   // of the step tried last
  Polynomial refined_;  // of the step made last; h = 0 until it is asked for
  // What it took, once: a run that goes on from a checkpoint refines again.
  bool is_counted_ = false;
  CollocationControl control_;
  StepChoice next_;
  DoubleDouble t_;
  State state_;
  std::array<Polynomial, 2> polynomials_;  // of the step made last, and room for the next
  std::size_t last_ = 0;
  double ratio_ = 0.0;
  StageMatrix at_stages_{};
  // Of the step that is tried: where it may end, the way to there, whether one was tried before,
  // and whether the last polynomial has said how it may go.
  double stop_ = 0.0, rest_ = 0.0;
  bool repeated_ = false, is_guessed_ = false;
  double trial_ = 0.0;       // the step tried last, with its sign
  std::int64_t sweeps_ = 0;  // of the step tried last
  std::int64_t steps_ = 0;
  std::int64_t rejected_ = 0;
  std::int64_t evaluations_ = 0;
};

using CollocationSolver = BasicCollocationSolver<RotorStages>;

}  // namespace detail
}  // namespace v0
}  // namespace polhode
