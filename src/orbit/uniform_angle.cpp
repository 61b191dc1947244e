// SPDX-License-Identifier: MIT
#include "polhode/detail/orbit/uniform_angle.hpp"

#include <cmath>

#include "orbit/detail/orbit_kernels.hpp"
#include "orbit/detail/turn_counter.hpp"

namespace polhode {
inline namespace v0 {
namespace {

// Reduced to [-pi, pi].
DoubleDouble reduced_wide(double start, double rate, const DoubleDouble& elapsed) {
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
  const SinCos<One> at = detail::sines_beyond(One(of.angle), One(of.beyond));
  return {at.sin.lanes[0], at.cos.lanes[0]};
}

UniformAngle::Two UniformAngle::both(const UniformAngle& first, const UniformAngle& second,
                                     double t) {
  using Pair = Pack<InstructionSet::baseline>;
  const Reduced a = first.reduced(t, 0.0), b = second.reduced(t, 0.0);
  const auto at = detail::sines_beyond(Pair(Pair::Doubles{a.angle, b.angle}),
                                       Pair(Pair::Doubles{a.beyond, b.beyond}));
  return {{at.sin.lanes[0], at.cos.lanes[0]}, {at.sin.lanes[1], at.cos.lanes[1]}};
}

void UniformAngle::at(const TimeRows& times, double* sine, double* cosine,
                      InstructionSet set) const {
  const detail::OrbitLanes lanes = detail::orbit_lanes(set);
  detail::each_block(times, [&](const detail::LaneTimes& block) {
    detail::OrbitBlock angle, beyond, s, c;
    for (std::size_t i = 0; i < block.count; ++i) {
      const Reduced of = reduced(block.t[i], block.rest[i]);
      angle.of[i] = of.angle;
      beyond.of[i] = of.beyond;
    }
    angle.fill_up(block.count);
    beyond.fill_up(block.count);
    lanes.sines(block.count, angle.of, beyond.of, {block.room(sine, s), block.room(cosine, c)});
    block.take(sine, s);
    block.take(cosine, c);
  });
}

SinCos<DoubleDouble> UniformAngle::at(const DoubleDouble& t) const {
  return sincos(reduced_wide(start_, rate_, t - epoch_));
}

}  // namespace v0
}  // namespace polhode
