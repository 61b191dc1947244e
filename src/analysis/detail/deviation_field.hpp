// SPDX-License-Identifier: MIT
// A motion with a deviation from it, as an ode sees them: 16 numbers, two of which are the integral
// of the growth L (at 7) and that of MEGNO (at 15).
#pragma once

#include <cmath>
#include <utility>

#include "analysis/detail/growth.hpp"
#include "dynamics/detail/adaptive_field.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

inline constexpr std::size_t growth_integral = 7;
inline constexpr std::size_t megno_integral = 15;
using DeviatedValues = std::array<double, 16>;

inline RotorValues<double> first_rotor(const DeviatedValues& y) {
  return {y[0], y[1], y[2], y[3], y[4], y[5], y[6], 0.0};
}
inline RotorValues<double> second_rotor(const DeviatedValues& y) {
  return {y[8], y[9], y[10], y[11], y[12], y[13], y[14], 0.0};
}

// What both kinds of deviation share: the clock of the run, and the growth behind them.
struct GrowthClock {
  double start = 0.0;
  double momentum_scale = 1.0;
  double initial_length = 1.0;
  double behind = 0.0;  // ln of all factors that the deviation was scaled down by

  double elapsed(const DoubleDouble& t) const { return std::abs((t - start).hi); }
  double growth(const Deviation& d) const { return behind + std::log(length(d) / initial_length); }

  // The rates of the two integrals; `forward` is +1 or -1, as elapsed time runs.
  void integrals(const DoubleDouble& t, const DeviatedValues& y, const Deviation& d, double forward,
                 DeviatedValues& rates) const {
    const double L = growth(d);
    rates[growth_integral] = forward * L;
    rates[megno_integral] = forward * megno(L, y[growth_integral], elapsed(t));
  }
};

// By the variational equations: derivatives of the terms along the deviation are those of one
// variable of a Tangent.
class VariationalField {
 public:
  VariationalField(const System& system, const GrowthClock& clock, double forward)
      : rotor_(system), clock_(&clock), forward_(forward) {}

  static Deviation deviation_of(const DeviatedValues& y, double) {
    return {{y[8], y[9], y[10]}, {y[11], y[12], y[13]}};
  }
  static void put(DeviatedValues& y, const Deviation& d, double) {
    const Vec3 &turn = d.turn, &momentum = d.momentum;
    const double values[] = {turn.x, turn.y, turn.z, momentum.x, momentum.y, momentum.z};
    std::copy_n(values, 6, y.begin() + 8);
  }

  DeviatedValues operator()(const DoubleDouble& t, const DeviatedValues& y,
                            const SwitchSides* sides = nullptr) const {
    const RotorValues<double> values = first_rotor(y);
    const Setting at = rotor_.setting(t, values);
    const System& system = rotor_.system();
    const bool inertial = system.frame().is_inertial();
    const FrameMotion frame = inertial ? FrameMotion{} : rotor_.frame_motion(t);
    const Deviation d = deviation_of(y, 0.0);
    const Vec3 dg = clock_->momentum_scale * d.momentum;
    const auto [e, de] = effects(at, frame.q_IS, d.turn, dg, sides);
    const Vec3& I = system.body().moments();
    const Vec3& g = at.s.g;
    const Vec3 w{g.x / I.x + e.v.x, g.y / I.y + e.v.y, g.z / I.z + e.v.z};
    const Vec3 dw{dg.x / I.x + de.v.x, dg.y / I.y + de.v.y, dg.z / I.z + de.v.z};
    RotorRates rates = inertial_rates(at.s, w, e.u);
    if (!inertial) rates = relative_rates(rates, at.s.q, frame.mu_S);
    // the frame turns both attitudes alike
    const Vec3 turn = dw + cross(d.turn, w);
    const Vec3 momentum = (1.0 / clock_->momentum_scale) * (cross(dg, w) + cross(g, dw) + de.u);
    DeviatedValues r{rates.q.w, rates.q.x, rates.q.y, rates.q.z,
                     rates.g.x, rates.g.y, rates.g.z, 0.0};
    put(r, {turn, momentum}, 0.0);
    clock_->integrals(t, y, d, forward_, r);
    return r;
  }

