// SPDX-License-Identifier: MIT
#include "polhode/orbit/uniform_angle.hpp"

#include <cmath>

#include "orbit/detail/turn_counter.hpp"

namespace polhode {
inline namespace v0 {
namespace {

// Reduced to [-pi, pi].
DoubleDouble reduced(double start, double rate, const DoubleDouble& elapsed) {
  const DoubleDouble turn = DoubleDouble::two_pi(), angle = start + rate * elapsed;
  return angle - turn * std::rint(angle.hi / turn.hi);
}

}  // namespace

UniformAngle::UniformAngle(double start, double rate, double epoch)
    : start_(start), rate_(rate), epoch_(epoch) {
  if (rate == 0.0) return;
  const DoubleDouble frequency = DoubleDouble(rate) / DoubleDouble::two_pi();
  const DoubleDouble zero = epoch - DoubleDouble(start) / rate;
  if (detail::TurnCounter::counts(frequency, zero))
    turns_ = std::make_shared<const detail::TurnCounter>(frequency, zero);
}

SinCos<double> UniformAngle::at(double t, double rest) const {
  constexpr double two_pi = 6.283185307179586;
  if (turns_ && turns_->counts(t)) {
    const auto phase = static_cast<std::int64_t>(turns_->phase(t));  // of -1/2 to 1/2 turns
    const SinCos<double> whole = sincos(static_cast<double>(phase) * (0x1p-64 * two_pi));
    const double beyond = rest * rate_;
    return {whole.sin + beyond * whole.cos, whole.cos - beyond * whole.sin};
  }
  const DoubleDouble angle = reduced(start_, rate_, DoubleDouble::sum(t, -epoch_) + rest);
  const SinCos<double> whole = sincos(angle.hi);
  return {whole.sin + angle.lo * whole.cos, whole.cos - angle.lo * whole.sin};
}

SinCos<DoubleDouble> UniformAngle::at(const DoubleDouble& t) const {
  return sincos(reduced(start_, rate_, t - epoch_));
}

}  // namespace v0
}  // namespace polhode
