// SPDX-License-Identifier: MIT
// System: a body, a reference frame and perturbation terms; the equations of motion of the hub
// state (q_SB, g_B), and which angular velocity is which.
//
// Equations   dq/dt = (1/2) q (0, w_SB), dg/dt = g x w_SB + u, w_SB = I^-1 g + v, u and v summed
//             over the terms and the frame. A moving frame is the term -mu . g of [SA (118)]: v =
//             -mu, u = g x mu (mu in body components); the system adds it by itself. Hence
//             [SA (124)]: I^-1 g + v(terms) is the inertial angular velocity; relative to S it is
//             less by mu.
// Corrections [SA (4448)]: the sign of the convective part, docs/theory/errata.md.
// Units       those of the body and its terms; any consistent set.
// Domain      any state with a non-zero quaternion; functions of a state normalise it.
// Accuracy    a few roundings. The two parts of the frame's term that cancel in dg/dt are not
//             formed.
// Errors      energy throws DomainError when a term has none. What a term throws passes through.
// Cost        ten nanoseconds and the terms.
#pragma once

#include <vector>

#include "polhode/frame/frame.hpp"
#include "polhode/perturb/any_perturbation.hpp"

namespace polhode {
inline namespace v0 {

class System {
 public:
  explicit System(const Body& body, Frame frame = Frame::inertial(),
                  std::vector<AnyPerturbation> terms = {});

  const Body& body() const { return body_; }
  const Frame& frame() const { return frame_; }
  const std::vector<AnyPerturbation>& terms() const { return terms_; }
  // Whether every term has an energy.
  bool is_hamiltonian() const;

 private:
  Body body_;
  Frame frame_;
  std::vector<AnyPerturbation> terms_;
};

// The angular velocity of the body in body components, twice.
template <Real T>
struct BasicAngularVelocities {
  BasicVec3<T> inertial;  // w_IB: of the body with respect to inertial axes
  BasicVec3<T> relative;  // w_SB: with respect to the reference frame
};
using AngularVelocities = BasicAngularVelocities<double>;

template <Real T>
struct BasicRotorRates {
  BasicQuaternion<T> q;  // dq_SB/dt
  BasicVec3<T> g;        // dg_B/dt
};
using RotorRates = BasicRotorRates<double>;

// The sum of the terms' effects, without the frame's own. T = double, DoubleDouble or Tangent.
template <Real T>
BasicEffect<T> terms_effect(const System& system, const BasicSetting<T>& at) {
  BasicEffect<T> sum;
  for (const AnyPerturbation& term : system.terms()) sum = sum + term.effect(at);
  return sum;
}

// The equations of motion. |q| = 1 is expected to rounding: q is not normalised here.
template <Real T>
BasicRotorRates<T> rotor_rates(const System& system, const T& t, const BasicRotorState<T>& s) {
  const BasicFrameMotion<T> frame = system.frame().at(t);
  const BasicEffect<T> e = terms_effect(system, BasicSetting<T>{system.body(), t, s, frame.q_IS});
  const Vec3& I = system.body().moments();
  const BasicVec3<T> w{s.g.x / T(I.x) + e.v.x, s.g.y / T(I.y) + e.v.y, s.g.z / T(I.z) + e.v.z};
  // not g x (w - mu) + g x mu: cancels
  const BasicVec3<T> g_rate = cross(s.g, w) + e.u;
  const T half(0.5), zero(0.0);
  BasicQuaternion<T> q_rate = s.q * BasicQuaternion<T>{zero, half * w.x, half * w.y, half * w.z};
  if (!system.frame().is_inertial()) {
    const BasicVec3<T>& mu = frame.mu_S;
    const BasicQuaternion<T> lag =
        BasicQuaternion<T>{zero, half * mu.x, half * mu.y, half * mu.z} * s.q;
    q_rate = {q_rate.w - lag.w, q_rate.x - lag.x, q_rate.y - lag.y, q_rate.z - lag.z};
  }
  return {q_rate, g_rate};
}

// The sum of all effects, the frame's own included: v is the convective term of the paper as a
// vector.
Effect effect(const System& system, double t, const RotorState& s);

// Both angular velocities of a state.
AngularVelocities angular_velocity(const System& system, double t, const RotorState& s);

// The Hamiltonian of the motion in S: kinetic energy, the terms' energies, and -mu . g. Constant if
// nothing depends on time.
double energy(const System& system, double t, const RotorState& s);

// The same state described in inertial axes, and back.
RotorState inertial_state(const System& system, double t, const RotorState& s);
RotorState reference_state(const System& system, double t, const RotorState& s_I);

}  // namespace v0
}  // namespace polhode
