// SPDX-License-Identifier: MIT
// One step of an adaptive solver within which every term is smooth: it ends at a breakpoint in
// time, and at an edge, where a switching function changes its sign.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/detail/adaptive_failure.hpp"
#include "dynamics/detail/breakpoints.hpp"
#include "dynamics/detail/edge_search.hpp"
#include "dynamics/detail/switch_watch.hpp"
#include "polhode/ode/adaptive_runge_kutta.hpp"
#include "polhode/ode/verner98.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template <Real T>
Vec3 rounded(const BasicVec3<T>& v) {
  return {to_double(v.x), to_double(v.y), to_double(v.z)};
}
template <Real T, std::size_t N>
RotorState rounded(const std::array<T, N>& y) {
  const BasicRotorState<T> s = rotor_state<T>(y);
  const BasicQuaternion<T> q = normalized(s.q);
  return {{to_double(q.w), to_double(q.x), to_double(q.y), to_double(q.z)}, rounded(s.g)};
}

// The step that a solver has made from `mark`, as a curve: a quartic of the values and rates at its
// ends and of one rate inside, for the search, and shorter steps, which are the truth.
template <class Solver>
class StepCurve final : public SwitchCurve {
 public:
  using Values = typename Solver::Values;

  StepCurve(Solver& solver, const typename Solver::Mark& mark, const SwitchWatch& switches)
      : solver_(solver), mark_(mark), switches_(switches), h_(solver.trial()) {
    const Values& y0 = mark.state.y;
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
    const Values inside = solver.field()(mark.t + x * h_, at(x));
    for (std::size_t i = 0; i < y0.size(); ++i) {
      const auto slope = chord_[i] + (begin_[i] * (1.0 - x) + end_[i] * x) * (1.0 - 2.0 * x) +
                         (end_[i] - begin_[i]) * (x * (1.0 - x));
      bow_[i] = (inside[i] * h_ - slope) * (16.0 / 3.0);
    }
    solver_.count(2);
  }

  std::vector<double> along(double x) const override {
    if (x == 1.0) return switches_.values(solver_.time(), rounded(solver_.state().y));
    return switches_.values(mark_.t + x * h_, rounded(at(x)));
  }
  double truly(std::size_t which, double x) const override {
    if (x == 1.0) return along(x)[which];
    CompensatedState state = mark_.state;
    state.add(
        runge_kutta_step<Verner98>(solver_.field(), mark_.t, state.y, solver_.rate_before(), x * h_)
            .increment);
    solver_.count(Verner98::stages - 1);
    return switches_.values(mark_.t + x * h_, rounded(state.y))[which];
  }

  double rounding(std::size_t which) const override { return switches_.rounding(which); }

 private:
  Values at(double x) const {
    Values y = mark_.state.y;
    const double left = 1.0 - x, both = x * left;
    for (std::size_t i = 0; i < y.size(); ++i)
      y[i] = y[i] + chord_[i] * x + (begin_[i] * left + end_[i] * x + bow_[i] * both) * both;
    return y;
  }

  Solver& solver_;
  const typename Solver::Mark& mark_;
  const SwitchWatch& switches_;
  double h_;
  Values chord_, begin_, end_, bow_{};
};

// A state on the way from one to the other, roughly.
inline RotorState between(const RotorState& a, const RotorState& b) {
  const auto middle = [](double x, double y) { return x + 0.375 * (y - x); };
  const Quaternion q{middle(a.q.w, b.q.w), middle(a.q.x, b.q.x), middle(a.q.y, b.q.y),
                     middle(a.q.z, b.q.z)};
  return {normalized(q), a.g + 0.375 * (b.g - a.g)};
}

// Towards `stop`. Empty when the step was made; otherwise why not, and the solver stays.
template <class Solver, class Field>
std::string smooth_step(Solver& solver, const Field& field, const Breakpoints& breakpoints,
                        SwitchWatch& switches, double stop) {
  const DoubleDouble begin = solver.time();
  const RotorState start = switches.is_needed() ? rounded(solver.state().y) : RotorState{};
  const std::string not_begun = switches.begin(begin, start);
  if (!not_begun.empty()) return not_begun;
  solver.field().stretch = breakpoints.stretch(begin.hi, stop);
  double end = breakpoints.end(begin.hi, stop);
  if (switches.size() > 0) {
    const double longest = switches.longest_step(start);
    if (std::abs(end - begin.hi) > longest) end = begin.hi + std::copysign(longest, end - begin.hi);
  }
  std::optional<std::size_t> crossed;  // at `end`
  for (;;) {
    solver.field().sides = switches.sides();
    std::optional<typename Solver::Mark> mark;
    if (switches.size() > 0) mark = solver.mark();
    const StepOutcome outcome = solver.advance(end);
    if (outcome != StepOutcome::made) {
      typename Field::Values y{};  // without what a deviation adds
      std::copy_n(solver.state().y.begin(), std::min(y.size(), solver.state().y.size()), y.begin());
      return failure_text(field, begin, y, solver.trial(), outcome);
    }
    if (crossed && solver.time().hi == end) {
      const RotorState s = rounded(solver.state().y);
      std::string refused =
          switches.refused_jump(*crossed, solver.time(), s, {start, between(start, s)});
      if (!refused.empty()) {
        solver.back_to(*mark);
        return refused;
      }
      switches.cross(*crossed);
    }
    if (!mark || crossed) break;
    const StepCurve<Solver> curve(solver, *mark, switches);
    const std::optional<Edge> edge = first_edge(curve);
    if (!edge) {
      switches.see(curve.along(1.0));
      break;
    }
    const double length = edge->x * solver.trial();
    const RotorState tried = rounded(solver.state().y);
    solver.back_to(*mark);
    if (edge->is_nan) {  // nearer, as long as there is something nearer
      const double least = 8.0 * epsilon<double>() * std::abs(stop - begin.hi);
      if (std::abs(length) < std::max(smallest_step(begin), least))
        return switches.nan_text(edge->which, (begin + length).hi);
      end = (begin + 0.5 * length).hi;
      continue;
    }
    // at once: by the rounding of t, which says nothing at t = 0, or by that of the search
    if (std::abs(length) < smallest_step(begin) || edge->x < 8.0 * epsilon<double>()) {
      std::string refused =
          switches.refused_jump(edge->which, begin, start, {tried, between(start, tried)});
      if (!refused.empty()) return refused;
      if (!switches.cross_at_once(edge->which))
        return switches.text(edge->which) + " stays at zero after t = " + number_text(begin.hi) +
               ", and its torque switches to and fro: give it a dead zone, or let it change "
               "smoothly through zero";
      continue;
    }
    end = (begin + length).hi;
    crossed = edge->which;
  }
  switches.stepped();
  return {};
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
