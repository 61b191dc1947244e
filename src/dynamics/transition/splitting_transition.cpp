// SPDX-License-Identifier: MIT
// The derivative of what a splitting does, step by step: symplectic as the method is.
#include <cmath>
#include <string>

#include "dynamics/splitting/splitting_map.hpp"
#include "dynamics/transition/transition_steppers.hpp"
#include "math/finite.hpp"
#include "math/number_text.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

class SplittingTransition final : public BasicStepper<TransitionState> {
 public:
  SplittingTransition(const Problem& problem, const Splitting& method)
      : map_(problem.system, method.scheme),
        step_(std::copysign(method.step, problem.stop - problem.start)),
        jumps_(problem.system, no_transition_at_jump),
        grid_(map_.start(problem.start, problem.initial)),
        transition_(Matrix6::identity()),
        t_(problem.start),
        now_(part(map_.stepped(grid_, 0.0), 0.0)) {}

  std::string advance(double t) override {
    if (std::abs(rest(t)) > std::abs(step_)) {
      if (grid_.t.hi + step_ == grid_.t.hi)
        return "step " + number_text(std::abs(step_)) +
               " is below the rounding of t = " + number_text(grid_.t.hi);
      const SplittingState next = map_.stepped(grid_, step_);
      std::string refused = not_finite(next);
      if (refused.empty()) refused = jumps_.seen(map_, grid_, step_, next);
      if (!refused.empty()) return refused;
      transition_ = map_.step_transition(grid_, step_) * transition_;
      grid_ = next;
      ++steps_;
      t_ = grid_.t.hi;
      now_ = {map_.state(grid_), transition_};
      if (t_ != t) return {};
    }
    // what is left is a part of a step, not kept
    const double h = rest(t);
    const SplittingState next = map_.stepped(grid_, h);
    std::string refused = not_finite(next);
    if (refused.empty()) refused = jumps_.seen_in_part(map_, grid_, h, next);
    if (!refused.empty()) return refused;
    t_ = t;
    now_ = part(next, h);
    return {};
  }
  double time() const override { return t_; }
  TransitionState state() const override { return now_; }
  std::shared_ptr<const BasicDenseStep<TransitionState>> dense(bool) override { return nullptr; }
  Statistics statistics() const override { return {steps_, 0, grid_.evaluations}; }
  void serialize(Archive& bytes) override {
    detail::serialize(bytes, grid_);
    for (auto& row : transition_.a) bytes(row);
    bytes.all(t_, now_, steps_);
    jumps_.serialize(bytes);
  }

 private:
  double rest(double t) const { return (t - grid_.t.hi) - grid_.t.lo; }
  TransitionState part(const SplittingState& to, double h) const {
    return {map_.state(to), map_.step_transition(grid_, h) * transition_};
  }
  std::string not_finite(const SplittingState& next) const {
    const RotorState s = map_.state(next);
    if (is_finite(s.g) && std::isfinite(s.q.w + s.q.x + s.q.y + s.q.z)) return {};
    return "the state is not finite at t = " + number_text(next.t.hi) +
           ": take a smaller step, or see whether a term is finite there";
  }

  SplittingMap map_;
  double step_;  // with its sign
  StepJumps jumps_;
  SplittingState grid_;  // after whole steps
  Matrix6 transition_;   // up to grid_
  double t_;
  TransitionState now_;
  std::int64_t steps_ = 0;
};

}  // namespace

std::unique_ptr<BasicStepper<TransitionState>> transition_stepper(const Problem& problem,
                                                                  const Splitting& method) {
  return std::make_unique<SplittingTransition>(problem, method);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
