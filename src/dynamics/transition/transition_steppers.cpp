// SPDX-License-Identifier: MIT
#include "dynamics/transition/transition_steppers.hpp"

#include <cstdint>
#include <utility>

#include "dynamics/adaptive/adaptive_stepper.hpp"
#include "dynamics/collocation/collocation_stepper.hpp"
#include "dynamics/collocation/variational_stages.hpp"
#include "dynamics/splitting/splitting_map.hpp"
#include "free/hub_tangent.hpp"
#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

// Why a run with derivatives ends at a jump of a torque that the state decides.
constexpr const char* no_transition_at_jump =
    "its transition matrix is not known; take differences of runs";

struct InItsPlace {
  const std::string& function;
  const std::string& what;

  Method operator()(Adaptive method) const {
    if (method.tolerance < 1e-15)
      throw DomainError(function + ": tolerance " + number_text(method.tolerance) +
                        " must be from 1e-15: " + what + " are carried in double");
    method.precision = Precision::compensated;
    return method;
  }
  Method operator()(const Splitting& method) const { return method; }
  // The motion is the same to the tolerance; its variational equations need no constants.
  Method operator()(const VariationOfConstants& method) const {
    return Adaptive{.tolerance = method.tolerance, .largest_step = method.largest_step};
  }
  Method operator()(const Collocation& method) const { return method; }
  Method operator()(const CustomMethod& method) const {
    throw DomainError(function + ": method \"" + method.traits.kind + "\" carries no " + what +
                      ": take Adaptive, Collocation, Splitting or VariationOfConstants");
  }
};

// For Adaptive the variational equations, which are those of a dual state; for Collocation the
// derivative of the steps themselves, of which the motion is that of the method without.
class TransitionField : public AugmentedField<TransitionState, 42> {
 public:
  explicit TransitionField(const System& system) : AugmentedField(system), jacobian_(system) {}

  const RotorJacobian& jacobian() const { return jacobian_; }

  Values operator()(const DoubleDouble& t, const Values& y, const SwitchSides* sides) const {
    return column_values(jacobian_.whole()(t, dual_values(y), sides));
  }
  static Values start(const RotorState& s) {
    return column_values(rotor_values<Tangent>(with_variables(s)));
  }
  static State state(const Values& y) { return {rotor(y), hub_tangent(dual_state(y))}; }
  static double error_size(const Values& error, const Values& y, const Values& increment) {
    return RotorErrorSize()(dual_values(error), dual_values(y), dual_values(increment));
  }

 private:
  RotorJacobian jacobian_;
};

// The derivative of what a splitting does, step by step: symplectic as the method is.
class TransitionMap {
 public:
  struct State : SplittingState {
    Matrix6 transition;  // from the start
  };
  using Shown = TransitionState;

  explicit TransitionMap(SplittingMap map)
      : map_(std::move(map)), jumps_(map_.system(), no_transition_at_jump) {
    map_.require_kicks();  // also for a run without steps
  }

  State start(double t, const RotorState& s) const {
    return {map_.start(t, s), Matrix6::identity()};
  }
  State stepped(const State& from, double h) const {
    return {map_.stepped(from, h), map_.step_transition(from, h) * from.transition};
  }
  Shown state(const State& at) const { return {map_.state(at), at.transition}; }
  std::string obstacle(const State& from, double h) const { return map_.obstacle(from, h); }
  std::string failure(const State& from, const State& to) {
    std::string why = map_.failure(from, to);
    return why.empty() ? jumps_.seen(map_, from, to) : why;
  }
  static std::int64_t evaluations(const State& at, std::int64_t) { return at.evaluations; }
  static void serialize(Archive& bytes, State& at) {
    SplittingMap::serialize(bytes, at);
    for (auto& row : at.transition.a) bytes(row);
  }
  void serialize(Archive& bytes) { jumps_.serialize(bytes); }

 private:
  SplittingMap map_;
  StepJumps jumps_;
};

}  // namespace

Method derivative_method(const std::string& function, const std::string& what,
                         const Method& method) {
  return std::visit(InItsPlace{function, what}, method);
}

std::unique_ptr<BasicStepper<TransitionState>> transition_stepper(const Problem& problem) {
  if (const auto* const method = std::get_if<Splitting>(&problem.method)) {
    TransitionMap map(SplittingMap(problem.system, method->scheme));
    const TransitionMap::State start = map.start(problem.start, problem.initial);
    return std::make_unique<FixedStepper<TransitionMap>>(std::move(map), start, method->step);
  }
  auto field = std::make_shared<const TransitionField>(problem.system);
  const TransitionField::Values start = TransitionField::start(problem.initial);
  if (const auto* const method = std::get_if<Collocation>(&problem.method))
    return collocation_stepper<VariationalStages<TransitionField, 6>>(
        std::move(field), problem.start, start, *method, no_transition_at_jump);
  return switching_stepper(std::move(field), problem.start, start,
                           std::get<Adaptive>(problem.method), no_transition_at_jump);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
