// SPDX-License-Identifier: MIT
// The equations of motion as an ode sees them: an array of (q, g) and its rates, and the measure of
// an error in it.
#pragma once

#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "math/larger.hpp"
#include "polhode/ode/runge_kutta.hpp"
#include "polhode/system/system.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// q, g, and for double one more to fill the processor's registers.
template <Real T>
inline constexpr std::size_t rotor_size = 7;
template <>
inline constexpr std::size_t rotor_size<double> = 8;

template <Real T>
using RotorValues = std::array<T, rotor_size<T>>;

template <Real T>
RotorValues<T> rotor_values(const BasicRotorState<T>& s) {
  return {s.q.w, s.q.x, s.q.y, s.q.z, s.g.x, s.g.y, s.g.z};
}
template <Real T, std::size_t N>
BasicRotorState<T> rotor_state(const std::array<T, N>& y) {
  return {{y[0], y[1], y[2], y[3]}, {y[4], y[5], y[6]}};
}

// |q| = 1 again, of the quaternion that begins at `first`. A change along q turns nothing, so that
// a rounding of |q| does no harm.
template <Real T, std::size_t N>
void restore_norm(CompensatedState<T, N>& s, std::size_t first = 0) {
  T excess = T(-1.0);
  for (std::size_t i = first; i < first + 4; ++i) excess = excess + s.y[i] * s.y[i];
  std::array<T, N> change{};
  for (std::size_t i = first; i < first + 4; ++i) change[i] = T(-0.5) * excess * s.y[i];
  s.add(change);
}

// The side of every switching function of a system, term by term.
struct SwitchSides {
  std::vector<std::size_t> first;  // of each term in `values`; at last their number
  std::vector<double> values;      // +1 or -1

  std::span<const double> of(std::size_t term) const {
    return std::span(values).subspan(first[term], first[term + 1] - first[term]);
  }
};

template <Real T>
[[gnu::noinline]] BasicEffect<T> sum_on_sides(const System& system, BasicSetting<T> at,
                                              const SwitchSides& sides) {
  BasicEffect<T> sum;
  for (std::size_t i = 0; i < system.terms().size(); ++i) {
    at.sides = sides.of(i);
    sum = sum + system.terms()[i].effect(at);
  }
  return sum;
}

// rotor_rates with the reciprocals of the moments prepared, and with all of the time: terms get
// what a double cannot hold of it.
template <Real T>
class RotorField {
 public:
  using Number = T;
  using Values = RotorValues<T>;

  explicit RotorField(System system)
      : system_(std::move(system)),
        inverse_{inverse(system_.body().moments().x), inverse(system_.body().moments().y),
                 inverse(system_.body().moments().z)} {}

  const System& system() const { return system_; }

  [[gnu::always_inline]] RotorValues<T> operator()(const DoubleDouble& t, const RotorValues<T>& y,
                                                   const SwitchSides* sides = nullptr) const {
    BasicSetting<T> at = setting(t, y);
    if (system_.frame().is_inertial()) return values(rates(at, sum_of_terms(at, sides)));
    const BasicFrameMotion<T> frame = frame_motion(t);
    at.q_IS = frame.q_IS;
    return values(relative_rates(rates(at, sum_of_terms(at, sides)), at.s.q, frame.mu_S));
  }

  // Where the terms are asked; for a moving frame without its attitude. y begins with (q, g).
  template <std::size_t N>
  [[gnu::always_inline]] BasicSetting<T> setting(const DoubleDouble& t,
                                                 const std::array<T, N>& y) const {
    BasicSetting<T> at{system_.body(), working(t), rotor_state<T>(y), {}, T(0.0)};
    if constexpr (!is_double_double<T>) at.t_rest = T(t.lo);
    return at;
  }

