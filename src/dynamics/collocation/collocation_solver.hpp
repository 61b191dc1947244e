// SPDX-License-Identifier: MIT
// Steps by Gauss collocation, solved by sweeps, under control or of one length.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "dynamics/adaptive/breakpoints.hpp"
#include "dynamics/collocation/step_polynomial.hpp"
#include "dynamics/collocation/sweeps.hpp"
#include "math/number_text.hpp"
#include "polhode/ode/adaptive_runge_kutta.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

class CollocationSolver {
 public:
  using Values = RotorStages::Values;
  using State = RotorStages::State;
  using Rates = SmoothField<RotorStages::Field>;

  CollocationSolver(std::shared_ptr<const RotorStages::Field> field, std::size_t stages,
                    InstructionSet set, double t, const Values& y,
                    const CollocationControl& control)
      : rates_{field},
        set_(set),
        stages_(std::move(field), stages, set),
        control_(control),
        h_(control.step.first_step),
        t_(t),
        state_{y} {}

  // One step towards `stop`, ending there or before.
  StepOutcome advance(double stop) {
    begin(stop);
    for (;;) {
      SweepJudge judge(enough());
      while (judge.goes_on()) judge.see(stages_.sweep());
      if (const std::optional<StepOutcome> outcome = solved(judge)) return *outcome;
    }
  }
  // The same piece by piece: what is tried is there to be solved,
  void begin(double stop) {
    stop_ = stop;
    rest_ = (DoubleDouble(stop) - t_).hi;
    if (!(h_ > 0.0)) h_ = first_step(rest_);
    repeated_ = false;
    try_step(length_of_step());
  }
  RotorStages& tried() { return stages_; }
  // by sweeps until they change no more than that;
  double enough() const { return control_.is_fixed ? 0.0 : 0.01 * control_.step.tolerance; }
  // nothing while there is another to solve.
  std::optional<StepOutcome> solved(const SweepJudge& judge) {
    StepOutcome why = StepOutcome::too_small;
    const double length = std::abs(trial_);
    const SweepsEnd end = settled(judge);
    evaluations_ += sweeps_ * static_cast<std::int64_t>(stages_.scheme().stages);
    if (end == SweepsEnd::converged) {
      StepPolynomial& step = polynomials_[1 - last_];
      stages_.coefficients(step.rates);
      const State next = stages_.finished();
      const double error = estimate(step.rates, next);
      if (std::isfinite(error) && (control_.is_fixed || error <= control_.step.tolerance)) {
        made(step, next, length == std::abs(rest_), stop_);
        if (!control_.is_fixed) choose_next(length, error, repeated_);
        return StepOutcome::made;
      }
      if (!std::isfinite(error)) why = StepOutcome::not_finite;
      h_ = length * std::min(wanted(error), 0.9);
    } else {
      if (end == SweepsEnd::not_finite) why = StepOutcome::not_finite;
      if (!control_.is_fixed) h_ = 0.5 * length;
    }
    ++rejected_;
    repeated_ = true;
    const double next = length_of_step();
    if (control_.is_fixed || next < smallest_step(t_)) return why;
    try_step(next);
    return std::nullopt;
  }

  struct Savepoint {
    DoubleDouble t;
    State state;
    StepPolynomial last;
  };
  Savepoint savepoint() const { return {t_, state_, last()}; }
  // Back to where the step made last began, as if it had not been made. The next one is as long as
  // it was, or shorter; the work counts.
  void roll_back(const Savepoint& savepoint) {
    t_ = savepoint.t;
    state_ = savepoint.state;
    polynomials_[last_] = savepoint.last;
    refined_.h = 0.0;
    if (!control_.is_fixed) h_ = std::abs(trial_);
    --steps_;
    ++rejected_;
  }

