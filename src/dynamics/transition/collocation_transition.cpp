// SPDX-License-Identifier: MIT
// By the derivative of the steps themselves, of which the motion is that of the method without.
#include "dynamics/collocation/collocation_stepper.hpp"
#include "dynamics/collocation/variational_stages.hpp"
#include "dynamics/transition/transition_steppers.hpp"
#include "free/hub_tangent.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

// (q, g), and the six columns as VariationalStages order them.
class SweptTransition {
 public:
  using Values = std::array<double, 49>;
  using State = TransitionState;

  explicit SweptTransition(const System& system) : rotor_(system), jacobian_(system) {}

  const RotorField<double>& watched() const { return rotor_; }
  const RotorField<double>& rotor_alone() const { return rotor_; }
  const RotorJacobian& jacobian() const { return jacobian_; }

  // Of the rotor alone: how long the first step is.
  Values operator()(const DoubleDouble& t, const Values& y, const SwitchSides* sides) const {
    const RotorValues<double> f = rotor_(t, rotor_values(rotor_state<double>(y)), sides);
    Values r{};
    std::copy_n(f.begin(), 7, r.begin());
    return r;
  }
  static Values start(const RotorState& s) {
    const RotorValues<Tangent> x = rotor_values<Tangent>(with_variables(s));
    Values y;
    for (std::size_t n = 0; n < 7; ++n) {
      y[n] = x[n].value;
      for (std::size_t k = 0; k < 6; ++k) y[place(n, k)] = x[n].derivative[k];
    }
    return y;
  }
  static TransitionState state(const Values& y) {
    BasicRotorState<Tangent> s = rotor_state<Tangent>(dual(y));
    s.q = normalized(s.q);
    return {{{s.q.w.value, s.q.x.value, s.q.y.value, s.q.z.value},
             {s.g.x.value, s.g.y.value, s.g.z.value}},
            hub_tangent(s)};
  }
  static RotorState rotor(const Values& y) { return rounded(rotor_state<double>(y)); }
  static double error_size(const Values& error, const Values& y, const Values& increment) {
    return RotorErrorSize()(dual(error), dual(y), dual(increment));
  }

 private:
  static std::size_t place(std::size_t n, std::size_t column) {
    return n < 4 ? 7 + 4 * column + n : 7 + 24 + 3 * column + (n - 4);
  }
  static RotorValues<Tangent> dual(const Values& y) {
    RotorValues<Tangent> x;
    for (std::size_t n = 0; n < 7; ++n) {
      x[n].value = y[n];
      for (std::size_t k = 0; k < 6; ++k) x[n].derivative[k] = y[place(n, k)];
    }
    return x;
  }

  RotorField<double> rotor_;
  RotorJacobian jacobian_;
};

}  // namespace

std::unique_ptr<BasicStepper<TransitionState>> transition_stepper(const Problem& problem,
                                                                  const Collocation& method) {
  return std::make_unique<CollocationStepper<VariationalStages<SweptTransition, 6>>>(
      std::make_shared<const SweptTransition>(problem.system),
      SwitchingSteps(problem.system, no_transition_at_jump), problem.start,
      SweptTransition::start(problem.initial), method,
      collocation_control(problem.system, problem.start, method));
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
