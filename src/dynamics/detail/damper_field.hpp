// SPDX-License-Identifier: MIT
// The equations of motion of a body with a damper, as an ode sees them: (q, g) and the damper's
// rate relative to the body.
#pragma once

#include "dynamics/detail/adaptive_field.hpp"
#include "math/larger.hpp"
#include "perturb/detail/damper_kernel.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template <Real T>
using DamperValues = std::array<T, 10>;

template <Real T>
DamperValues<T> damper_values(const BasicRotorState<T>& x, const Vec3& s) {
  return {x.q.w, x.q.x, x.q.y, x.q.z, x.g.x, x.g.y, x.g.z, T(s.x), T(s.y), T(s.z)};
}
template <Real T>
BasicVec3<T> damper_rate(const DamperValues<T>& y) {
  return {y[7], y[8], y[9]};
}

template <Real T>
class DamperField {
 public:
  using Number = T;
  using Values = DamperValues<T>;

  explicit DamperField(const System& system)
      : rotor_(system), damper_(system.body(), *system.damper()) {}

  const System& system() const { return rotor_.system(); }
  BasicSetting<T> setting(const DoubleDouble& t, const Values& y) const {
    return rotor_.setting(t, y);
  }
  BasicFrameMotion<T> frame_motion(const DoubleDouble& t) const { return rotor_.frame_motion(t); }

  Values operator()(const DoubleDouble& t, const Values& y,
                    const SwitchSides* sides = nullptr) const {
    BasicSetting<T> at = rotor_.setting(t, y);
    if (system().frame().is_inertial()) return values(at, y, {}, sides);
    const BasicFrameMotion<T> frame = frame_motion(t);
    at.q_IS = frame.q_IS;
    return values(at, y, frame.mu_S, sides);
  }

 private:
  Values values(const BasicSetting<T>& at, const Values& y, const BasicVec3<T>& mu_S,
                const SwitchSides* sides) const {
    const BasicEffect<T> e = rotor_.sum_of_terms(at, sides);
    const BasicVec3<T> s = damper_rate<T>(y);
    const BasicVec3<T> w0 = damper_.rate(at.s.g) + damper_.rate_of_body(s);
    BasicRotorRates<T> r = inertial_rates(at.s, w0 + e.v, e.u);
    if (!system().frame().is_inertial()) r = relative_rates(r, at.s.q, mu_S);
    const BasicVec3<T> ds = damper_.acceleration(w0, r.g, s);
    return {r.q.w, r.q.x, r.q.y, r.q.z, r.g.x, r.g.y, r.g.z, ds.x, ds.y, ds.z};
  }

  RotorField<T> rotor_;
  DamperKernel<T> damper_;
};

// The error of the rotor, and that of the damper relative to the rates of both: a sphere that
// turns with the body has none of its own.
class DamperErrorSize {
 public:
  explicit DamperErrorSize(const Body& body) : moments_(body.moments()) {}

  template <Real T>
  double operator()(const DamperValues<T>& error, const DamperValues<T>& y,
                    const DamperValues<T>& increment) const {
    const double first = RotorErrorSize()(rotor(error), rotor(y), rotor(increment));
    const double ds = largest(damper_rate<T>(error));
    const double scale = larger(rates(y), rates(increment));
    const double second = ds == 0.0 || (scale == 0.0 && ds == ds) ? 0.0 : ds / scale;
    return larger(first, second);
  }

 private:
  template <Real T>
  static RotorValues<T> rotor(const DamperValues<T>& y) {
    RotorValues<T> r{};
    std::copy_n(y.begin(), 7, r.begin());
    return r;
  }
  template <Real T>
  static double largest(const BasicVec3<T>& v) {
    return larger(std::abs(to_double(v.x)), std::abs(to_double(v.y)), std::abs(to_double(v.z)));
  }
  template <Real T>
  double rates(const DamperValues<T>& y) const {
    const BasicVec3<T> w{y[4] / T(moments_.x), y[5] / T(moments_.y), y[6] / T(moments_.z)};
    return larger(largest(w), largest(damper_rate<T>(y)));
  }

  Vec3 moments_;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
