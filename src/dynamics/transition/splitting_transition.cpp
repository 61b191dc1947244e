// SPDX-License-Identifier: MIT
// The derivative of what a splitting does, step by step: symplectic as the method is.
#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "dynamics/splitting/splitting_map.hpp"
#include "dynamics/transition/transition_steppers.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

struct TransitionOfSplitting : SplittingState {
  Matrix6 transition;  // from the start
};

class TransitionMap {
 public:
  using State = TransitionOfSplitting;
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

std::unique_ptr<BasicStepper<TransitionState>> transition_stepper(const Problem& problem,
                                                                  const Splitting& method) {
  TransitionMap map(SplittingMap(problem.system, method.scheme));
  const TransitionOfSplitting start = map.start(problem.start, problem.initial);
  return std::make_unique<FixedStepper<TransitionMap>>(std::move(map), start, method.step);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
