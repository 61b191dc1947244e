// SPDX-License-Identifier: MIT
#include <utility>

#include "analysis/detail/deviation_field.hpp"
#include "dynamics/adaptive/adaptive_stepper.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

template <class By>
std::unique_ptr<BasicStepper<DeviatedState>> stepper_by(const Problem& problem,
                                                        const Adaptive& method,
                                                        const ChaosOptions& options,
                                                        double target) {
  using Field = DeviationField<By>;
  const double scale = options.momentum_scale;
  typename Field::Values y{};
  const RotorValues<double> first = rotor_values(problem.initial);
  std::copy_n(first.begin(), 7, y.begin());
  By::put(y, scaled(options.deviation, target / length(options.deviation)), scale);
  const Growth growth{problem.start, problem.stop < problem.start ? -1.0 : 1.0, scale, target,
                      // as it is after rounding, of a neighbour
                      length(By::deviation_of(y, scale))};
  // no pulse of a torque is stepped over, and none is seen from the other side
  return std::make_unique<SwitchingStepper<Field>>(
      std::make_shared<const Field>(problem.system, growth),
      SwitchingSteps(problem.system, unknown_jump), problem.start, y,
      step_control(problem.system, problem.start, method));
}

}  // namespace

std::unique_ptr<BasicStepper<DeviatedState>> deviation_stepper(const Problem& problem,
                                                               const Adaptive& method,
                                                               const ChaosOptions& options,
                                                               DeviationBy by) {
  if (by == DeviationBy::variational) return stepper_by<Variational>(problem, method, options, 1.0);
  return stepper_by<Neighbour>(problem, method, options, options.distance);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
