// SPDX-License-Identifier: MIT
// The gravity gradient of a point mass on a Kepler orbit, written for these tests alone: the
// library's own term and orbit are not used as their oracle.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "dynamics/steppers.hpp"
#include "polhode/dynamics/integrate.hpp"
#include "polhode/perturb/effect.hpp"

namespace polhode::splitting_test {

// Orbit about the inertial z axis with a = 1, pericentre on x at t = 0.
struct PointMassTorque {
  static constexpr bool kick = true;
  double mu;
  double e;
  double strength = 1.0;  // factor of torque and energy

  template <Real T>
  BasicVec3<T> position(const T& t) const {
    using std::cos;
    using std::sin;
    using std::sqrt;
    const double n = std::sqrt(mu);
    const double turns = std::rint(to_double(t) * n / 6.283185307179586);
    const T M = T(n) * t - T(turns) * T(2.0) * pi<T>();
    T E = M + T(e) * sin(M);
    for (int i = 0; i < 6; ++i) E = E - (E - T(e) * sin(E) - M) / (T(1.0) - T(e) * cos(E));
    return {cos(E) - T(e), sqrt(T(1.0) - T(e) * T(e)) * sin(E), T(0.0)};
  }
  // 3 mu / r^5 (r x I r), the torque of the energy below.
  template <Real T>
  BasicEffect<T> effect(const BasicSetting<T>& at) const {
    const BasicVec3<T> r = body_from_inertial(at, position(at.t));
    const Vec3& I = at.body.moments();
    const BasicVec3<T> Ir{T(I.x) * r.x, T(I.y) * r.y, T(I.z) * r.z};
    using std::sqrt;
    const T r2 = dot(r, r);
    return {{}, T(3.0 * mu * strength) / (r2 * r2 * sqrt(r2)) * cross(r, Ir)};
  }
  template <Real T>
  T energy(const BasicSetting<T>& at) const {
    const BasicVec3<T> r = body_from_inertial(at, position(at.t));
    const Vec3& I = at.body.moments();
    using std::sqrt;
    const T r2 = dot(r, r);
    return T(1.5 * mu * strength) / (r2 * r2 * sqrt(r2)) *
           (T(I.x) * r.x * r.x + T(I.y) * r.y * r.y + T(I.z) * r.z * r.z);
  }
};

// Linear damping, g' = -rate g, with its own flow.
struct Damping {
  double rate;
  template <Real T>
  BasicEffect<T> effect(const BasicSetting<T>& at) const {
    return {{}, T(-rate) * at.s.g};
  }
  RotorState flow(const Setting& at, double h) const {
    return {at.s.q, std::exp(-rate * h) * at.s.g};
  }
};

// The flow of H' = rate g_x: a steady turn about b1, which moves attitude and momentum.
struct Spinner {
  double rate;
  template <Real T>
  BasicEffect<T> effect(const BasicSetting<T>&) const {
    const BasicVec3<T> v{T(rate), T(0.0), T(0.0)};
    return {v, {}};
  }
  RotorState flow(const Setting& at, double h) const {
    const Quaternion turn = rotation_x(rate * h);
    return {at.s.q * turn, rotate(conj(turn), at.s.g)};
  }
};

struct NoFlow {
  Effect effect(const Setting& at) const { return {{}, -1.0 * at.s.g}; }
};

struct Throws {
  Effect effect(const Setting& at) const {
    if (at.t > 0.5) throw std::runtime_error("no torque here");
    return {};
  }
};

struct BreaksAt {
  static constexpr bool kick = true;
  double t;
  Effect effect(const Setting& at) const {
    return {{}, {at.t > t ? std::sqrt(-1.0) : 0.0, 0.0, 0.0}};
  }
};

inline double rotation_angle(const Quaternion& a, const Quaternion& b) {
  const Quaternion d = conj(a) * b;
  return 2.0 * std::atan2(norm(Vec3{d.x, d.y, d.z}), std::abs(d.w));
}
// Attitude in radians plus momentum relative to its size.
inline double distance(const RotorState& a, const RotorState& b) {
  const double G = norm(b.g);
  return rotation_angle(a.q, b.q) + norm(a.g - b.g) / (G > 0.0 ? G : 1.0);
}
inline std::array<double, 6> difference(const RotorState& a, const RotorState& b) {
  const Quaternion d = conj(b.q) * a.q;
  const double s = d.w < 0.0 ? -2.0 : 2.0, G = norm(b.g);
  const Vec3 g = (1.0 / G) * (a.g - b.g);
  return {s * d.x, s * d.y, s * d.z, g.x, g.y, g.z};
}

// The body of the reference workload and its state: 9.9 rotations per orbit.
inline Body workload_body() { return Body(0.9, 1.0, 1.1); }
inline RotorState workload_state() { return {{1, 0, 0, 0}, {4.5, 4.0, 8.25}}; }
inline Frame precessing_frame() { return Frame::precessing({0.2, 0.3, 1.0}, 0.4); }

template <class M>
RotorState end_of(const System& system, const RotorState& initial, double start, double stop,
                  const M& method) {
  const auto stepper =
      detail::make_stepper(Problem{system, initial, start, stop, method, {}}, method);
  while (stepper->time() != stop) {
    const std::string advice = stepper->advance(stop);
    EXPECT_EQ(advice, "");
    if (!advice.empty()) break;
  }
  return stepper->state();
}

}  // namespace polhode::splitting_test
