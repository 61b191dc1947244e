// SPDX-License-Identifier: MIT
// A rate as a sum of powers of t, sines and cosines, "5e-3 + 1e-5*t - 2e-4*cos(0.3*t + 1)", and its
// integral, the angle from t = 0.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "polhode/math/real.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

class RateFormula {
 public:
  // DomainError with what is expected, and where.
  explicit RateFormula(std::string_view text);

  // The same with t in units of `time` and the rate in units of `rate`.
  RateFormula in_units(double time, double rate) const;

  // The integral of the rate from 0 to t.
  template <Real T>
  T angle(const T& t) const {
    using std::cos;
    using std::sin;
    T sum(0.0), power = t;
    for (std::size_t n = 0; n < powers_.size(); ++n, power = power * t)
      sum = sum + T(powers_[n] / static_cast<double>(n + 1)) * power;
    for (const Wave& w : waves_) {
      // c cos(f t + p): its integral without the cancellation of sin(f t + p) - sin p
      const T half = T(0.5 * w.frequency) * t;
      sum = sum + T(2.0 * w.amplitude / w.frequency) * sin(half) * cos(half + T(w.phase));
    }
    return sum;
  }

 private:
  struct Wave {
    double amplitude, frequency, phase;
  };
  std::vector<double> powers_;  // of t^n
  std::vector<Wave> waves_;     // amplitude cos(frequency t + phase)
};

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
