// SPDX-License-Identifier: MIT
// Derivatives of a motion along one direction: of the terms at a setting, and of the equations of
// motion. All six directions at once are those of RotorEquations<Tangent>.
#pragma once

#include <utility>

#include "polhode/math/dual.hpp"
#include "polhode/system/rotor_equations.hpp"

namespace polhode {
inline namespace v0 {

// A direction in the tangent of the hub: q -> q exp(turn / 2), g -> g + momentum.
struct HubDirection {
  Vec3 turn;
  Vec3 momentum;
};

// A setting that moves along a direction: the derivatives by it are those of the first variable.
inline BasicSetting<Tangent> moving_along(const Setting& at, const HubDirection& d) {
  const Vec3 half = 0.5 * d.turn;
  const Quaternion dq = at.s.q * Quaternion{0.0, half.x, half.y, half.z};
  const auto moving = [](double x, double dx) { return Tangent(x, {dx}); };
  const BasicRotorState<Tangent> s{{moving(at.s.q.w, dq.w), moving(at.s.q.x, dq.x),
                                    moving(at.s.q.y, dq.y), moving(at.s.q.z, dq.z)},
                                   {moving(at.s.g.x, d.momentum.x), moving(at.s.g.y, d.momentum.y),
                                    moving(at.s.g.z, d.momentum.z)}};
  const Quaternion& q = at.q_IS;
  const BasicQuaternion<Tangent> q_IS{Tangent(q.w), Tangent(q.x), Tangent(q.y), Tangent(q.z)};
  return {at.body, Tangent(at.t), s, q_IS, Tangent(at.t_rest)};
}

inline Vec3 value_of(const BasicVec3<Tangent>& v) { return {v.x.value, v.y.value, v.z.value}; }
inline Vec3 slope_of(const BasicVec3<Tangent>& v) {
  return {v.x.derivative[0], v.y.derivative[0], v.z.derivative[0]};
}

struct VariationalRates {
  RotorRates rotor;
  HubDirection along;
};

class VariationalEquations {
 public:
  explicit VariationalEquations(const System& system) : rotor_(system) {}

  const RotorEquations<double>& rotor() const { return rotor_; }

  // theta' = dw + theta x w, dg' = dg x w + g x dw + du; the frame turns both attitudes alike.
  VariationalRates operator()(const DoubleDouble& t, const RotorState& s, const HubDirection& d,
                              const SwitchSides* sides) const {
    const System& system = rotor_.system();
    Setting at = rotor_.setting(t, s);
    const bool inertial = system.frame().is_inertial();
    const FrameMotion frame = inertial ? FrameMotion{} : rotor_.frame_motion(t);
    at.q_IS = frame.q_IS;
    const auto [e, de] = effects(at, d, sides);
    const Vec3& I = system.body().moments();
    const Vec3& dg = d.momentum;
    const Vec3 w0{s.g.x / I.x, s.g.y / I.y, s.g.z / I.z};
    const Vec3 w = w0 + e.v, dw = Vec3{dg.x / I.x, dg.y / I.y, dg.z / I.z} + de.v;
    RotorRates rates = inertial_rates(s, w0, e);
    if (!inertial) rates = relative_rates(rates, s.q, frame.mu_S);
    return {rates, {dw + cross(d.turn, w), cross(dg, w) + cross(s.g, dw) + de.u}};
  }

 private:
  // The sum of the terms and its change.
  std::pair<Effect, Effect> effects(const Setting& at, const HubDirection& d,
                                    const SwitchSides* sides) const {
    if (rotor_.system().terms().empty()) return {};
    const BasicEffect<Tangent> sum = sum_of_terms(rotor_.system(), moving_along(at, d), sides);
    return {{value_of(sum.v), value_of(sum.u)}, {slope_of(sum.v), slope_of(sum.u)}};
  }

  RotorEquations<double> rotor_;
};

}  // namespace v0
}  // namespace polhode