  const RotorField<double>& rotor() const { return rotor_; }

 private:
  // The sum of the terms and its change by (theta_B, dg).
  std::pair<Effect, Effect> effects(const Setting& at, const Quaternion& q_IS, const Vec3& turn,
                                    const Vec3& dg, const SwitchSides* sides) const {
    const System& system = rotor_.system();
    if (system.terms().empty()) return {};
    const Vec3 half = 0.5 * turn;
    const Quaternion dq = at.s.q * Quaternion{0.0, half.x, half.y, half.z};
    const auto moving = [](double x, double dx) { return Tangent(x, {dx}); };
    const BasicRotorState<Tangent> s{
        {moving(at.s.q.w, dq.w), moving(at.s.q.x, dq.x), moving(at.s.q.y, dq.y),
         moving(at.s.q.z, dq.z)},
        {moving(at.s.g.x, dg.x), moving(at.s.g.y, dg.y), moving(at.s.g.z, dg.z)}};
    const BasicSetting<Tangent> setting{at.body, Tangent(at.t), s, constant<double, 6>(q_IS),
                                        Tangent(at.t_rest)};
    BasicEffect<Tangent> sum;
    if (sides) {
      sum = sum_on_sides(system, setting, *sides);
    } else {
      sum = system.terms().front().effect(setting);
      for (std::size_t i = 1; i < system.terms().size(); ++i)
        sum = sum + system.terms()[i].effect(setting);
    }
    const auto value = [](const BasicVec3<Tangent>& v) {
      return Vec3{v.x.value, v.y.value, v.z.value};
    };
    const auto slope = [](const BasicVec3<Tangent>& v) {
      return Vec3{v.x.derivative[0], v.y.derivative[0], v.z.derivative[0]};
    };
    return {{value(sum.v), value(sum.u)}, {slope(sum.v), slope(sum.u)}};
  }

  RotorField<double> rotor_;
  const GrowthClock* clock_;
  double forward_;
};

// By a second motion, under the same steps.
class NeighbourField {
 public:
  NeighbourField(const System& system, const GrowthClock& clock, double forward)
      : rotor_(system), clock_(&clock), forward_(forward) {}

  static Deviation deviation_of(const DeviatedValues& y, double momentum_scale) {
    return deviation(rotor_state<double>(first_rotor(y)), rotor_state<double>(second_rotor(y)),
                     momentum_scale);
  }
  static void put(DeviatedValues& y, const Deviation& d, double momentum_scale) {
    const RotorValues<double> second =
        rotor_values(moved_by(rotor_state<double>(first_rotor(y)), d, momentum_scale));
    std::copy_n(second.begin(), 7, y.begin() + 8);
  }

  // Both on the sides of the first: they part by less than a step can see.
  DeviatedValues operator()(const DoubleDouble& t, const DeviatedValues& y,
                            const SwitchSides* sides = nullptr) const {
    const RotorValues<double> a = rotor_(t, first_rotor(y), sides);
    const RotorValues<double> b = rotor_(t, second_rotor(y), sides);
    DeviatedValues r{};
    std::copy_n(a.begin(), 7, r.begin());
    std::copy_n(b.begin(), 7, r.begin() + 8);
    clock_->integrals(t, y, deviation_of(y, clock_->momentum_scale), forward_, r);
    return r;
  }

  const RotorField<double>& rotor() const { return rotor_; }

 private:
  RotorField<double> rotor_;
  const GrowthClock* clock_;
  double forward_;
};

// The error of a motion and that of its deviation, relative to each. The integrals follow: they
// hold nothing that the rest does not.
template <class Field>
class DeviatedErrorSize {
 public:
  double operator()(const DeviatedValues& error, const DeviatedValues& y,
                    const DeviatedValues& increment) const {
    const double first =
        RotorErrorSize()(first_rotor(error), first_rotor(y), first_rotor(increment));
    double second = 0.0;
    if constexpr (std::is_same_v<Field, VariationalField>) {
      second = length(Field::deviation_of(error, 0.0)) / length(Field::deviation_of(y, 0.0));
    } else {
      second = RotorErrorSize()(second_rotor(error), second_rotor(y), second_rotor(increment));
    }
    return first < second || second != second ? second : first;
  }
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
