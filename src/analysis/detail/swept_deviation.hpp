// SPDX-License-Identifier: MIT
// A motion with a deviation from it, as Collocation sees them: the rotor, at 7 what is next to it,
// at 14 the integral of the growth L, at 15 that of MEGNO; and the logarithm of what the deviation
// was scaled down by.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "analysis/detail/deviation_field.hpp"
#include "dynamics/collocation/tangent_stages.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// At 7: dq and dg, of the derivative of the steps.
class SweptVariation {
 public:
  static constexpr double reach = 0x1p200;

  SweptVariation(const System& system, double momentum_scale)
      : jacobian_(system), scale_(momentum_scale) {}

  const RotorJacobian& jacobian() const { return jacobian_; }
  Deviation deviation(const RotorState& s, const RotorState& d) const {
    const double square = (s.q.w * s.q.w + s.q.x * s.q.x) + (s.q.y * s.q.y + s.q.z * s.q.z);
    const Quaternion half = conj(s.q) * d.q;
    const double two = 2.0 / square;
    return {{two * half.x, two * half.y, two * half.z}, (1.0 / scale_) * d.g};
  }
  RotorState moved(const RotorState& s, const Deviation& d) const {
    const Vec3 half = 0.5 * d.turn;
    return {s.q * Quaternion{0.0, half.x, half.y, half.z}, scale_ * d.momentum};
  }
  double error_size(const RotorState& s, const RotorState& error, const RotorState& d,
                    const RotorState&) const {
    return length(deviation(s, error)) / length(deviation(s, d));
  }

 private:
  RotorJacobian jacobian_;
  double scale_;
};

// At 7: a second motion.
class SweptNeighbour {
 public:
  static constexpr double reach = neighbour_reach;

  SweptNeighbour(const System&, double momentum_scale) : scale_(momentum_scale) {}

  Deviation deviation(const RotorState& s, const RotorState& other) const {
    return detail::deviation(s, other, scale_);
  }
  RotorState moved(const RotorState& s, const Deviation& d) const { return moved_by(s, d, scale_); }
  double error_size(const RotorState&, const RotorState& error, const RotorState& other,
                    const RotorState& increment) const {
    return RotorErrorSize()(rotor_values(error), rotor_values(other), rotor_values(increment));
  }

 private:
  double scale_;
};

// `By` is one of the two.
template <class By>
class SweptDeviation {
 public:
  static constexpr std::size_t size = 17;
  static constexpr std::size_t beside = 7, growth_place = 14, megno_place = 15, behind = 16;
  using Values = std::array<double, size>;
  using State = DeviatedState;

  SweptDeviation(const System& system, const Growth& growth)
      : rotor_(system), by_(system, growth.momentum_scale), growth_(growth) {}

  const RotorField<double>& watched() const { return rotor_; }
  const RotorField<double>& rotor_alone() const { return rotor_; }
  const RotorJacobian& jacobian() const { return by_.jacobian(); }
  const Growth& growth() const { return growth_; }

  // Of the rotor alone: how long the first step is.
  Values operator()(const DoubleDouble& t, const Values& y, const SwitchSides* sides) const {
    const RotorValues<double> f = rotor_(t, rotor_at(y, 0), sides);
    Values r{};
    std::copy_n(f.begin(), 7, r.begin());
    return r;
  }
  Values start(const RotorState& s, const Deviation& d) const {
    Values y{};
    const RotorValues<double> first = rotor_values(s);
    std::copy_n(first.begin(), 7, y.begin());
    put(y, d);
    return y;
  }
  Deviation deviation_of(const Values& y) const {
    return by_.deviation(rotor_state<double>(y), rotor_state<double>(y, beside));
  }
  // L.
  double grown(const RotorState& s, const RotorState& next_to, double scaled_down) const {
    return scaled_down + std::log(length(by_.deviation(s, next_to)) / growth_.initial_length);
  }
  static RotorState rotor(const Values& y) { return rounded(rotor_state<double>(y)); }
  DeviatedState state(const Values& y) const {
    const double L = grown(rotor_state<double>(y), rotor_state<double>(y, beside), y[behind]);
    return {rotor(y), deviation_of(y), L, y[growth_place], y[megno_place]};
  }
  // The error of a motion and that of its deviation, relative to each. The integrals follow: they
  // hold nothing that the rest does not.
  double error_size(const Values& error, const Values& y, const Values& increment) const {
    return larger(
        RotorErrorSize()(rotor_at(error, 0), rotor_at(y, 0), rotor_at(increment, 0)),
        by_.error_size(rotor_state<double>(y), rotor_state<double>(error, beside),
                       rotor_state<double>(y, beside), rotor_state<double>(increment, beside)));
  }
  // After a step: a deviation that is not too long or too short.
  template <class Compensated>
  void rescale(Compensated& s) const {
    const Deviation d = deviation_of(s.y);
    const double length_now = length(d), target = growth_.target;
    if (target < By::reach * length_now && length_now < By::reach * target) return;
    if (!(length_now > 0.0) || !std::isfinite(length_now)) return;  // state() says it
    put(s.y, scaled(d, target / length_now));
    s.y[behind] += std::log(length_now / length(deviation_of(s.y)));
    for (std::size_t i = beside; i < growth_place; ++i) s.carry[i] = 0.0;
  }

 private:
  void put(Values& y, const Deviation& d) const {
    const RotorValues<double> next_to = rotor_values(by_.moved(rotor_state<double>(y), d));
    std::copy_n(next_to.begin(), 7, y.begin() + beside);
  }

  RotorField<double> rotor_;
  By by_;
  Growth growth_;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
