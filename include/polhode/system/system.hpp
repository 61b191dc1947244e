// SPDX-License-Identifier: MIT
// In this header: system_state, system.
#pragma once

#include <optional>
#include <vector>

#include "polhode/frame/frame.hpp"
#include "polhode/perturb/any_perturbation.hpp"
#include "polhode/perturb/kane_damper.hpp"
#include "polhode/rotor/rotor_state.hpp"

namespace polhode {
inline namespace v0 {

// SystemState: the state of a System, a rotor and what moves inside it.
//
// Equations   those of System and of KaneDamper: polhode/perturb/kane_damper.hpp.
// Units       those of RotorState; damper_rate in rad per time.
// Domain      damper_rate is relative to the body, in body axes; zero for a system without a
//             damper.
// Cost        ten numbers.

// Every function of a rotor also takes the state of a system.
struct SystemState : RotorState {
  Vec3 damper_rate = {};

  constexpr SystemState() = default;
  // Not explicit: a rotor is the state of a system in which nothing else moves.
  constexpr SystemState(const RotorState& s)  // NOLINT(google-explicit-constructor)
      : RotorState(s) {}
  constexpr SystemState(const Quaternion& q_SB, const Vec3& g_B, const Vec3& rate = {})
      : RotorState{q_SB, g_B}, damper_rate(rate) {}

  friend bool operator==(const SystemState& a, const SystemState& b) = default;
  friend bool operator==(const SystemState& a, const RotorState& b) { return a == SystemState(b); }
};

template <class Visit>
void each_number(SystemState& s, Visit&& visit) {
  each_number(static_cast<RotorState&>(s), visit);
  for (double* x : {&s.damper_rate.x, &s.damper_rate.y, &s.damper_rate.z}) visit(*x);
}

// System: a body, a reference frame, perturbation terms and, where it has one, a damper; the
// equations of motion of the hub state (q_SB, g_B), and which angular velocity is which.
//
// Equations   dq/dt = (1/2) q (0, w_SB), dg/dt = g x w_SB + u, w_SB = I^-1 g + v, u and v summed
//             over the terms and the frame. A moving frame is the term -mu . g of [SA (118)]: v =
//             -mu, u = g x mu (mu in body components); the system adds it by itself. Hence
//             [SA (124)]: I^-1 g + v(terms) is the inertial angular velocity; relative to S it is
//             less by mu. A damper adds its own v, and three equations: kane_damper.hpp.
// Corrections [SA (4448)]: the sign of the convective part, docs/theory/errata.md.
// Units       those of the body and its terms; any consistent set.
// Domain      any state with a non-zero quaternion; functions of a state normalise it. A damper has
//             a state of its own: at_damper_rate gives the system that all functions of a state
//             take.
// Accuracy    a few roundings. The two parts of the frame's term that cancel in dg/dt are not
//             formed.
// Errors      energy throws DomainError when a term has none; functions of a state of a system with
//             a damper, which do not know its rate. What a term throws passes through.
// Cost        ten nanoseconds and the terms.

class System {
 public:
  using State = SystemState;

  explicit System(const Body& body, Frame frame = Frame::inertial(),
                  std::vector<AnyPerturbation> terms = {},
                  const std::optional<KaneDamper>& damper = {});

  const Body& body() const { return body_; }
  const Frame& frame() const { return frame_; }
  const std::vector<AnyPerturbation>& terms() const { return terms_; }
  const std::optional<KaneDamper>& damper() const { return damper_; }
  // Whether every term has an energy.
  bool has_energy() const;
  // The same, and no damper takes it.
  bool is_hamiltonian() const { return has_energy() && !damper_; }

 private:
  Body body_;
  Frame frame_;
  std::vector<AnyPerturbation> terms_;
  std::optional<KaneDamper> damper_;
};

// The system at one relative rate of its damper (body axes): without a damper of its own, and with
// the v and the energy that the damper has at that rate. All functions of a state take it.
System at_damper_rate(const System& system, const Vec3& rate);

// DomainError for a system with a damper, whose rate is not known.
void require_no_damper(const System& system);

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
  if (system.damper()) require_no_damper(system);
  BasicEffect<T> sum;
  for (const AnyPerturbation& term : system.terms()) sum = sum + term.effect(at);
  return sum;
}

// The equations of motion, here and nowhere else. In inertial axes, from the rate w0 = I^-1 g that
// the body has without terms (a damper adds to it) and the sum e of the terms' effects. Written out
// and always inline: it is the inner loop of integrate, and a call of cross costs a tenth of it.
template <Real T>
[[gnu::always_inline]] inline BasicRotorRates<T> inertial_rates(const BasicRotorState<T>& s,
                                                                const BasicVec3<T>& w0,
                                                                const BasicEffect<T>& e) {
  const BasicQuaternion<T>& q = s.q;
  const BasicVec3<T>& g = s.g;
  const BasicVec3<T>& u = e.u;
  const BasicVec3<T> w{w0.x + e.v.x, w0.y + e.v.y, w0.z + e.v.z};
  const BasicVec3<T> h = T(0.5) * w;
  return {{-(q.x * h.x) - q.y * h.y - q.z * h.z, q.w * h.x + q.y * h.z - q.z * h.y,
           q.w * h.y - q.x * h.z + q.z * h.x, q.w * h.z + q.x * h.y - q.y * h.x},
          {(g.y * w.z - g.z * w.y) + u.x, (g.z * w.x - g.x * w.z) + u.y,
           (g.x * w.y - g.y * w.x) + u.z}};
}

// The same relative to a frame of rate mu_S: dq/dt is less by the frame's own turn. dg/dt is not
// touched: not g x (w - mu) + g x mu, which cancels.
template <Real T>
BasicRotorRates<T> relative_rates(const BasicRotorRates<T>& rates, const BasicQuaternion<T>& q,
                                  const BasicVec3<T>& mu_S) {
  const BasicVec3<T> m = T(0.5) * mu_S;
  const BasicQuaternion<T> lag = BasicQuaternion<T>{T(0.0), m.x, m.y, m.z} * q;
  return {{rates.q.w - lag.w, rates.q.x - lag.x, rates.q.y - lag.y, rates.q.z - lag.z}, rates.g};
}

// The rates of one state [SA (3), (12), (14), "firstg1", "firstg2", "firstg3", (A25)-(A30)].
// |q| = 1 is expected to rounding: q is not normalised here. For many of
// them: RotorEquations.
template <Real T>
BasicRotorRates<T> rotor_rates(const System& system, const T& t, const BasicRotorState<T>& s) {
  const BasicFrameMotion<T> frame = system.frame().at(t);
  const BasicEffect<T> e = terms_effect(system, BasicSetting<T>{system.body(), t, s, frame.q_IS});
  const Vec3& I = system.body().moments();
  const BasicVec3<T> w0{s.g.x / T(I.x), s.g.y / T(I.y), s.g.z / T(I.z)};
  const BasicRotorRates<T> rates = inertial_rates(s, w0, e);
  if (system.frame().is_inertial()) return rates;
  return relative_rates(rates, s.q, frame.mu_S);
}

// The sum of all effects, the frame's own included: v is the convective term of the paper as a
// vector [SA (101), (106), (107), (4448)].
Effect effect(const System& system, double t, const RotorState& s);

// Both angular velocities of a state [SA (112)-(115), (123), (124)].
AngularVelocities angular_velocity(const System& system, double t, const RotorState& s);

// The Hamiltonian of the motion in S: kinetic energy, the terms' energies, and -mu . g
// [SA (22), (23), "newhamil", (116)-(118), "(118), in Andoyer's variables"]. Constant if nothing
// depends on time.
double energy(const System& system, double t, const RotorState& s);

// The same state described in inertial axes, and back.
RotorState inertial_state(const System& system, double t, const RotorState& s);
RotorState reference_state(const System& system, double t, const RotorState& s_I);

}  // namespace v0
}  // namespace polhode
