// SPDX-License-Identifier: MIT
// A motion with a deviation from it, as an ode sees them: the rotor, at 7 the integral of the
// growth L, from 8 on the deviation, at 15 the integral of MEGNO; and the logarithm of what the
// deviation was scaled down by.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

#include "analysis/detail/deviated_state.hpp"
#include "dynamics/adaptive/rotor_field.hpp"
#include "system/variational_equations.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

inline constexpr std::size_t growth_integral = 7;
inline constexpr std::size_t second = 8;
inline constexpr std::size_t megno_integral = 15;

template <std::size_t N>
RotorValues<double> rotor_at(const std::array<double, N>& y, std::size_t first) {
  RotorValues<double> r{};
  std::copy_n(y.begin() + static_cast<std::ptrdiff_t>(first), 7, r.begin());
  return r;
}

// What a deviation is measured by.
struct Growth {
  double start = 0.0;
  double forward = 1.0;  // or -1, as elapsed time runs
  double momentum_scale = 1.0;
  double target = 1.0;  // the length that it is brought back to
  double initial_length = 1.0;

  double elapsed(const DoubleDouble& t) const { return std::abs((t - start).hi); }
};

// By the variational equations.
class Variational {
 public:
  static constexpr std::size_t size = 16;
  static constexpr std::size_t behind = 14;
  // A linear deviation is scaled down before it leaves the range of a double, and long before.
  static constexpr double reach = 0x1p200;
  using Values = std::array<double, size>;

  Variational(const System& system, double momentum_scale)
      : rotor_(system), equations_(system), scale_(momentum_scale) {}

  static Deviation deviation_of(const Values& y, double) {
    return {{y[8], y[9], y[10]}, {y[11], y[12], y[13]}};
  }
  static void put(Values& y, const Deviation& d, double) {
    const Vec3 &turn = d.turn, &momentum = d.momentum;
    const double values[] = {turn.x, turn.y, turn.z, momentum.x, momentum.y, momentum.z};
    std::copy_n(values, 6, y.begin() + second);
  }
  static double error_size(const Values& error, const Values& y, const Values&) {
    return length(deviation_of(error, 0.0)) / length(deviation_of(y, 0.0));
  }
  static void settle(CompensatedState<double, size>&) {}

  const RotorField<double>& rotor() const { return rotor_; }
  Values operator()(const DoubleDouble& t, const Values& y, const SwitchSides* sides) const {
    const Deviation d = deviation_of(y, 0.0);
    const auto [r, along] =
        equations_(t, rotor_state<double>(y), {d.turn, scale_ * d.momentum}, sides);
    Values rates{r.q.w, r.q.x, r.q.y, r.q.z, r.g.x, r.g.y, r.g.z};
    put(rates, {along.turn, (1.0 / scale_) * along.momentum}, 0.0);
    return rates;
  }

 private:
  RotorField<double> rotor_;
  VariationalEquations equations_;
  double scale_;
};

// By a second motion, under the same steps.
class Neighbour {
 public:
  static constexpr std::size_t size = 18;  // one more to fill the processor's registers
  static constexpr std::size_t behind = 16;
  static constexpr double reach = neighbour_reach;
  using Values = std::array<double, size>;

  Neighbour(const System& system, double) : rotor_(system) {}

  static Deviation deviation_of(const Values& y, double momentum_scale) {
    return deviation(rotor_state<double>(y), rotor_state<double>(y, second), momentum_scale);
  }
  static void put(Values& y, const Deviation& d, double momentum_scale) {
    const RotorValues<double> other =
        rotor_values(moved_by(rotor_state<double>(y), d, momentum_scale));
    std::copy_n(other.begin(), 7, y.begin() + second);
  }
  static double error_size(const Values& error, const Values& y, const Values& increment) {
    return RotorErrorSize()(rotor_at(error, second), rotor_at(y, second),
                            rotor_at(increment, second));
  }
  static void settle(CompensatedState<double, size>& s) { restore_norm(s, second); }

  const RotorField<double>& rotor() const { return rotor_; }
  // Both on the sides of the first: they part by less than a step can see.
  Values operator()(const DoubleDouble& t, const Values& y, const SwitchSides* sides) const {
    const RotorValues<double> a = rotor_(t, rotor_at(y, 0), sides);
    const RotorValues<double> b = rotor_(t, rotor_at(y, second), sides);
    Values r{};
    std::copy_n(a.begin(), 7, r.begin());
    std::copy_n(b.begin(), 7, r.begin() + second);
    return r;
  }

 private:
  RotorField<double> rotor_;
};

// `By` is one of the two.
template <class By>
class DeviationField {
 public:
  using Number = double;
  using Values = typename By::Values;
  using State = DeviatedState;

  DeviationField(const System& system, const Growth& growth)
      : by_(system, growth.momentum_scale), growth_(growth) {}

  const RotorField<double>& watched() const { return by_.rotor(); }

  Values operator()(const DoubleDouble& t, const Values& y, const SwitchSides* sides) const {
    Values r = by_(t, y, sides);
    const double L = grown(y, deviation_of(y));
    r[growth_integral] = growth_.forward * L;
    r[megno_integral] = growth_.forward * megno(L, y[growth_integral], growth_.elapsed(t));
    return r;
  }

  Deviation deviation_of(const Values& y) const {
    return By::deviation_of(y, growth_.momentum_scale);
  }
  static RotorState rotor(const Values& y) { return rounded(rotor_state<double>(y)); }
  DeviatedState state(const Values& y) const {
    const Deviation d = deviation_of(y);
    return {rotor(y), d, grown(y, d), y[growth_integral], y[megno_integral]};
  }
  // The error of a motion and that of its deviation, relative to each. The integrals follow: they
  // hold nothing that the rest does not.
  double error_size(const Values& error, const Values& y, const Values& increment) const {
    const double first =
        RotorErrorSize()(rotor_at(error, 0), rotor_at(y, 0), rotor_at(increment, 0));
    const double other = By::error_size(error, y, increment);
    return first < other || other != other ? other : first;
  }
  // After a step: unit quaternions, and a deviation that is not too long or too short.
  void settle(CompensatedState<double, By::size>& s) const {
    restore_norm(s);
    By::settle(s);
    const Deviation d = deviation_of(s.y);
    const double size = length(d), target = growth_.target;
    if (target < By::reach * size && size < By::reach * target) return;
    if (!(size > 0.0) || !std::isfinite(size)) return;  // state() says it
    By::put(s.y, scaled(d, target / size), growth_.momentum_scale);
    s.y[By::behind] += std::log(size / length(deviation_of(s.y)));
    for (std::size_t i = second; i < megno_integral; ++i) s.carry[i] = 0.0;
  }

 private:
  double grown(const Values& y, const Deviation& d) const {
    return y[By::behind] + std::log(length(d) / growth_.initial_length);
  }

  By by_;
  Growth growth_;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
