// SPDX-License-Identifier: MIT
// One step of an adaptive solver within which every term is smooth, and why one could not be made.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/adaptive/breakpoints.hpp"
#include "dynamics/adaptive/rotor_field.hpp"
#include "dynamics/adaptive/switching_functions.hpp"
#include "math/finite.hpp"
#include "math/number_text.hpp"
#include "polhode/detail/ode/adaptive_runge_kutta.hpp"
#include "polhode/detail/ode/verner98.hpp"
#include "system/rotor_equations.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// The first term, or the frame, that is not finite in the step tried; empty when all are.
template <class Field>
std::string not_finite_text(const Field& field, const DoubleDouble& t,
                            const typename Field::Values& y, double h) {
  using T = typename Field::Number;
  std::string text;
  const auto watched = [&](const DoubleDouble& at_time, const typename Field::Values& values) {
    BasicSetting<T> at = field.equations().setting(at_time, rotor_state<T>(values));
    const auto found = [&](const std::string& what) {
      if (text.empty() && is_finite(at.s.g))
        text = what + " is not a finite number at t = " + number_text(at_time.hi);
    };
    if (!field.system().frame().is_inertial()) {
      const BasicFrameMotion<T> frame = field.equations().frame_motion(at_time);
      if (!is_finite(frame.mu_S)) found("the rate of the frame");
      at.q_IS = frame.q_IS;
    }
    for (const AnyPerturbation& term : field.system().terms()) {
      const BasicEffect<T> e = term.effect(at);
      if (!is_finite(e.u)) found("the torque of term \"" + term.name() + "\"");
      if (!is_finite(e.v)) found("the rate of term \"" + term.name() + "\"");
    }
    return field(at_time, values);
  };
  runge_kutta_step<Verner98>(watched, t, y, watched(t, y), h);
  return text;
}

// The sentence of an outcome that is not `made`.
template <class Field>
std::string failure_text(const Field& field, const DoubleDouble& t, const typename Field::Values& y,
                         double h, StepOutcome outcome) {
  const std::string where = number_text(t.hi);
  if (outcome == StepOutcome::not_finite) {
    const std::string term = not_finite_text(field, t, y, h);
    if (!term.empty()) return term + ": give it a value there, or stop before";
    return "the momentum grows beyond all numbers at t = " + where +
           ": is the sign of a torque right?";
  }
  return "the step at t = " + where + " would be " + number_text(std::abs(h)) +
         ", below the rounding of t: does a torque or the frame jump there repeatedly, or grow "
         "without bound? Name the switching functions of the term, or try a larger tolerance";
}

// The step that a solver has made from `savepoint`, as a curve: a quartic of the values and rates
// at its ends and of one rate inside, for the search, and shorter steps, which are the truth.
template <class Solver>
class StepCurve final : public SwitchCurve {
 public:
  using Values = typename Solver::Values;

  StepCurve(Solver& solver, const typename Solver::Savepoint& savepoint,
            const SwitchWatch& switches)
      : solver_(solver), savepoint_(savepoint), switches_(switches), h_(solver.trial()) {
    const Values& y0 = savepoint.state.y;
    const Values& y1 = solver.state().y;
    const Values first = solver.rate_before(), last = solver.field()(solver.time(), y1);
    for (std::size_t i = 0; i < y0.size(); ++i) {
      chord_[i] = y1[i] - y0[i];
      begin_[i] = first[i] * h_ - chord_[i];
      end_[i] = chord_[i] - last[i] * h_;
    }
    // a cubic until here, whose rate at a quarter of the step errs by what the quartic has more:
    // (x^2 (1 - x)^2)' = 3/16 there, and 0 in the middle
    const double x = 0.25;
    const Values inside = solver.field()(savepoint.t + x * h_, at(x));
    for (std::size_t i = 0; i < y0.size(); ++i) {
      const auto slope = chord_[i] + (begin_[i] * (1.0 - x) + end_[i] * x) * (1.0 - 2.0 * x) +
                         (end_[i] - begin_[i]) * (x * (1.0 - x));
      bow_[i] = (inside[i] * h_ - slope) * (16.0 / 3.0);
    }
    solver_.count(2);
  }

