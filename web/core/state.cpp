// SPDX-License-Identifier: MIT
// Bodies and states.
#include <cmath>
#include <cstdlib>

#include "numbers.hpp"
#include "polhode/error.hpp"
#include "polhode/free/free_rotation.hpp"
#include "polhode/light/ellipsoid.hpp"
#include "polhode/rotor/attitude.hpp"
#include "polhode/version.hpp"
#include "polhode_web.h"
#include "refusals.hpp"

using namespace polhode;
using namespace polhode::web;

namespace {

// The least turn that brings the direction a to b, both of length 1.
Quaternion least_turn(const Vec3& a, const Vec3& b) {
  const double along = dot(a, b);
  if (along > -0.5) {
    const Vec3 axis = cross(a, b);
    return normalized(Quaternion{1.0 + along, axis.x, axis.y, axis.z});
  }
  // nearly opposite: half a turn about an axis across a, then the small rest
  const Vec3 other = std::abs(a.x) < 0.7 ? Vec3{1.0, 0.0, 0.0} : Vec3{0.0, 1.0, 0.0};
  const Vec3 across = cross(a, other);
  const Vec3 axis = (1.0 / norm(across)) * across;
  const Quaternion half_turn{0.0, axis.x, axis.y, axis.z};
  return least_turn(-a, b) * half_turn;
}

}  // namespace

const char* polhode_version() { return version(); }

void* polhode_allocate(uint32_t bytes) { return std::malloc(bytes); }
void polhode_release(void* memory) { std::free(memory); }

int polhode_body(const double* moments) {
  return guarded([&] { body(moments); });
}

int polhode_body_of_tensor(const double* tensor, double* result) {
  return guarded([&] {
    const Body of = Body::from_tensor(matrix(tensor));
    put(put(result, of.moments()), of.q_FB());
  });
}

int polhode_ellipsoid_moments(const double* semi_axes, double mass, double* moments) {
  return guarded([&] {
    const Vec3 I = light::homogeneous_moments(
        light::Ellipsoid{semi_axes[0], semi_axes[1], semi_axes[2]}, mass);
    put(moments, Body(I.x, I.y, I.z).moments());
  });
}

void polhode_semi_axes(const double* moments, double mass, double* semi_axes) {
  const light::Ellipsoid e = light::homogeneous_ellipsoid(vector(moments), mass);
  put(semi_axes, Vec3{e.a, e.b, e.c});
}

int polhode_state_of_rate(const double* moments, const double* q, const double* omega,
                          int is_inertial, double* result) {
  return guarded([&] {
    const Body of = body(moments);
    const Quaternion attitude = unit_quaternion(q[0], q[1], q[2], q[3]);
    put(result, is_inertial != 0 ? rotor_state_inertial(of, attitude, vector(omega))
                                 : rotor_state(of, attitude, vector(omega)));
  });
}

int polhode_checked_state(const double* numbers, double* result) {
  return guarded([&] {
    const RotorState typed = state(numbers);
    const Quaternion& q = typed.q;
    // the motion looks at the momentum, of any body
    FreeRotation(Body(1.0, 1.0, 1.0), typed);
    put(result, RotorState{unit_quaternion(q.w, q.x, q.y, q.z), typed.g});
  });
}

void polhode_derived(const double* moments, const double* x, double* derived) {
  const Body of = body(moments);
  const RotorState s = state(x);
  double* to = put(derived, angular_velocity(of, s));
  to = put(to, inertial_angular_velocity(of, s));
  to = put(to, inertial_momentum(s));
  *to = kinetic_energy(of, s);
}

int polhode_momentum_along(const double* x, const double* direction, double* result) {
  return guarded([&] {
    const RotorState s = state(x);
    const Vec3 d = vector(direction);
    const double G = norm(s.g), length = norm(d);
    if (!(length > 0.0) || !std::isfinite(length))
      throw DomainError("a direction of the momentum must be finite and not zero");
    if (!(G > 0.0)) throw DomainError("a body at rest has no momentum to turn");
    const Vec3 from = (1.0 / length) * d, to = (1.0 / G) * s.g;
    put(result, RotorState{normalized(normalized(s.q) * least_turn(from, to)), G * from});
  });
}
