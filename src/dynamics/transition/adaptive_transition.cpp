// SPDX-License-Identifier: MIT
// By the variational equations, which are those of a dual state.
#include "dynamics/adaptive/adaptive_stepper.hpp"
#include "dynamics/adaptive/rotor_field.hpp"
#include "dynamics/transition/transition_steppers.hpp"
#include "free/hub_tangent.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

class TransitionField {
 public:
  using Number = Tangent;
  using Values = RotorValues<Tangent>;
  using State = TransitionState;

  explicit TransitionField(const System& system) : rotor_(system) {}

  const RotorField<Tangent>& watched() const { return rotor_; }
  [[gnu::always_inline]] Values operator()(const DoubleDouble& t, const Values& y,
                                           const SwitchSides* sides) const {
    return rotor_(t, y, sides);
  }
  static Values start(const RotorState& s) { return rotor_values<Tangent>(with_variables(s)); }
  static TransitionState state(const Values& y) {
    BasicRotorState<Tangent> s = rotor_state<Tangent>(y);
    s.q = normalized(s.q);
    return {{{s.q.w.value, s.q.x.value, s.q.y.value, s.q.z.value},
             {s.g.x.value, s.g.y.value, s.g.z.value}},
            hub_tangent(s)};
  }
  static RotorState rotor(const Values& y) { return rounded(rotor_state<Tangent>(y)); }
  static double error_size(const Values& error, const Values& y, const Values& increment) {
    return RotorErrorSize()(error, y, increment);
  }
  // The derivatives would have to be brought back with q.
  static void settle(CompensatedState<Tangent, rotor_size<Tangent>>&) {}

 private:
  RotorField<Tangent> rotor_;
};

}  // namespace

std::unique_ptr<BasicStepper<TransitionState>> transition_stepper(const Problem& problem,
                                                                  const Adaptive& method) {
  return std::make_unique<SwitchingStepper<TransitionField>>(
      std::make_shared<const TransitionField>(problem.system),
      SwitchingSteps(problem.system, no_transition_at_jump), problem.start,
      TransitionField::start(problem.initial), step_control(problem.system, problem.start, method));
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
