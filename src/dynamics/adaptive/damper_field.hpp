// SPDX-License-Identifier: MIT
// The equations of motion of a body with a damper, as an ode sees them: (q, g) and the damper's
// rate relative to the body.
#pragma once

#include "dynamics/adaptive/rotor_field.hpp"
#include "math/finite.hpp"
#include "system/damped_equations.hpp"

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

template <Real T>
class DamperField {
 public:
  using Number = T;
  using Values = DamperValues<T>;
  using State = SystemState;

  explicit DamperField(const System& system) : equations_(system), error_size_(system.body()) {}

  const System& system() const { return equations_.rotor().system(); }
  const RotorEquations<T>& equations() const { return equations_.rotor(); }
  const DamperField& watched() const { return *this; }

  Values operator()(const DoubleDouble& t, const Values& y,
                    const SwitchSides* sides = nullptr) const {
    const auto [r, ds] = equations_(t, rotor_state<T>(y), damper_rate<T>(y), sides);
    return {r.q.w, r.q.x, r.q.y, r.q.z, r.g.x, r.g.y, r.g.z, ds.x, ds.y, ds.z};
  }

  static Values start(const SystemState& s) { return damper_values(widened<T>(s), s.damper_rate); }
  static Values values(const SystemState& s) { return damper_values<double>(s, s.damper_rate); }
  static SystemState state(const Values& y) {
    const RotorState s = rotor(y);
    return {s.q, s.g, rounded(damper_rate<T>(y))};
  }
  static RotorState rotor(const Values& y) { return rounded(rotor_state<T>(y)); }
  double error_size(const Values& error, const Values& y, const Values& increment) const {
    return error_size_(error, y, increment);
  }
  static void settle(CompensatedState<T, 10>& s) { restore_norm(s); }

 private:
  DampedEquations<T> equations_;
  DamperErrorSize error_size_;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
