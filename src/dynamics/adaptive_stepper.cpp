// SPDX-License-Identifier: MIT
#include <cmath>
#include <string>
#include <utility>

#include "dynamics/detail/adaptive_failure.hpp"
#include "dynamics/detail/adaptive_field.hpp"
#include "dynamics/detail/breakpoints.hpp"
#include "dynamics/detail/stepper.hpp"
#include "math/detail/number_text.hpp"
#include "polhode/ode/adaptive_runge_kutta.hpp"
#include "polhode/ode/verner98.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

template <Real T>
RotorState rounded(const RotorValues<T>& y) {
  const BasicRotorState<T> s = rotor_state<T>(y);
  const BasicQuaternion<T> q = normalized(s.q);
  return {{to_double(q.w), to_double(q.x), to_double(q.y), to_double(q.z)},
          {to_double(s.g.x), to_double(s.g.y), to_double(s.g.z)}};
}

// f by a shared pointer: steps that outlive the run share it. On one smooth stretch.
template <Real T>
struct SmoothField {
  std::shared_ptr<const RotorField<T>> field;
  SmoothStretch stretch;
  RotorValues<T> operator()(const DoubleDouble& t, const RotorValues<T>& y) const {
    return (*field)(stretch.inside(t), y);
  }
};

// The state inside a step is that of a shorter step: of the order of the method, and nothing is
// kept but where the step began.
template <Real T>
class ShorterStep final : public DenseStep {
 public:
  ShorterStep(SmoothField<T> field, const DoubleDouble& t0,
              const CompensatedState<T, rotor_size<T>>& start, double t1, const RotorState& end)
      : DenseStep(t0.hi, t1), field_(std::move(field)), t0_(t0), start_(start), end_(end) {}

  RotorState at(double t) const override {
    if (t == t1()) return end_;
    const double h = (DoubleDouble(t) - t0_).hi;
    const RotorValues<T> rate = field_(t0_, start_.y);
    CompensatedState<T, rotor_size<T>> state = start_;
    state.add(runge_kutta_step<Verner98>(field_, t0_, start_.y, rate, h).increment);
    return rounded<T>(state.y);
  }

 private:
  SmoothField<T> field_;
  DoubleDouble t0_;
  CompensatedState<T, rotor_size<T>> start_;
  RotorState end_;
};

template <Real T>
class AdaptiveStepper final : public Stepper {
 public:
  AdaptiveStepper(const Problem& problem, const Adaptive& method)
      : field_(std::make_shared<const RotorField<T>>(problem.system)),
        breakpoints_(problem.system),
        solver_({field_, {}}, {}, problem.start, rotor_values(widened(problem.initial)),
                {method.tolerance, method.first_step, method.largest_step}),
        begin_(problem.start),
        start_(solver_.state()) {}

  std::string advance(double stop) override {
    const DoubleDouble begin = solver_.time();
    const CompensatedState<T, rotor_size<T>> start = solver_.state();
    solver_.field().stretch = breakpoints_.stretch(begin.hi, stop);
    const StepOutcome outcome = solver_.advance(breakpoints_.end(begin.hi, stop));
    if (outcome != StepOutcome::made)
      return failure_text(*field_, begin, start.y, solver_.trial(), outcome);
    begin_ = begin;
    start_ = start;
    restore_norm(solver_.state());
    return {};
  }
  double time() const override { return solver_.time().hi; }
  RotorState state() const override { return rounded<T>(solver_.state().y); }
  std::shared_ptr<const DenseStep> dense(bool) override {
    return std::make_shared<const ShorterStep<T>>(solver_.field(), begin_, start_, time(), state());
  }
  Statistics statistics() const override {
    return {solver_.steps(), solver_.rejected(), solver_.evaluations()};
  }
  void transfer(StateBytes& bytes) override {
    solver_.transfer(bytes);
    SmoothStretch& stretch = solver_.field().stretch;  // of the step made last
    bytes.all(begin_, start_.y, start_.carry, stretch.from, stretch.to);
  }

 private:
  static BasicRotorState<T> widened(const RotorState& s) {
    const BasicQuaternion<T> q{T(s.q.w), T(s.q.x), T(s.q.y), T(s.q.z)};
    return {normalized(q), {T(s.g.x), T(s.g.y), T(s.g.z)}};
  }

  // |q| = 1 again. A change along q turns nothing, so that a rounding of |q| does no harm.
  static void restore_norm(CompensatedState<T, rotor_size<T>>& s) {
    T excess = T(-1.0);
    for (std::size_t i = 0; i < 4; ++i) excess = excess + s.y[i] * s.y[i];
    RotorValues<T> change{};
    for (std::size_t i = 0; i < 4; ++i) change[i] = T(-0.5) * excess * s.y[i];
    s.add(change);
  }

  std::shared_ptr<const RotorField<T>> field_;
  Breakpoints breakpoints_;
  AdaptiveRungeKutta<Verner98, T, rotor_size<T>, SmoothField<T>, RotorErrorSize> solver_;
  DoubleDouble begin_;  // of the step made last
  CompensatedState<T, rotor_size<T>> start_;
};

}  // namespace

std::unique_ptr<Stepper> make_stepper(const Problem& problem, const Adaptive& method) {
  require_valid(method);
  if (method.precision == Precision::compensated)
    return std::make_unique<AdaptiveStepper<double>>(problem, method);
  return std::make_unique<AdaptiveStepper<DoubleDouble>>(problem, method);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
