// SPDX-License-Identifier: MIT
// The rates of the constants of the free rotation: of the inertial state that the motion would have
// had at a reference epoch without terms and frame.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "dynamics/adaptive/rotor_values.hpp"
#include "free/short_flow.hpp"
#include "polhode/ode/runge_kutta.hpp"
#include "polhode/system/system.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// x(t) = Phi(t - epoch, y) in inertial axes; dy/dt = DPhi^-1 (v, g x v + u), the inverse being the
// flow back from x(t).
class VariationField {
 public:
  VariationField(std::shared_ptr<const System> system, const DoubleDouble& epoch)
      : system_(std::move(system)), free_(system_->body()), epoch_(epoch) {}

  const System& system() const { return *system_; }
  const ShortFlow& free() const { return free_; }
  const DoubleDouble& epoch() const { return epoch_; }
  VariationField from(const DoubleDouble& epoch) const {
    VariationField f = *this;
    f.epoch_ = epoch;
    return f;
  }

  // q_IB and g of the motion at t.
  BasicRotorState<double> osculating(const DoubleDouble& t, const RotorValues<double>& y) const {
    const RotorState s = rotor_state<double>(y);
    const ShortFlow::PlainArc arc = free_.plain(s.g, (t - epoch_).hi);
    return {s.q * arc.turn, arc.g};
  }

  RotorValues<double> operator()(const DoubleDouble& t, const RotorValues<double>& y) const {
    const RotorState s = rotor_state<double>(y);
    const double time = (t - epoch_).hi;
    const ShortFlow::PlainArc arc = free_.plain(s.g, time);
    const Effect e = terms_effect(*system_, setting(t, {s.q * arc.turn, arc.g}));
    const Vec3 dg = cross(arc.g, e.v) + e.u;
    const FlowTangent<double> back = free_.tangent(arc.g, dg, -time, conj(arc.turn));
    const Vec3 w = 0.5 * (rotate(arc.turn, e.v) + back.attitude);
    const Quaternion q = s.q * Quaternion{0.0, w.x, w.y, w.z};
    return {q.w, q.x, q.y, q.z, back.momentum.x, back.momentum.y, back.momentum.z};
  }

  // Where the terms are asked: the motion in the reference frame.
  Setting setting(const DoubleDouble& t, const RotorState& x) const {
    Setting at{system_->body(), t.hi, x, {}, t.lo};
    if (!system_->frame().is_inertial()) {
      at.q_IS = system_->frame().at(t.hi).q_IS;
      at.s.q = conj(at.q_IS) * x.q;
    }
    return at;
  }

 private:
  std::shared_ptr<const System> system_;
  ShortFlow free_;
  DoubleDouble epoch_;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