  const DoubleDouble& time() const { return t_; }
  const State& state() const { return state_; }
  const Rates& field() const { return rates_; }
  // For what of it its owner changes between steps.
  Rates& field() { return rates_; }
  // Why a step was not made, where it is the solver that cannot make it; else empty.
  std::string refusal(StepOutcome outcome) const {
    if (!control_.is_fixed || outcome != StepOutcome::too_small) return {};
    return "the sweeps of a step of " + number_text(std::abs(trial_)) +
           " from t = " + number_text(t_.hi) +
           " do not converge: take a shorter step, or leave it out for steps under control";
  }
  // The step tried last, with its sign.
  double trial() const { return trial_; }
  std::size_t stages() const { return stages_.scheme().stages; }
  // The step made last.
  const StepPolynomial& last() const { return polynomials_[last_]; }
  // The same step by twice as many stages. A polynomial of s stages is of order s + 1 inside the
  // step, though its end is of order 2 s; this one is of order 2 s + 1 all along.
  const StepPolynomial& refined() {
    const StepPolynomial& step = last();
    if (refined_.h != 0.0) return refined_;
    if (!fine_) {
      fine_ = std::make_unique<RotorStages>(rates_.field, 2 * stages(), set_);
      in_fine_ = refinement(stages_.scheme(), fine_->scheme());
    }
    fine_->begin(step.t, step.start, step.h, rates_.sides.get());
    fine_->guess(step.rates, in_fine_, stages_.lanes());
    std::int64_t sweeps = 0;
    const SweepsEnd end = swept(*fine_, enough(), sweeps);
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
  void transfer(Visit& visit) {
    visit.all(h_, t_, state_.y, state_.carry, trial_, steps_, rejected_, evaluations_,
              largest_error_, since_, patience_, is_counted_);
    refined_.h = 0.0;
    StepPolynomial& step = polynomials_[last_];
    visit.all(step.t, step.start.y, step.start.carry, step.h);
    for (StageRow& row : step.rates) visit.all(static_cast<std::array<double, most_stages>&>(row));
  }

 private:
  static constexpr double safety = 0.9;
  static constexpr std::int64_t slow_sweeps = 18;

  // Of fixed steps; no sliver is left for the end.
  double whole_step(double rest) const { return h_ * (1.0 + 1e-9) < rest ? h_ : rest; }

  double length_of_step() const {
    return control_.is_fixed ? whole_step(std::abs(rest_))
                             : step_towards(std::abs(rest_), h_, control_.step);
  }
  void try_step(double length) {
    trial_ = std::copysign(length, rest_);
    stages_.begin(t_, state_, trial_, rates_.sides.get());
    guessed_ = guessed(trial_);
    if (!guessed_) stages_.guess_start();
  }
  // Where a guess has led nowhere, from the start of the step.
  SweepsEnd settled(const SweepJudge& judge) {
    sweeps_ = judge.sweeps();
    if (!guessed_ || judge.end() == SweepsEnd::converged) return judge.end();
    stages_.guess_start();
    return swept(stages_, enough(), sweeps_);
  }
  // By the polynomial of the last step, if there is any; far beyond its step it says nothing.
  bool guessed(double h) {
    const GaussScheme& scheme = stages_.scheme();
    const double ratio = last().h == 0.0 ? 0.0 : h / last().h;
    if (!(0.0 < ratio && ratio < 2.0)) return false;
    if (ratio != ratio_) {
      at_stages_ = continuation(scheme, ratio);
      ratio_ = ratio;
    }
    stages_.guess(last().rates, at_stages_, stages_.lanes());
    return true;
  }

  void made(StepPolynomial& step, const State& next, bool ends, double stop) {
    step.t = t_;
    step.start = state_;
    step.h = trial_;
    last_ = 1 - last_;
    refined_.h = 0.0;
    is_counted_ = false;
    state_ = next;
    t_ = ends ? DoubleDouble(stop) : t_ + stages_.length();
    ++steps_;
  }

  double estimate(const RotorStages::Rows& rates, const State& next) {
    Values increment{};
    for (std::size_t n = 0; n < 7; ++n) increment[n] = next.y[n] - state_.y[n];
    const double whole = of_motion(rates, increment);
    return stages_.drive(drive_) ? larger(whole, of_effects(increment)) : whole;
  }
  // The larger of coefficients m and m - 1: in an even or an odd function every other one is 0.
  static double pair(const StageRow& row, std::size_t m) {
    return larger(std::abs(row[m]), std::abs(row[m - 1]));
  }
  // Gauss' quadrature of a polynomial errs by its coefficient of degree 2 s. Those of an analytic
  // rate fall like powers, from the first to that of degree s - 1 and on.
  double of_motion(const RotorStages::Rows& rates, const Values& increment) const {
    Values last{}, largest{};
    const std::size_t s = stages_.scheme().stages;
    for (std::size_t n = 0; n < 7; ++n) {
      last[n] = trial_ * pair(rates[n], s - 1);
      largest[n] = trial_ * (std::abs(rates[n][0]) + std::abs(rates[n][1]) + std::abs(rates[n][2]));
    }
    const double most = rates_.field->error_size(largest, state_.y, increment);
    const double error = rates_.field->error_size(last, state_.y, increment);
    const double n = static_cast<double>(s);
    return most == 0.0 ? error : most * std::pow(error / most, 2.0 * n / (n - 1.0));
  }
  // The effects by themselves: next to the free rotation the last coefficients of a weak torque
  // that no step resolves look like those of a motion that falls fast. From the middle degrees to
  // the last, and twice as far again, short of degree 2 s: so a kink shows, whose coefficients
  // hardly fall.
  double of_effects(const Values& increment) const {
    const std::size_t s = stages_.scheme().stages;
    Values error{};
    for (std::size_t n = 0; n < 6; ++n) {
      const double last = pair(drive_[n], s - 1), middle = pair(drive_[n], s / 2 - 1);
      const double fall = last < middle ? last / middle : 1.0;
      const double size = trial_ * (last * (fall * fall));
      error[n < 3 ? 4 + n : n - 2] = n < 3 ? size : 0.5 * size;  // of g; of q, half a turn
    }
    return rates_.field->error_size(error, state_.y, increment);
  }
  double wanted(double error) const {
    const double ratio = std::max(error / control_.step.tolerance, 1e-300);
    if (!std::isfinite(ratio)) return 0.3;
    const double order = 2.0 * static_cast<double>(stages_.scheme().stages);
    return std::clamp(safety * std::pow(ratio, -1.0 / order), 0.3, 2.0);
  }
  // Steps of one length keep their weights and their guess; and their errors, those of a symmetric
  // and symplectic method, cancel, where those of steps of many lengths add up. So a step grows
  // after a while, and by what the largest error of that while allows.
  void choose_next(double length, double error, bool repeated) {
    constexpr int while_of_steps = 32;
    constexpr double least_growth = 1.2;
    if (repeated) {
      patience_ = while_of_steps;
      h_ = length;
    }
    largest_error_ = repeated ? error : std::max(largest_error_, error);
    since_ = repeated ? 1 : since_ + 1;
    if (since_ < patience_) return;
    const double factor = sweeps_ > slow_sweeps ? 0.9 : wanted(largest_error_);
    // A step cut short by the end says little of the next one.
    if (length >= h_ && (factor < 1.0 || factor >= least_growth))
      h_ = length * factor;
    else
      patience_ = while_of_steps;
    since_ = 0;
    largest_error_ = 0.0;
  }
  // Half a radian, or what the terms need to make half of the momentum.
  double first_step(double rest) {
    ++evaluations_;
    const double rate = rates_.field->error_size(rates_(t_, state_.y), state_.y, Values{});
    const double whole = std::min(std::abs(rest), control_.step.largest_step);
    return rate > 0.0 && std::isfinite(rate) ? std::min(0.5 / rate, whole) : whole;
  }

  Rates rates_;
  InstructionSet set_;
  RotorStages stages_;
  std::unique_ptr<RotorStages> fine_;  // of twice as many stages
  StageMatrix in_fine_{};
  RotorStages::Rows drive_{};  // of the step tried last
  StepPolynomial refined_;     // of the step made last; h = 0 until it is asked for
  bool is_counted_ =
      false;  // what it took, once: a run that goes on from a checkpoint refines again
  CollocationControl control_;
  double h_;
  DoubleDouble t_;
  State state_;
  // Since the length of steps was looked at: the largest error, how many steps, and how many it
  // takes.
  double largest_error_ = 0.0;
  int since_ = 0;
  int patience_ = 1;
  std::array<StepPolynomial, 2> polynomials_;  // of the step made last, and room for the next
  std::size_t last_ = 0;
  double ratio_ = 0.0;
  StageMatrix at_stages_{};
  double stop_ = 0.0, rest_ = 0.0;  // of the step that is being made
  bool repeated_ = false, guessed_ = false;
  double trial_ = 0.0;
  std::int64_t sweeps_ = 0;  // of the step tried last
  std::int64_t steps_ = 0;
  std::int64_t rejected_ = 0;
  std::int64_t evaluations_ = 0;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
