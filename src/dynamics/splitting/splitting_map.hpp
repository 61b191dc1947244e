// SPDX-License-Identifier: MIT
// One step of a splitting as a map: exact free rotation in inertial axes, in turn with kicks by the
// terms. The frame enters through q_SB = q_IS* q_IB where a term is asked, and nowhere else.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/adaptive/switching_functions.hpp"
#include "free/short_flow.hpp"
#include "polhode/detail/trajectory/archive.hpp"
#include "polhode/dynamics/detail/fixed_stepper.hpp"
#include "polhode/dynamics/detail/splitting_scheme.hpp"
#include "polhode/math/double_double.hpp"
#include "polhode/math/vector.hpp"
#include "polhode/system/system.hpp"
#include "system/moving_setting.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

struct SplittingState {
  TwoTerms<double> t;
  Quaternion q_IB;
  TwoPartMomentum g;
  // What the kick that ended the last step was; the next step starts with the same one.
  std::optional<AffineTorque> torque;
  std::int64_t evaluations = 0;
};
// What a step makes of a state and of a deviation from it.
struct DeviationStep {
  SplittingState end;
  HubDirection along;
};

class SplittingMap {
 public:
  using State = SplittingState;
  using Shown = SystemState;

  // DomainError when a term has no flow.
  SplittingMap(const System& system, SplittingScheme scheme);

  const System& system() const { return system_; }
  SplittingState start(double t, const RotorState& s) const;
  SystemState state(const SplittingState& s) const;  // q_SB, normalised

  // Empty, or why no step by h is tried: the body would rotate too far.
  std::string obstacle(const SplittingState& s, double h) const;
  // A step from s. Non-finite numbers are passed on; what a term throws passes through.
  SplittingState stepped(SplittingState s, double h) const;

  // Empty, or which term made `to` not finite.
  std::string failure(const SplittingState& from, const SplittingState& to) const;
  static std::int64_t evaluations(const SplittingState& s, std::int64_t) { return s.evaluations; }
  static void serialize(Archive& bytes, SplittingState& s);

  // DomainError when a term is not a kick, so that steps have no derivative.
  void require_kicks() const;
  // d(dtheta_B, dg_B) after the step by those before. DomainError when a term is not a kick written
  // as a template on the number type.
  Matrix6 step_transition(SplittingState s, double h) const;
  // The same derivative along one deviation, in double precision and a hundred times as fast.
  DeviationStep step_deviation(SplittingState s, HubDirection d, double h) const;

 private:
  // The largest component of I^-1 g.
  double rate(const SplittingState& s) const;
  // Whether a damping acts for negative times in a part of a step, and grows there.
  bool may_grow_backwards() const;
  // The first term whose effect at s is not finite; empty if there is none.
  std::string term_not_finite(const SplittingState& s) const;
  // A fraction of a step in two parts, so that the fractions of a step add up to it.
  bool is_at_rest(const SplittingState& s, double time) const;
  void drift(SplittingState& s, const TwoTerms<double>& time) const noexcept;
  void kick(SplittingState& s, double h) const;
  void composed_kick(SplittingState& s, double h) const;
  void flow(SplittingState& s, const AnyPerturbation& term, double h) const;
  AffineTorque torque(SplittingState& s) const;
  Setting setting(const SplittingState& s, const Quaternion& q_IS) const;
  Matrix6 kick_transition(const SplittingState& s, double h) const;
  HubDirection after_drift(const HubDirection& d, const SplittingState& s, double h) const;
  HubDirection after_kick(HubDirection d, const SplittingState& s, double h) const;

  System system_;
  ShortFlow free_;
  std::vector<AnyPerturbation> kicks_;   // torques of time and attitude alone, summed
  std::vector<AnyPerturbation> affine_;  // friction, in one flow with the kicks
  std::vector<AnyPerturbation> flows_;   // others
  SplittingCoefficients coefficients_;
  std::vector<double> composed_;  // fractions of the flows within one kick
};

// StepJumps: torques that jump within the steps of a splitting, whose derivative does not know it.
class StepJumps {
 public:
  // `why` ends the sentence that refuses a jump.
  StepJumps(const System& system, const char* why) : switches_(system, why) {}

  // After a step. Empty, or where a torque jumps because the state says so. A function that
  // changes its sign and back within one step is not seen, though kicks inside the step may feel
  // the torque between: steps must be shorter than that.
  std::string seen(const SplittingMap& map, const SplittingState& from, const SplittingState& to);
  void serialize(Archive& bytes) {
    bytes(has_begun_);
    switches_.serialize(bytes);
  }

 private:
  SwitchWatch switches_;
  bool has_begun_ = false;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
