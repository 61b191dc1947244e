// SPDX-License-Identifier: MIT
// RotorEquations: the equations of motion of a system, prepared for many evaluations along a run.
//
// Equations   those of polhode/system/system.hpp, with the reciprocals of the moments in
//             double-double. The time has two parts, and terms and frame see both.
// Units       those of the system.
// Domain      T is double, DoubleDouble or Tangent. |q| = 1 is expected to rounding. `sides` are
//             those of the switching functions of the terms; nullptr: as their values say. A system
//             with a damper: the state of the rotor alone does not say how it turns, and `rates`
//             takes the rate of the body from its caller.
// Accuracy    a few roundings; the rounding of 1 / I would be 6e-12 rad after 1e4 turns.
// Errors      none; what a term throws passes through.
// Cost        the terms, and 50 flops.
#pragma once

#include <array>
#include <concepts>
#include <span>
#include <utility>
#include <vector>

#include "polhode/math/double_double.hpp"
#include "polhode/system/system.hpp"

namespace polhode {
inline namespace v0 {

// The side of every switching function of a system, term by term.
struct SwitchSides {
  std::vector<std::size_t> first;  // of each term in `values`; at last their number
  std::vector<double> values;      // +1 or -1

  std::span<const double> of(std::size_t term) const {
    return std::span(values).subspan(first[term], first[term + 1] - first[term]);
  }
};

// The sum of the terms' effects on given sides. Not inline: terms that switch are rare.
template <Real T>
[[gnu::noinline]] BasicEffect<T> effect_on_sides(const System& system, BasicSetting<T> at,
                                                 const SwitchSides& sides) {
  BasicEffect<T> sum;
  for (std::size_t i = 0; i < system.terms().size(); ++i) {
    at.sides = sides.of(i);
    sum = sum + system.terms()[i].effect(at);
  }
  return sum;
}

// The same on sides that may be given. A damper adds its own effect elsewhere.
template <Real T>
[[gnu::always_inline]] inline BasicEffect<T> sum_of_terms(const System& system,
                                                          const BasicSetting<T>& at,
                                                          const SwitchSides* sides) {
  const std::vector<AnyPerturbation>& terms = system.terms();
  if (terms.empty()) return {};
  if (sides) return effect_on_sides(system, at, *sides);
  BasicEffect<T> sum = terms.front().effect(at);
  for (std::size_t i = 1; i < terms.size(); ++i) sum = sum + terms[i].effect(at);
  return sum;
}

template <Real T>
class RotorEquations {
 public:
  explicit RotorEquations(System system)
      : system_(std::move(system)),
        inverse_{inverse(system_.body().moments().x), inverse(system_.body().moments().y),
                 inverse(system_.body().moments().z)} {}

  const System& system() const { return system_; }

  [[gnu::always_inline]] BasicRotorRates<T> operator()(const DoubleDouble& t,
                                                       const BasicRotorState<T>& s,
                                                       const SwitchSides* sides = nullptr) const {
    return (*this)(t, s, sides, Unchanged{});
  }
  // As what `as` makes of them, in each kind of frame by itself: GCC writes an array of rates later
  // where the two meet first.
  template <class As>
  [[gnu::always_inline]] auto operator()(const DoubleDouble& t, const BasicRotorState<T>& s,
                                         const SwitchSides* sides, const As& as) const {
    return rates(t, s, sides, FreeRate{*this}, as);
  }

  // At the rate w0(g) that the body would have without terms: I^-1 g, and what a damper adds to it.
  // Asked for after the terms: what is kept in registers over their calls costs more.
  template <class Rate>
  [[gnu::always_inline]] BasicRotorRates<T> rates(const DoubleDouble& t,
                                                  const BasicRotorState<T>& s,
                                                  const SwitchSides* sides, const Rate& w0) const {
    return rates(t, s, sides, w0, Unchanged{});
  }

  // I^-1 g
  [[gnu::always_inline]] BasicVec3<T> free_rate(const BasicVec3<T>& g) const {
    return {times(g.x, inverse_[0]), times(g.y, inverse_[1]), times(g.z, inverse_[2])};
  }

  // Where the terms are evaluated; for a moving frame without its attitude.
  [[gnu::always_inline]] BasicSetting<T> setting(const DoubleDouble& t,
                                                 const BasicRotorState<T>& s) const {
    BasicSetting<T> at{system_.body(), working(t), s, {}, T(0.0)};
    if constexpr (!is_wide) at.t_rest = T(t.lo);
    return at;
  }

  // At all of the time: q and what it turns in the rest of t.
  BasicFrameMotion<T> frame_motion(const DoubleDouble& t) const {
    BasicFrameMotion<T> frame = system_.frame().at(working(t));
    if constexpr (!is_wide) {
      const T half(0.5 * t.lo);
      const BasicVec3<T> turn = half * frame.mu_S;
      const BasicQuaternion<T> d = frame.q_IS * BasicQuaternion<T>{T(0.0), turn.x, turn.y, turn.z};
      const BasicQuaternion<T>& q = frame.q_IS;
      frame.q_IS = {q.w + d.w, q.x + d.x, q.y + d.y, q.z + d.z};
    }
    return frame;
  }

 private:
  static constexpr bool is_wide = std::same_as<T, DoubleDouble>;

  template <class Rate, class As>
  [[gnu::always_inline]] auto rates(const DoubleDouble& t, const BasicRotorState<T>& s,
                                    const SwitchSides* sides, const Rate& w0, const As& as) const {
    BasicSetting<T> at = setting(t, s);
    if (system_.frame().is_inertial()) {
      const BasicEffect<T> e = sum_of_terms(system_, at, sides);
      return as(inertial_rates(at.s, w0(at.s.g), e));
    }
    const BasicFrameMotion<T> frame = frame_motion(t);
    at.q_IS = frame.q_IS;
    const BasicEffect<T> e = sum_of_terms(system_, at, sides);
    return as(relative_rates(inertial_rates(at.s, w0(at.s.g), e), at.s.q, frame.mu_S));
  }

  struct Unchanged {
    [[gnu::always_inline]] BasicRotorRates<T> operator()(const BasicRotorRates<T>& r) const {
      return r;
    }
  };
  // Not a lambda: one is not always taken in line.
  struct FreeRate {
    const RotorEquations& of;
    [[gnu::always_inline]] BasicVec3<T> operator()(const BasicVec3<T>& g) const {
      return of.free_rate(g);
    }
  };

  static DoubleDouble inverse(double I) { return DoubleDouble(1.0) / I; }
  static T working(const DoubleDouble& t) {
    if constexpr (is_wide) {
      return t;
    } else {
      return T(t.hi);
    }
  }
  static T times(const T& g, const DoubleDouble& c) {
    if constexpr (is_wide) {
      return g * c;
    } else {
      return g * c.hi + g * c.lo;
    }
  }

  System system_;
  std::array<DoubleDouble, 3> inverse_;
};

}  // namespace v0
}  // namespace polhode
