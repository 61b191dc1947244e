// SPDX-License-Identifier: MIT
// A rotor under torques with its derivatives by six unknowns, as Adaptive sees it.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "dynamics/augmented.hpp"
#include "polhode/perturb/effect.hpp"
#include "polhode/system/system.hpp"

namespace polhode {
inline namespace v0 {

// Here, where the type is: calls find it by its argument.
template <class Visit>
void each_number(BasicRotorState<Tangent>& s, Visit&& visit) {
  for (Tangent* x : {&s.q.w, &s.q.x, &s.q.y, &s.q.z, &s.g.x, &s.g.y, &s.g.z}) {
    visit(x->value);
    for (double& slope : x->derivative) visit(slope);
  }
}

}  // namespace v0
}  // namespace polhode

namespace polhode {
inline namespace v0 {
namespace fit {

using TangentRotor = BasicRotorState<Tangent>;

namespace detail {

// What an unknown does to the rates, beside what it did to the state.
struct SensitivityTerm {
  // The terms with a parameter one step on; empty: none.
  std::vector<AnyPerturbation> stepped = {};
  double step = 1.0;
  // The principal moment that grows with the unknown, and how fast.
  std::optional<int> moment = std::nullopt;
  double moment_rate = 0.0;
};

class SensitivityField : public polhode::detail::AugmentedField<TangentRotor, 42> {
 public:
  SensitivityField(const System& system, std::array<SensitivityTerm, 6> terms);

  Values operator()(const DoubleDouble& t, const Values& y, const SwitchSides* sides) const;
  static TangentRotor state(const Values& y) { return polhode::detail::dual_state(y); }
  double error_size(const Values& error, const Values& y, const Values& increment) const;

  // The inertial rate of the body, with its derivatives.
  BasicVec3<Tangent> rate(double t, const TangentRotor& s) const;

 private:
  struct Motion {
    TangentRotor s;
    BasicVec3<Tangent> w0;
    BasicEffect<Tangent> e;
  };
  Motion motion(const DoubleDouble& t, const Values& y, const SwitchSides* sides) const;
  // The derivative of the effects by a moment at a fixed rate of the body.
  Effect by_moment(int k, const Setting& at, const Vec3& w) const;

  std::array<SensitivityTerm, 6> terms_;
  // A sphere, and bodies with half as much more of a moment.
  Body sphere_;
  std::array<Body, 3> grown_;
};

// The effect of the terms on a body at a rate w: of one that has other moments, too.
Effect effect_at_rate(const std::vector<AnyPerturbation>& terms, const Body& body,
                      const Setting& at, const Vec3& w);

}  // namespace detail
}  // namespace fit
}  // namespace v0
}  // namespace polhode