  std::vector<double> along(double x) const override {
    if (x == 1.0)
      return switches_.values(solver_.time(), solver_.field().field->rotor(solver_.state().y));
    return switches_.values(savepoint_.t + x * h_, solver_.field().field->rotor(at(x)));
  }
  double truly(std::size_t which, double x) const override {
    if (x == 1.0) return along(x)[which];
    CompensatedState state = savepoint_.state;
    state.add(runge_kutta_step<Verner98>(solver_.field(), savepoint_.t, state.y,
                                         solver_.rate_before(), x * h_)
                  .increment);
    solver_.count(Verner98::stages - 1);
    return switches_.values(savepoint_.t + x * h_, solver_.field().field->rotor(state.y))[which];
  }

  double rounding(std::size_t which) const override { return switches_.rounding(which); }

 private:
  Values at(double x) const {
    Values y = savepoint_.state.y;
    const double left = 1.0 - x, both = x * left;
    for (std::size_t i = 0; i < y.size(); ++i)
      y[i] = y[i] + chord_[i] * x + (begin_[i] * left + end_[i] * x + bow_[i] * both) * both;
    return y;
  }

  Solver& solver_;
  const typename Solver::Savepoint& savepoint_;
  const SwitchWatch& switches_;
  double h_;
  Values chord_, begin_, end_, bow_{};
};

// What the steps of a solver are to the search for edges.
template <class Solver>
struct CurveOf {
  using Type = StepCurve<Solver>;
};

// A state on the way from one to the other, roughly.
inline RotorState between(const RotorState& a, const RotorState& b) {
  const auto middle = [](double x, double y) { return x + 0.375 * (y - x); };
  const Quaternion q{middle(a.q.w, b.q.w), middle(a.q.x, b.q.x), middle(a.q.y, b.q.y),
                     middle(a.q.z, b.q.z)};
  return {normalized(q), a.g + 0.375 * (b.g - a.g)};
}

// One step of a solver.
template <class Solver, class Field>
class SwitchingStep {
 public:
  SwitchingStep(Solver& solver, const Field& field, const Breakpoints& breakpoints,
                SwitchWatch& switches, SwitchStepControl& grading, double stop)
      : solver_(solver),
        field_(field),
        switches_(switches),
        grading_(grading),
        stop_(stop),
        begin_(solver.time()),
        start_(switches.is_needed() ? rotor() : RotorState{}) {
    solver_.field().stretch = breakpoints.stretch(begin_.hi, stop);
    end_ = breakpoints.end(begin_.hi, stop);
  }

  // Towards `stop`. Empty when the step was made; otherwise why not, and the solver stays.
  std::string made() {
    if (std::string nan = begin(); !nan.empty()) return nan;
    for (;;)
      if (const std::optional<std::string> last = tried(solver_.advance(end_))) return *last;
  }

 private:
  using Savepoint = typename Solver::Savepoint;

  std::string begin() {
    if (std::string nan = switches_.begin(begin_, start_); !nan.empty()) return nan;
    if (switches_.size() > 0) {
      limit_to(switches_.longest_step(start_));
      grading_.begin(switches_, begin_, start_);
      grade();
    }
    prepare();
    return {};
  }
  // What went wrong, empty if nothing did; no value if more steps must be tried.
  std::optional<std::string> tried(StepOutcome outcome) {
    if (outcome != StepOutcome::made) return failure(outcome);
    if (crossed_ && solver_.time().hi == end_) {
      if (std::string refused = cross(*savepoint_); !refused.empty()) return refused;
    }
    const std::optional<Edge> edge =
        savepoint_ && !crossed_ ? edge_since(*savepoint_) : std::nullopt;
    if (!edge) {
      switches_.stepped();
      return std::string();
    }
    if (std::string why = go_back(*savepoint_, *edge); !why.empty()) return why;
    prepare();
    return std::nullopt;
  }

  RotorState rotor() const { return field_.rotor(solver_.state().y); }

