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
#include "polhode/free/free_rotation.hpp"
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

// Time of ten turns of that body, and the method that others are compared with.
constexpr double turns_10 = 2.0 * 3.141592653589793 * 10.0 / 9.9;
constexpr Adaptive reference{1e-19, Precision::double_double};

// Without a torque the methods for a run of this length end where the closed form does.
void expect_free_rotation(const auto& methods, double allowed) {
  const Vec3 moments[] = {{0.9, 1.0, 1.1}, {3.0, 1.0, 2.5}, {1.0, 1.0, 1.5},
                          {1.5, 1.0, 1.0}, {1.0, 1.0, 1.0}, {1.0, 2.0, 2.9}};
  const Vec3 momenta[] = {{4.5, 4.0, 8.25}, {0, 0, 3}, {0, -2, 1e-9}, {0, 0, 0}, {1e-9, 1, 2}};
  for (const Vec3& I : moments)
    for (const Vec3& g : momenta) {
      const RotorState s{normalized(Quaternion{0.3, -0.4, 0.5, 0.6}), g};
      const double time = norm(g) > 0.0 ? 20.0 * 3.141592653589793 / norm(g) : 1.0;
      for (const Frame& frame : {Frame::inertial(), precessing_frame()}) {
        const System system(Body(I.x, I.y, I.z), frame);
        const RotorState exact = reference_state(
            system, time, FreeRotation(system.body(), inertial_state(system, 0.0, s)).at(time));
        for (const auto& method : methods(time))
          EXPECT_LE(distance(end_of(system, s, 0.0, time, method), exact), allowed);
      }
    }
}

// Axisymmetric, a sphere, far from symmetric, across the separatrix and at rest; terms that are no
// kicks, and that no lanes know.
void expect_double_double_for_every_body(const auto& method, double allowed) {
  const struct {
    Vec3 moments, g;
  } cases[] = {{{1.0, 1.0, 1.5}, {1.0, 0.5, 2.0}},   {{1.5, 1.0, 1.0}, {1.0, 0.5, 2.0}},
               {{1.0, 1.0, 1.0}, {1.0, 0.5, 2.0}},   {{1.0, 2.0, 2.9}, {1.0, 0.5, 2.0}},
               {{1.0, 2.0, 2.9}, {1e-3, 2.0, 1e-3}}, {{1.0, 2.0, 2.9}, {0.0, 0.0, 2.0}},
               {{1.0, 2.0, 2.9}, {0.0, 0.0, 0.0}}};
  for (const auto& c : cases) {
    const System system(
        Body(c.moments.x, c.moments.y, c.moments.z), precessing_frame(),
        {AnyPerturbation("gravity gradient", PointMassTorque{1.0, 0.1, 0.2}),
         AnyPerturbation("damping", Damping{0.01}), AnyPerturbation("turn", Spinner{0.3})});
    const RotorState s{normalized(Quaternion{0.3, -0.4, 0.5, 0.6}), c.g};
    const RotorState exact = end_of(system, s, 0.0, 15.0, reference);
    EXPECT_LE(distance(end_of(system, s, 0.0, 15.0, method), exact), allowed);
  }
}

}  // namespace polhode::splitting_test