  // At all of the time: q and what it turns in the rest of t.
  BasicFrameMotion<T> frame_motion(const DoubleDouble& t) const {
    BasicFrameMotion<T> frame = system_.frame().at(working(t));
    if constexpr (!is_double_double<T>) {
      const T half(0.5 * t.lo);
      const BasicVec3<T> turn = half * frame.mu_S;
      const BasicQuaternion<T> d = frame.q_IS * BasicQuaternion<T>{T(0.0), turn.x, turn.y, turn.z};
      const BasicQuaternion<T>& q = frame.q_IS;
      frame.q_IS = {q.w + d.w, q.x + d.x, q.y + d.y, q.z + d.z};
    }
    return frame;
  }

  [[gnu::always_inline]] BasicEffect<T> sum_of_terms(const BasicSetting<T>& at,
                                                     const SwitchSides* sides) const {
    const std::vector<AnyPerturbation>& terms = system_.terms();
    if (terms.empty()) return {};
    if (sides) return sum_on_sides(system_, at, *sides);
    BasicEffect<T> sum = terms.front().effect(at);
    for (std::size_t i = 1; i < terms.size(); ++i) sum = sum + terms[i].effect(at);
    return sum;
  }

 private:
  // The rounding of 1 / I would be 6e-12 rad after 1e4 turns.
  static DoubleDouble inverse(double I) { return DoubleDouble(1.0) / I; }
  static T working(const DoubleDouble& t) {
    if constexpr (is_double_double<T>) {
      return T(t);
    } else {
      return T(t.hi);
    }
  }
  static T times(const T& g, const DoubleDouble& c) {
    if constexpr (is_double_double<T>) {
      return g * c;
    } else {
      return g * c.hi + g * c.lo;
    }
  }

  [[gnu::always_inline]] BasicRotorRates<T> rates(const BasicSetting<T>& at,
                                                  const BasicEffect<T>& e) const {
    const BasicVec3<T>& g = at.s.g;
    const BasicVec3<T> w{times(g.x, inverse_[0]) + e.v.x, times(g.y, inverse_[1]) + e.v.y,
                         times(g.z, inverse_[2]) + e.v.z};
    return inertial_rates(at.s, w, e.u);
  }
  [[gnu::always_inline]] static RotorValues<T> values(const BasicRotorRates<T>& r) {
    return {r.q.w, r.q.x, r.q.y, r.q.z, r.g.x, r.g.y, r.g.z};
  }

  System system_;
  std::array<DoubleDouble, 3> inverse_;
};

// An error relative to |q| = 1 and to |g|, that of a step included: a body may start at rest. The
// derivatives of a dual state count relative to their column: (dq, dg / |g|) by one variable.
class RotorErrorSize {
 public:
  template <Real T>
  double operator()(const std::array<T, rotor_size<T>>& error,
                    const std::array<T, rotor_size<T>>& y,
                    const std::array<T, rotor_size<T>>& increment) const {
    const auto value = [](const T& x) { return to_double(x); };
    const double g = larger(largest(y, 4, 7, value), largest(increment, 4, 7, value));
    double size = relative(largest(error, 0, 4, value), largest(error, 4, 7, value), 1.0, g);
    if constexpr (derivative_order<T> > 0) {
      for (std::size_t j = 0; j < y[0].derivative.size(); ++j) {
        const auto slope = [j](const T& x) { return to_double(x.derivative[j]); };
        const double dg = largest(y, 4, 7, slope);
        const double column = larger(largest(y, 0, 4, slope), g > 0.0 ? dg / g : dg);
        size = larger(size, relative(largest(error, 0, 4, slope), largest(error, 4, 7, slope),
                                     column, g * column));
      }
    }
    return size;
  }

 private:
  template <class Values, class Part>
  static double largest(const Values& v, std::size_t from, std::size_t to, const Part& part) {
    double r = 0.0;
    for (std::size_t i = from; i < to; ++i) r = larger(r, std::abs(part(v[i])));
    return r;
  }
  static double relative(double dq, double dg, double q, double g) {
    // at rest an error of g is relative to nothing, but it may be no number
    if (dg == 0.0 || (g == 0.0 && dg == dg)) return dq / q;
    return larger(dq / q, dg / g);
  }
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