  void prepare() {
    solver_.field().sides = switches_.sides();
    savepoint_.reset();
    if (switches_.size() > 0) savepoint_ = solver_.savepoint();
  }
  // Steps may be so long. To a solver that keeps the length of its steps that is no end: steps
  // which an end cuts short say nothing of the next, and would stay so.
  void limit_to(double longest) {
    if constexpr (requires { solver_.wanted(); }) {
      constexpr double part = 0.95;  // so that the limit may fall a little and their length stays
      if (solver_.wanted() > 0.0) {
        if (solver_.wanted() > longest) solver_.want(part * longest);
        return;
      }
    }
    shorten_to(longest);
  }
  void grade() {
    if constexpr (requires { solver_.wanted(); }) {
      const double wanted = solver_.wanted();
      if (!(wanted > 0.0)) return;
      const double rest = (DoubleDouble(stop_) - begin_).hi;
      const double longest =
          grading_.longest(switches_, begin_, start_, wanted, rest, solver_.edge_rule());
      if (longest > wanted) solver_.want(longest);
      if (longest < solver_.wanted()) shorten_to(longest);
    }
  }
  void shorten_to(double longest) {
    if (std::abs(end_ - begin_.hi) > longest)
      end_ = begin_.hi + std::copysign(longest, end_ - begin_.hi);
  }

  std::string failure(StepOutcome outcome) const {
    if constexpr (requires { solver_.refusal(outcome); }) {
      if (std::string own = solver_.refusal(outcome); !own.empty()) return own;
    }
    const auto& watched = field_.watched();
    typename std::decay_t<decltype(watched)>::Values y{};  // without what a deviation adds
    std::copy_n(solver_.state().y.begin(), std::min(y.size(), solver_.state().y.size()), y.begin());
    return failure_text(watched, begin_, y, solver_.trial(), outcome);
  }

  // The step has ended at the edge that was looked for.
  std::string cross(const Savepoint& savepoint) {
    const RotorState s = rotor();
    std::string refused =
        switches_.refused_jump(*crossed_, solver_.time(), s, {start_, between(start_, s)});
    if (refused.empty()) {
      switches_.cross(*crossed_);
      grading_.cross(*crossed_, end_);
    } else {
      solver_.roll_back(savepoint);
    }
    return refused;
  }

  std::optional<Edge> edge_since(const Savepoint& savepoint) {
    const typename CurveOf<Solver>::Type curve(solver_, savepoint, switches_);
    const EdgeSearch found = search_edges(curve);
    if (!found.first) switches_.see(found.at_end);
    return found.first;
  }

  // To the start of the step, for one that ends at the edge.
  std::string go_back(const Savepoint& savepoint, const Edge& edge) {
    const double length = edge.x * solver_.trial();
    const RotorState tried = rotor();
    solver_.roll_back(savepoint);
    if (edge.is_nan) {  // nearer, as long as there is something nearer
      const double least = 8.0 * epsilon<double>() * std::abs(stop_ - begin_.hi);
      if (std::abs(length) < std::max(smallest_step(begin_), least))
        return switches_.nan_text(edge.which, (begin_ + length).hi);
      end_ = (begin_ + 0.5 * length).hi;
      return {};
    }
    // at once: by the rounding of t, which says nothing at t = 0, or by that of the search
    if (std::abs(length) < smallest_step(begin_) || edge.x < 8.0 * epsilon<double>()) {
      std::string refused =
          switches_.refused_jump(edge.which, begin_, start_, {tried, between(start_, tried)});
      if (!refused.empty()) return refused;
      if (!switches_.cross_at_once(edge.which))
        return switches_.text(edge.which) + " stays at zero after t = " + number_text(begin_.hi) +
               ", and its torque switches to and fro: give it a dead zone, or let it change "
               "smoothly through zero";
      grading_.cross(edge.which, begin_.hi);
      return {};
    }
    end_ = (begin_ + length).hi;
    crossed_ = edge.which;
    return {};
  }

  Solver& solver_;
  const Field& field_;
  SwitchWatch& switches_;
  SwitchStepControl& grading_;
  double stop_;
  DoubleDouble begin_;
  RotorState start_;
  double end_;
  std::optional<std::size_t> crossed_;  // at `end_`
  std::optional<Savepoint> savepoint_;  // before what is tried
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
