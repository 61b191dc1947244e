// SPDX-License-Identifier: MIT
// UniformAngle: sine and cosine of an angle that advances uniformly.
//
// Equations   angle(t) = start + rate (t - epoch).
// Units       rate in rad per time.
// Domain      any finite start, rate and epoch.
// Accuracy    a rounding of sine and cosine, and what a rounding of t does, after any number of
//             turns: the angle is formed as an integer modulo one turn, or in double-double.
// Errors      none; what is not finite gives NaN.
// Cost        some 17 ns in double (benchmarks/orbit.cpp); copies share what is prepared.
#pragma once

#include <memory>

#include "polhode/detail/math/trigonometry.hpp"
#include "polhode/detail/orbit/many_times.hpp"
#include "polhode/math/double_double.hpp"
#include "polhode/math/dual.hpp"

namespace polhode {
inline namespace v0 {

namespace detail {
class TurnCounter;
}  // namespace detail

class UniformAngle {
 public:
  UniformAngle(double start, double rate, double epoch);

  double start() const { return start_; }
  double rate() const { return rate_; }
  double epoch() const { return epoch_; }

  // Of the angle at t + rest; T = double, DoubleDouble, a Dual of them, or any other Real.
  SinCos<double> at(double t, double rest = 0.0) const;
  SinCos<DoubleDouble> at(const DoubleDouble& t) const;
  // Of two of them at t, in the time of one.
  struct Two {
    SinCos<double> first, second;
  };
  static Two both(const UniformAngle& first, const UniformAngle& second, double t);
  // The same in double at many times, in lanes.
  void at(const TimeRows& times, double* sine, double* cosine, InstructionSet set) const;
  template <Real T, int N>
  SinCos<Dual<T, N>> at(const Dual<T, N>& t) const {
    const auto [s, c] = at(t.value);
    return {t.chained(s, T(rate_) * c), t.chained(c, -(T(rate_) * s))};
  }
  template <Real T>
  SinCos<T> at(const T& t) const {
    using std::cos;
    using std::sin;
    const T angle = T(start_) + T(rate_) * (t - T(epoch_));
    return {sin(angle), cos(angle)};
  }

 private:
  // The angle less whole turns, and what is beyond it.
  struct Reduced {
    double angle, beyond;
  };
  Reduced reduced(double t, double rest) const;

  double start_, rate_, epoch_;
  std::shared_ptr<const detail::TurnCounter> turns_;  // null where it does not serve
};

}  // namespace v0
}  // namespace polhode
