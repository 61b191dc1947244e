// SPDX-License-Identifier: MIT
// A frame of any attitude: its motion by dual numbers of the time.
#pragma once

#include <utility>

#include "polhode/frame/frame_motion.hpp"
#include "polhode/math/double_double.hpp"
#include "polhode/math/dual.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

class ErasedFrame {
 public:
  virtual ~ErasedFrame() = default;
  virtual BasicFrameMotion<double> at(double t) const = 0;
  virtual BasicFrameMotion<DoubleDouble> at(const DoubleDouble& t) const = 0;
};

// mu_S = 2 q* dq/dt of a unit quaternion carried as a dual number.
template <Real T>
BasicFrameMotion<T> frame_motion(const BasicQuaternion<Dual<T, 1>>& q) {
  const BasicQuaternion<T> value{q.w.value, q.x.value, q.y.value, q.z.value};
  const BasicQuaternion<T> rate{q.w.derivative[0], q.x.derivative[0], q.y.derivative[0],
                                q.z.derivative[0]};
  const BasicQuaternion<T> mu = conj(value) * rate;
  return {value, {T(2.0) * mu.x, T(2.0) * mu.y, T(2.0) * mu.z}};
}

template <class F>
class HeldFrame final : public ErasedFrame {
 public:
  explicit HeldFrame(F attitude) : attitude_(std::move(attitude)) {}
  BasicFrameMotion<double> at(double t) const override { return at_any(t); }
  BasicFrameMotion<DoubleDouble> at(const DoubleDouble& t) const override { return at_any(t); }

 private:
  template <Real T>
  BasicFrameMotion<T> at_any(const T& t) const {
    return frame_motion<T>(normalized(attitude_(Dual<T, 1>::variable(t, 0))));
  }
  F attitude_;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
