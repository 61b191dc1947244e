// SPDX-License-Identifier: MIT
// The equations of motion of a rotor as an ode sees them: an array of (q, g), its rates, its
// invariant, and the measure of an error in it.
#pragma once

#include <array>
#include <cmath>

#include "math/finite.hpp"
#include "polhode/detail/ode/runge_kutta.hpp"
#include "polhode/rotor/rotor_state.hpp"
#include "system/rotor_equations.hpp"

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
// Of numbers that begin with those of a rotor, at `first`.
template <Real T, std::size_t N>
BasicRotorState<T> rotor_state(const std::array<T, N>& y, std::size_t first = 0) {
  const auto n = [&](std::size_t i) -> const T& { return y[first + i]; };
  return {{n(0), n(1), n(2), n(3)}, {n(4), n(5), n(6)}};
}

// The start of a run in the number type of the run.
template <Real T>
BasicRotorState<T> widened(const RotorState& s) {
  const BasicQuaternion<T> q{T(s.q.w), T(s.q.x), T(s.q.y), T(s.q.z)};
  return {normalized(q), {T(s.g.x), T(s.g.y), T(s.g.z)}};
}
// A state of a run in double, q normalised before it is rounded.
template <Real T>
Vec3 rounded(const BasicVec3<T>& v) {
  return {to_double(v.x), to_double(v.y), to_double(v.z)};
}
template <Real T>
RotorState rounded(const BasicRotorState<T>& s) {
  const BasicQuaternion<T> q = normalized(s.q);
  return {{to_double(q.w), to_double(q.x), to_double(q.y), to_double(q.z)}, rounded(s.g)};
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

template <Real T>
class RotorField {
 public:
  using Number = T;
  using Values = RotorValues<T>;
  using State = SystemState;

  explicit RotorField(const System& system) : equations_(system) {}

  const System& system() const { return equations_.system(); }
  const RotorEquations<T>& equations() const { return equations_; }
  // The field whose stages say what is not finite.
  const RotorField& watched() const { return *this; }

  [[gnu::always_inline]] Values operator()(const DoubleDouble& t, const Values& y,
                                           const SwitchSides* sides = nullptr) const {
    return equations_(t, rotor_state<T>(y), sides, AsValues{});
  }

  static Values start(const RotorState& s) { return rotor_values(widened<T>(s)); }
  static Values values(const RotorState& s) { return rotor_values(s); }
  static SystemState state(const Values& y) { return rotor(y); }
  static RotorState rotor(const Values& y) { return rounded(rotor_state<T>(y)); }
  static double error_size(const Values& error, const Values& y, const Values& increment) {
    return RotorErrorSize()(error, y, increment);
  }
  static void settle(CompensatedState<T, rotor_size<T>>& s) { restore_norm(s); }

 private:
  struct AsValues {
    [[gnu::always_inline]] Values operator()(const BasicRotorRates<T>& r) const {
      return {r.q.w, r.q.x, r.q.y, r.q.z, r.g.x, r.g.y, r.g.z};
    }
  };

  RotorEquations<T> equations_;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
