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
class CollocationCurve final : public SwitchCurve {
 public:
  CollocationCurve(CollocationSolver& solver, const CollocationSolver::Savepoint&,
                   const SwitchWatch& switches)
      : solver_(solver), switches_(switches) {}

  std::vector<double> along(double x) const override {
    return values(solver_.last(), solver_.stages(), x);
  }
  double truly(std::size_t which, double x) const override {
    return values(solver_.refined(), 2 * solver_.stages(), x)[which];
  }
  double rounding(std::size_t which) const override { return switches_.rounding(which); }

 private:
  std::vector<double> values(const StepPolynomial& step, std::size_t stages, double x) const {
    if (x == 1.0)
      return switches_.values(solver_.time(), RotorStages::Field::rotor(solver_.state().y));
    return switches_.values(step.t + x * step.h, RotorStages::Field::rotor(step.at(stages, x)));
  }

  CollocationSolver& solver_;
  const SwitchWatch& switches_;
};

template <>
struct CurveOf<CollocationSolver> {
  using Type = CollocationCurve;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
