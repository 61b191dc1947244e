// SPDX-License-Identifier: MIT
// W1: the gravity gradient of a point mass on a Kepler orbit with e = 0.1, 9.9 turns an orbit,
// written for the tests of Adaptive alone.
#pragma once

#include <cmath>
#include <string>

#include "dynamics/steppers.hpp"
#include "polhode/dynamics/integrate.hpp"

namespace polhode::test {

// gm = a = n = 1, pericentre on x at t = 0, inertial axes.
struct W1Torque {
  static constexpr bool kick = true;

  template <Real T>
  static BasicVec3<T> position(const T& t, const T& rest) {
    using std::cos;
    using std::sin;
    using std::sqrt;
    const T two_pi = T(2.0) * pi<T>();
    const double turns = std::rint(to_double(t) / 6.283185307179586);
    // 2 pi - double(2 pi) times the turns: nothing in double-double
    const T M = ((t - T(turns) * T(6.283185307179586)) -
                 T(turns) * (std::is_same_v<T, DoubleDouble> ? two_pi - T(6.283185307179586)
                                                             : T(2.4492935982947064e-16))) +
                rest;
    const T e(0.1);
    T E = M + e * sin(M);
    for (int i = 0; i < 6; ++i) E = E - (E - e * sin(E) - M) / (T(1.0) - e * cos(E));
    return {cos(E) - e, sqrt(T(1.0) - e * e) * sin(E), T(0.0)};
  }

  template <Real T>
  BasicEffect<T> effect(const BasicSetting<T>& at) const {
    using std::sqrt;
    const BasicVec3<T> r = body_from_inertial(at, position(at.t, at.t_rest));
    const Vec3& I = at.body.moments();
    const BasicVec3<T> Ir{T(I.x) * r.x, T(I.y) * r.y, T(I.z) * r.z};
    const T r2 = dot(r, r);
    return {{}, T(3.0) / (r2 * r2 * sqrt(r2)) * cross(r, Ir)};
  }
};

inline const Body w1_body(0.9, 1.0, 1.1);
inline const RotorState w1_state{{1.0, 0.0, 0.0, 0.0}, {0.9 * 5.0, 4.0, 1.1 * 7.5}};
inline constexpr double w1_turn = 2.0 * 3.141592653589793 / 9.862;

inline Problem w1(const Method& method, double start, double stop, const RotorState& s = w1_state,
                  const Frame& frame = Frame::inertial()) {
  return {System(w1_body, frame, {AnyPerturbation("gravity gradient", W1Torque{})}), s, start, stop,
          method};
}

// Rotation angle between two attitudes, and the relative change of momentum, added up.
inline double distance(const RotorState& a, const RotorState& b) {
  const Quaternion d = conj(normalized(a.q)) * normalized(b.q);
  return 2.0 * norm(Vec3{d.x, d.y, d.z}) + norm(a.g - b.g) / norm(b.g);
}

struct End {
  RotorState s;
  double t;
  std::string advice;
  Statistics statistics;
};
inline End end_of(const Problem& problem) {
  const auto stepper = detail::make_stepper(problem, std::get<Adaptive>(problem.method));
  std::string advice;
  while (advice.empty() && stepper->time() != problem.stop) advice = stepper->advance(problem.stop);
  return {stepper->state(), stepper->time(), advice, stepper->statistics()};
}

}  // namespace polhode::test
