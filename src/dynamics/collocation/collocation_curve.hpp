// SPDX-License-Identifier: MIT
// The step that a collocation has made, as a curve on which switching functions are looked at.
#pragma once

#include <vector>

#include "dynamics/adaptive/smooth_step.hpp"
#include "dynamics/collocation/collocation_solver.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// The polynomial of the step for the search; that of twice as many stages is the truth.
template <class Solver>
class CollocationCurve final : public SwitchCurve {
 public:
  CollocationCurve(Solver& solver, const typename Solver::Savepoint&, const SwitchWatch& switches)
      : solver_(solver), switches_(switches) {}

  std::vector<double> along(double x) const override {
    return values(solver_.last(), solver_.stages(), x);
  }
  double truly(std::size_t which, double x) const override {
    return values(solver_.refined(), 2 * solver_.stages(), x)[which];
  }
  double rounding(std::size_t which) const override { return switches_.rounding(which); }

 private:
  std::vector<double> values(const typename Solver::Polynomial& step, std::size_t stages,
                             double x) const {
    const auto& field = *solver_.field().field;
    if (x == 1.0) return switches_.values(solver_.time(), field.rotor(solver_.state().y));
    return switches_.values(step.t + x * step.h, field.rotor(step.at(stages, x)));
  }

  Solver& solver_;
  const SwitchWatch& switches_;
};

template <class Stages>
struct CurveOf<BasicCollocationSolver<Stages>> {
  using Type = CollocationCurve<BasicCollocationSolver<Stages>>;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
