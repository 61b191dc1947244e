// SPDX-License-Identifier: MIT
// One step of several bodies, each of its own length, solved together.
#pragma once

#include <exception>
#include <span>
#include <vector>

#include "dynamics/collocation/lockstep/body_lanes.hpp"
#include "dynamics/collocation/rotor_stages.hpp"
#include "dynamics/collocation/sweeps.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// The step of one of them: begun, and what came of its sweeps.
struct BodyStep {
  RotorStages* stages = nullptr;
  SweepJudge judge = judge_of<RotorStages>(0.0);
  std::exception_ptr thrown = {};  // by a term

  bool goes_on() const { return judge.goes_on() && !thrown; }
};

class ManySteps {
 public:
  ManySteps(std::size_t stages, InstructionSet set)
      : scheme_(gauss_scheme(stages)), kernels_(body_kernels(stages, set)), lanes_(stages) {}

  // Of bodies that go together, up to body_lanes of them, whose guesses wait: to the last bit what
  // sweeps make of each. Those that have converged are given their solution. Terms whose law does
  // for one of them alone are asked body by body.
  void solve(std::span<BodyStep> bodies);

  // Before a step of other bodies than those of the step before.
  void regroup() { is_grouped_ = false; }

  // Whether they can be lanes of one step.
  static bool go_together(const RotorStages& a, const RotorStages& b);

 private:
  using Bodies = std::span<BodyStep>;

  void gather(const RotorStages& from, std::size_t lane);
  void group(Bodies bodies);
  void find_shared_laws(Bodies bodies);
  void ask_terms(Bodies bodies);
  void ask_alone(RotorStages& body, std::size_t term, std::size_t lane);
  double remeasured(std::size_t lane);
  void gather_guess(const RotorStages::Guess& guess, std::size_t lane);
  void give(RotorStages::Solution& to, std::size_t lane);

  const GaussScheme& scheme_;
  BodyKernels kernels_;
  BodyLanes lanes_;
  // Of each term: whether its law does for all, and what it knows of the time.
  std::vector<bool> is_shared_;
  std::vector<std::vector<BodyLine>> of_time_;
  bool is_grouped_ = false;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
