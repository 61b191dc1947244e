// SPDX-License-Identifier: MIT
#include <cmath>
#include <utility>

#include "analysis/detail/deviation_field.hpp"
#include "analysis/detail/deviation_run.hpp"
#include "dynamics/detail/smooth_step.hpp"
#include "dynamics/detail/step_control.hpp"
#include "polhode/ode/adaptive_runge_kutta.hpp"
#include "polhode/ode/verner98.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

// A linear deviation is scaled down before it leaves the range of a double, and long before.
constexpr double linear_reach = 0x1p200;

template <class Field>
class AdaptiveDeviation final : public DeviationRun {
 public:
  AdaptiveDeviation(const Problem& problem, const Adaptive& method, const ChaosOptions& options)
      : clock_(clock_of(problem, options)),
        breakpoints_(problem.system),
        switches_(problem.system, unknown_jump),
        target_(is_linear ? 1.0 : options.distance),
        solver_({std::make_shared<const Field>(problem.system, clock_,
                                               problem.stop < problem.start ? -1.0 : 1.0)},
                {}, problem.start, start_values(problem, options), step_control(problem, method)) {
    // as it is after rounding, of a neighbour
    clock_.initial_length = length(now());
  }
  AdaptiveDeviation(const AdaptiveDeviation&) = delete;
  AdaptiveDeviation& operator=(const AdaptiveDeviation&) = delete;

  std::string advance(double t) override {
    // no pulse of a torque is stepped over, and none is seen from the other side
    const RotorField<double>& rotor = solver_.field().field->rotor();
    const std::string advice = smooth_step(solver_, rotor, breakpoints_, switches_, t);
    if (!advice.empty()) return advice;
    restore_norm(solver_.state());
    if constexpr (!is_linear) restore_norm(solver_.state(), 8);
    bring_back();
    return {};
  }
  double time() const override { return solver_.time().hi; }
  ChaosSample sample() const override {
    const DeviatedValues& y = solver_.state().y;
    return sample_of(time(), clock_.elapsed(solver_.time()), clock_.growth(now()),
                     y[growth_integral], y[megno_integral]);
  }
  Statistics statistics() const override {
    return {solver_.steps(), solver_.rejected(), solver_.evaluations()};
  }

 private:
  static constexpr bool is_linear = std::is_same_v<Field, VariationalField>;

  static GrowthClock clock_of(const Problem& problem, const ChaosOptions& options) {
    return {problem.start, options.momentum_scale, 1.0, 0.0};
  }
  DeviatedValues start_values(const Problem& problem, const ChaosOptions& options) const {
    DeviatedValues y{};
    const RotorValues<double> first = rotor_values(problem.initial);
    std::copy_n(first.begin(), 7, y.begin());
    Field::put(y, scaled(options.deviation, target_ / length(options.deviation)),
               options.momentum_scale);
    return y;
  }
  Deviation now() const { return Field::deviation_of(solver_.state().y, clock_.momentum_scale); }

  void bring_back() {
    const Deviation d = now();
    const double size = length(d);
    constexpr double reach = is_linear ? linear_reach : neighbour_reach;
    if (target_ < reach * size && size < reach * target_) return;
    if (!(size > 0.0) || !std::isfinite(size)) return;  // sample() says it
    CompensatedState<double, 16>& s = solver_.state();
    Field::put(s.y, scaled(d, target_ / size), clock_.momentum_scale);
    clock_.behind += std::log(size / length(now()));
    for (std::size_t i = 8; i < 15; ++i) s.carry[i] = 0.0;
  }

  GrowthClock clock_;
  Breakpoints breakpoints_;
  SwitchWatch switches_;
  double target_;
  AdaptiveRungeKutta<Verner98, double, 16, SmoothField<Field>, DeviatedErrorSize<Field>> solver_;
};

}  // namespace

std::unique_ptr<DeviationRun> deviation_run(const Problem& problem, const Adaptive& method,
                                            const ChaosOptions& options, DeviationBy by) {
  if (by == DeviationBy::variational)
    return std::make_unique<AdaptiveDeviation<VariationalField>>(problem, method, options);
  return std::make_unique<AdaptiveDeviation<NeighbourField>>(problem, method, options);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
