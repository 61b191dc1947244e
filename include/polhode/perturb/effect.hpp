// SPDX-License-Identifier: MIT
// Effect{v, u}: what a perturbation does to a rotor, and the concepts that its term satisfies.
//
// Equations   w_SB = I^-1 g + v, dg_B/dt = g_B x w_SB + u. For a Hamiltonian term H'(t, q, g):
//             v = dH'/dg, the convective term of [SA (105)-(107)], and u = -dH'/d(theta_B), the
//             derivative by a turn of the body about its own axes.
// Units       v in rad per time; u a torque, momentum per time; H' an energy.
// Domain      a setting's state is q_SB, g_B: attitude with respect to the reference frame S, which
//             has attitude q_IS in inertial axes. q_SB is a unit quaternion. A term is called with
//             double, DoubleDouble (accurate runs) and Tangent (state transition matrices); only
//             double is required.
// Accuracy    that of the term.
// Errors      a term may throw: integrate passes the exception on unchanged.
// Cost        a setting is a view: no copy of the body.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <span>
#include <vector>

#include "polhode/detail/orbit/many_times.hpp"
#include "polhode/detail/perturb/affine_torque.hpp"
#include "polhode/math/double_double.hpp"
#include "polhode/math/dual.hpp"
#include "polhode/perturb/detail/constant_quaternion.hpp"
#include "polhode/perturb/detail/rotate_inverse.hpp"
#include "polhode/rotor/body.hpp"
#include "polhode/rotor/rotor_state.hpp"

