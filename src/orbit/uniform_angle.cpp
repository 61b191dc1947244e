// SPDX-License-Identifier: MIT
#include "polhode/orbit/uniform_angle.hpp"

#include <cmath>

#include "orbit/detail/orbit_lanes.hpp"
#include "orbit/detail/turn_counter.hpp"
#include "polhode/math/pack_functions.hpp"

namespace polhode {
inline namespace v0 {
namespace {

// Reduced to [-pi, pi].
DoubleDouble reduced_wide(double start, double rate, const DoubleDouble& elapsed) {
  const DoubleDouble turn = DoubleDouble::two_pi(), angle = start + rate * elapsed;
  return angle - turn * std::rint(angle.hi / turn.hi);
}

SinCos<double> turned(const SinCos<double>& whole, double beyond) {
  return {whole.sin + beyond * whole.cos, whole.cos - beyond * whole.sin};
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

UniformAngle::Reduced UniformAngle::reduced(double t, double rest) const {
  constexpr double two_pi = 6.283185307179586;
  if (turns_ && turns_->counts(t)) {
    const auto phase = static_cast<std::int64_t>(turns_->phase(t));  // of -1/2 to 1/2 turns
    return {static_cast<double>(phase) * (0x1p-64 * two_pi), rest * rate_};
  }
  const DoubleDouble angle = reduced_wide(start_, rate_, DoubleDouble::sum(t, -epoch_) + rest);
  return {angle.hi, angle.lo};
}

SinCos<double> UniformAngle::at(double t, double rest) const {
  using One = Pack<InstructionSet::baseline>;  // a lane has the bits of any
  const Reduced of = reduced(t, rest);
  const SinCos<One> whole = sincos(One(of.angle));
  return turned({whole.sin.lanes[0], whole.cos.lanes[0]}, of.beyond);
}

void UniformAngle::at(const TimeRows& times, double* sine, double* cosine,
                      InstructionSet set) const {
  const detail::OrbitLanes lanes = detail::orbit_lanes(set);
  detail::each_orbit_block(times.count, [&](std::size_t first, std::size_t count) {
    detail::OrbitBlock angle, beyond, s, c;
    for (std::size_t i = 0; i < count; ++i) {
      const Reduced of = reduced(times.t[first + i], times.rest_of(first + i));
      angle.of[i] = of.angle;
      beyond.of[i] = of.beyond;
    }
    angle.fill(angle.of, count);
    lanes.sines(count, angle.of, s.of, c.of);
    for (std::size_t i = 0; i < count; ++i) {
      const SinCos<double> at = turned({s.of[i], c.of[i]}, beyond.of[i]);
      sine[first + i] = at.sin;
      cosine[first + i] = at.cos;
    }
  });
}

SinCos<DoubleDouble> UniformAngle::at(const DoubleDouble& t) const {
  return sincos(reduced_wide(start_, rate_, t - epoch_));
}

}  // namespace v0
}  // namespace polhode
