// SPDX-License-Identifier: MIT
// KaneDamper prepared for a body: its formulas on any number type.
#pragma once

#include <array>
#include <concepts>

#include "polhode/math/double_double.hpp"
#include "polhode/perturb/kane_damper.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template <Real T>
class DamperKernel {
 public:
  DamperKernel(const Body& body, const KaneDamper& damper)
      : moment_(T(damper.moment())),
        decay_(as_number(DoubleDouble(damper.friction()) / DoubleDouble(damper.moment()))) {
    const Vec3& I = body.moments();
    for (int i = 0; i < 3; ++i) {
      const auto k = static_cast<std::size_t>(i);
      inverse_[k] = DoubleDouble(1.0) / I[i];
      lag_[k] = DoubleDouble(I[i]) / DoubleDouble::sum(I[i], -damper.moment());
    }
  }

  // v = -J I^-1 s
  [[gnu::always_inline]] BasicVec3<T> rate_of_body(const BasicVec3<T>& s) const {
    const T less = -moment_;
    return {times(less * s.x, inverse_[0]), times(less * s.y, inverse_[1]),
            times(less * s.z, inverse_[2])};
  }
  // ds/dt, w0 = I^-1 g + v
  [[gnu::always_inline]] BasicVec3<T> acceleration(const BasicVec3<T>& w0, const BasicVec3<T>& dg,
                                                   const BasicVec3<T>& s) const {
    return {times((s.y * w0.z - s.z * w0.y) - decay_ * s.x - times(dg.x, inverse_[0]), lag_[0]),
            times((s.z * w0.x - s.x * w0.z) - decay_ * s.y - times(dg.y, inverse_[1]), lag_[1]),
            times((s.x * w0.y - s.y * w0.x) - decay_ * s.z - times(dg.z, inverse_[2]), lag_[2])};
  }
  // By which the friction alone slows number n of s: c / J over 1 - J/I.
  T decay(std::size_t n) const { return times(decay_, lag_[n]); }
  BasicVec3<T> rate(const BasicVec3<T>& g) const {
    return {times(g.x, inverse_[0]), times(g.y, inverse_[1]), times(g.z, inverse_[2])};
  }
  // x / (1 - J/I)
  BasicVec3<T> lagged(const BasicVec3<T>& x) const {
    return {times(x.x, lag_[0]), times(x.y, lag_[1]), times(x.z, lag_[2])};
  }

 private:
  static T as_number(const DoubleDouble& x) {
    if constexpr (std::same_as<T, DoubleDouble>) {
      return x;
    } else {
      return T(x.hi);
    }
  }
  static T times(const T& x, const DoubleDouble& c) {
    if constexpr (std::same_as<T, DoubleDouble>) {
      return x * c;
    } else {
      return x * c.hi + x * c.lo;
    }
  }

  T moment_;
  T decay_;                              // c / J
  std::array<DoubleDouble, 3> inverse_;  // 1 / I: see RotorField
  std::array<DoubleDouble, 3> lag_;      // 1 / (1 - J/I)
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