namespace polhode {
inline namespace v0 {

// A number with its derivatives by the six coordinates (dtheta_B, dg_B) of an initial state.
using Tangent = Dual<double, 6>;

template <Number T>
struct BasicEffect {
  BasicVec3<T> v;  // body components of the rate that the term adds to I^-1 g
  BasicVec3<T> u;  // body components of the torque

  constexpr bool operator==(const BasicEffect&) const
    requires Real<T>
  = default;
};
using Effect = BasicEffect<double>;

template <Number T>
constexpr BasicEffect<T> operator+(const BasicEffect<T>& a, const BasicEffect<T>& b) {
  return {a.v + b.v, a.u + b.u};
}

// Where a term is asked: the body, the time, its state in the reference frame S, and S itself.
template <Number T>
struct BasicSetting {
  const Body& body;
  T t;
  BasicRotorState<T> s;     // q_SB, g_B
  BasicQuaternion<T> q_IS;  // identity where the reference frame is inertial
  // What T cannot hold of the time: it is t + t_rest. A term that follows a motion for long (an
  // orbit) adds it, else the rounding of t is the largest error of a compensated run.
  T t_rest = T(0.0);
  // Of a term that switches: +1 or -1 for each of its switching functions, the side that holds here
  // whatever their values are. Empty: that of their values.
  std::span<const double> sides = {};
};
using Setting = BasicSetting<double>;

// What of a setting a term asks for once it knows what depends on the time: see Timewise.
template <Number T>
struct BasicPose {
  BasicVec3<T> moments;  // principal, of the body
  const BasicRotorState<T>& s;
  std::span<const double> sides = {};
};
template <Number T>
BasicPose<T> pose_of(const BasicSetting<T>& at) {
  const Vec3& I = at.body.moments();
  return {{T(I.x), T(I.y), T(I.z)}, at.s, at.sides};
}

// A state with the six variables of its tangent: q exp(dtheta_B / 2), to first order, and g + dg.
template <Real T>
BasicRotorState<Dual<T, 6>> with_variables(const BasicRotorState<T>& s) {
  using D = Dual<T, 6>;
  const T zero(0.0), half(0.5);
  const BasicQuaternion<D> turn{D(T(1.0)), half * D::variable(zero, 0), half * D::variable(zero, 1),
                                half * D::variable(zero, 2)};
  return {detail::constant<T, 6>(s.q) * turn,
          {D::variable(s.g.x, 3), D::variable(s.g.y, 4), D::variable(s.g.z, 5)}};
}
inline BasicSetting<Tangent> with_variables(const Setting& at) {
  return {at.body, Tangent(at.t), with_variables(at.s), detail::constant<double, 6>(at.q_IS),
          Tangent(at.t_rest)};
}

// The axes of a vector that is not the body's own: inertial, or those of the reference frame S.
enum class SpaceAxes { inertial, reference };

// The body components of a vector given in inertial or in reference-frame axes. The lengths of the
// quaternions do not matter.
template <Number T>
BasicVec3<T> body_from_reference(const BasicSetting<T>& at, const BasicVec3<T>& x_S) {
  return detail::rotate_inverse(at.s.q, x_S);
}
template <Number T>
BasicVec3<T> body_from_reference(const BasicPose<T>& at, const BasicVec3<T>& x_S) {
  return detail::rotate_inverse(at.s.q, x_S);
}
template <Number T>
BasicVec3<T> body_from_inertial(const BasicSetting<T>& at, const BasicVec3<T>& x_I) {
  return body_from_reference(at, detail::rotate_inverse(at.q_IS, x_I));
}
template <Number T>
BasicVec3<T> body_from_space(const BasicSetting<T>& at, SpaceAxes axes, const BasicVec3<T>& x) {
  return axes == SpaceAxes::inertial ? body_from_inertial(at, x) : body_from_reference(at, x);
}
// Its components in reference-frame axes: body_from_reference takes them on.
template <Number T>
BasicVec3<T> reference_from_space(const BasicSetting<T>& at, SpaceAxes axes,
                                  const BasicVec3<T>& x) {
  return axes == SpaceAxes::inertial ? detail::rotate_inverse(at.q_IS, x) : x;
}

// As a function, of inertial axes.
template <Number T>
auto in_reference(const BasicSetting<T>& at) {
  return [&q = at.q_IS](const BasicVec3<T>& x) { return detail::rotate_inverse(q, x); };
}

template <class P, class T>
concept PerturbationOn = Real<T> && requires(const P& term, const BasicSetting<T>& at) {
  { term.effect(at) } -> std::same_as<BasicEffect<T>>;
};
template <class P>
concept Perturbation = PerturbationOn<P, double>;

// A term with an energy H'(t, q, g), of which its effect is the derivative.
template <class P, class T = double>
concept Hamiltonian = PerturbationOn<P, T> && requires(const P& term, const BasicSetting<T>& at) {
  { term.energy(at) } -> std::same_as<T>;
};

// A term whose own motion is known exactly: the state after a time h under that term alone (no free
// rotation), t and the frame held.
template <class P>
concept Splittable = Perturbation<P> && requires(const P& term, const Setting& at, double h) {
  { term.flow(at, h) } -> std::same_as<RotorState>;
};

// A term with v = 0 whose u depends on time and attitude alone says `static constexpr bool kick =
// true`: its flow is g + h u.
template <class P>
concept Kick = Perturbation<P> && requires { requires P::kick; };

// A term that is not smooth in time says where: its breakpoints, in increasing order. A run by
// Collocation, Adaptive or VariationOfConstants ends a step at each.
template <class P>
concept Piecewise = Perturbation<P> && requires(const P& term) {
  { term.breakpoints() } -> std::convertible_to<std::vector<double>>;
};

// A term that jumps, or has a kink, where one of its switching functions of time and state is zero,
// says them: smooth, between their zeros too, never NaN, always as many, in the same order. Its
// effect takes the side of each from `sides` of the setting where they are given, and is smooth
// then on both sides of the zero. A run by Collocation or Adaptive ends a step at every change of
// sign that it sees: of two within a quarter of a step, those of a parabola or of a V. A dip that
// is shorter, and neither of them, can be stepped over: give time_scale.
template <class P>
concept Switching = Perturbation<P> && requires(const P& term, const Setting& at) {
  { term.switches(at) } -> std::convertible_to<std::vector<double>>;
};

// A Switching term whose effect begins or ends like a fractional power of the time (sunlight in a
// penumbra, by the power 3/2) where a switching function of the time alone is zero says so:
// Collocation grades its steps towards such zeros.
template <class P>
concept Fading = Switching<P> && requires(const P& term) {
  { term.fades_at_switches() } -> std::convertible_to<bool>;
};

// A term whose torque has kinks that it does not name, many and small (a mesh in sunlight), says
// so: Collocation judges its steps by them, and they are shorter.
template <class P>
concept Kinked = Perturbation<P> && requires(const P& term) {
  { term.has_unnamed_kinks() } -> std::convertible_to<bool>;
};
template <Perturbation P>
bool has_unnamed_kinks(const P& term) {
  if constexpr (Kinked<P>) {
    return term.has_unnamed_kinks();
  } else {
    return false;
  }
}

// A term that follows a motion of its own says how fast that is: the time of a quarter of a turn
// where it is fastest. Unless the user gives largest_step, no step of Collocation or Adaptive is
// longer.
template <class P>
concept Timed = Perturbation<P> && requires(const P& term) {
  { term.time_scale() } -> std::convertible_to<double>;
};

// A term that keeps apart what depends on the time alone: a method that asks at the same times for
// many states asks for that once (Collocation). term.of_time(at) is a Law::OfTime<T>, made of
// nothing but T, and does not look at at.s; term.law() is the rest, and law.effect(of_time, pose)
// what the term does. Law::adds_rate says whether v may be other than 0.
template <class P>
concept Timewise = Perturbation<P> && requires(const P& term, const Setting& at) {
  { term.law() } -> std::convertible_to<const typename P::Law&>;
  { term.of_time(at) } -> std::same_as<typename P::Law::template OfTime<double>>;
  { term.law().effect(term.of_time(at), pose_of(at)) } -> std::same_as<Effect>;
  { P::Law::adds_rate } -> std::convertible_to<bool>;
};

// A Timewise term whose of_time begins with vectors that depend on the time alone, positions on
// orbits or a field, gives those of many times at once: `vectors_of_time` of them, by
// term.vectors_at(times, rows, set), and of_time(at) is term.of_vectors(at, vectors), to the last
// bit, with at.s not looked at. A term need not.
template <class P>
concept TimewiseTogether =
    Timewise<P> && (P::vectors_of_time > 0) &&
    requires(const P& term, const Setting& at, const TimeRows& times,
             const std::array<VectorRows, P::vectors_of_time>& rows, InstructionSet set,
             const std::array<Vec3, P::vectors_of_time>& vectors) {
      term.vectors_at(times, rows, set);
      { term.of_vectors(at, vectors) } -> std::same_as<typename P::Law::template OfTime<double>>;
    };

// The side that a value is on; zero counts as positive.
constexpr double side_of(double value) { return value < 0.0 ? -1.0 : 1.0; }

// A term with v = 0 whose u is c - A g, with c and A of time and attitude alone.
template <class P>
concept AffineInMomentum = Perturbation<P> && requires(const P& term, const Setting& at) {
  { term.affine_torque(at) } -> std::same_as<AffineTorque>;
};

}  // namespace v0
}  // namespace polhode
