// SPDX-License-Identifier: MIT
// 3-1-3 Euler angles with their canonical momenta (phi, theta, psi, Phi, Theta, Psi), and with
// their rates.
//
// Equations   R [SA (2)]; rates and angular velocity [SA (5)-(7)]; g_B = (A spsi + Theta cpsi,
//             A cpsi - Theta spsi, Psi) with A = (Phi - Psi ctheta)/stheta [SA (25)-(27)]. The
//             momenta are those of the body alone: Phi = G . s3, Theta = G . node, Psi = G . b3.
// Corrections [SA (17)]: phid c_psi s_theta, not c_phi. [SA (28)] is not used: G_I = R^T g.
// Units       angles in radians; momenta in those of the angular momentum; rates in rad per time.
// Domain      any theta as input; theta in [0, pi] and phi, psi in (-pi, pi] as output.
//             theta = 0 or pi: only phi + psi or phi - psi means something. The node is then put
//             along the transverse momentum (for the rates: the transverse angular velocity), so
//             that A = 0 and to_rotor gives the state back; where that vanishes too, psi = 0. The
//             rate about the common axis is in phi_dot.
//             theta = 0 with Phi != Psi is no state: to_rotor answers an infinite momentum.
//             euler_state throws there, and at the double nearest to pi with Phi != -Psi.
// Accuracy    docs/guide/singularities.md. Phi - Psi cancels near theta = 0 and pi, and theta
//             itself is rounded next to pi: the transverse momentum keeps an error of about
//             eps |g| / sin theta, at most its own size.
// Errors      to_rotor, to_euler, to_euler_rates never throw, NaN in, NaN out; euler_state throws
//             DomainError.
// Cost        three sincos forth; three atan2 back.
#pragma once

#include <cmath>
#include <limits>

#include "polhode/rotor/attitude.hpp"
#include "polhode/rotor/body.hpp"
#include "polhode/rotor/detail/euler_frame.hpp"
#include "polhode/rotor/rotor_state.hpp"

namespace polhode {
inline namespace v0 {

template <Number T>
struct BasicEulerState {
  T phi;
  T theta;
  T psi;
  T Phi;
  T Theta;
  T Psi;

  bool operator==(const BasicEulerState&) const
    requires Real<T>
  = default;
};
using EulerState = BasicEulerState<double>;

// Not canonical, and not body-free.
template <Number T>
struct BasicEulerRates {
  T phi;
  T theta;
  T psi;
  T phi_dot;
  T theta_dot;
  T psi_dot;

  bool operator==(const BasicEulerRates&) const
    requires Real<T>
  = default;
};
using EulerRates = BasicEulerRates<double>;

// Checked values: finite; at theta = 0 and pi the momenta must agree.
EulerState euler_state(double phi, double theta, double psi, double Phi, double Theta, double Psi);

// [SA (25)-(27)]
template <Number T>
BasicRotorState<T> to_rotor(const BasicEulerState<T>& e) {
  using detail::phasor;
  return detail::rotor_of_euler(
      detail::EulerPhasors<T>{phasor(T(T(0.5) * e.phi)), phasor(T(T(0.5) * e.theta)),
                              phasor(T(T(0.5) * e.psi)), e.Phi, e.Theta, e.Psi});
}

// Angles, and the momentum on the axes of their rotations [SA (33)-(35), (72), (76), "Theta",
// (78)-(80)].
template <Number T = double>
BasicEulerState<T> to_euler(const BasicRotorState<T>& state) {
  using std::atan2;
  const detail::EulerPhasors<T> p = detail::euler_phasors(state);
  return {detail::argument(p.phi),
          T(2.0) * T(atan2(p.half_theta.im, p.half_theta.re)),
          detail::argument(p.psi),
          p.Phi,
          p.Theta,
          p.Psi};
}

// [SA (5)-(7), (16)-(18)]
template <Number T>
BasicRotorState<T> to_rotor(const Body& body, const BasicEulerRates<T>& e) {
  using std::cos;
  using std::sin;
  const detail::Phasor<T> psi = detail::phasor(e.psi);
  const BasicVec3<T> w = detail::node_to_body(T(e.phi_dot * T(sin(e.theta))), e.theta_dot,
                                              T(e.psi_dot + e.phi_dot * T(cos(e.theta))), psi);
  const Vec3& I = body.moments();
  return {attitude(BasicEulerAngles<T>{e.phi, e.theta, e.psi}),
          {T(I.x) * w.x, T(I.y) * w.y, T(I.z) * w.z}};
}

// [SA (5)-(7), (19)-(21)]
template <Number T = double>
BasicEulerRates<T> to_euler_rates(const Body& body, const BasicRotorState<T>& state) {
  using std::abs;
  using std::atan2;
  using std::cos;
  using std::sin;
  const Vec3& I = body.moments();
  const BasicVec3<T> w{state.g.x / T(I.x), state.g.y / T(I.y), state.g.z / T(I.z)};
  const detail::EulerFrame<T> f = detail::euler_frame(state.q, w);
  const T phi = detail::argument(f.phi), theta = T(2.0) * T(atan2(f.s, f.c));
  const T psi = detail::argument(f.psi);
  const T along = w.x * f.psi.re - w.y * f.psi.im;
  // of theta as rounded, not 2 s c: near pi they differ, and phi_dot stheta must come back
  const T zero(0.0);
  const T sine = select(f.s == zero || f.c == zero, zero, T(sin(theta)));
  const T phi_dot = (w.x * f.psi.im + w.y * f.psi.re) / select(sine == zero, T(1.0), sine);
  const auto at_pole = sine == zero || T(std::numeric_limits<double>::max()) < T(abs(phi_dot));
  const T about_axis = select(f.s < f.c, w.z, T(-w.z));
  return {phi,   theta,
          psi,   select(at_pole, about_axis, phi_dot),
          along, select(at_pole, zero, T(w.z - phi_dot * T(cos(theta))))};
}

extern template RotorState to_rotor(const EulerState&);
extern template EulerState to_euler(const RotorState&);
extern template RotorState to_rotor(const Body&, const EulerRates&);
extern template EulerRates to_euler_rates(const Body&, const RotorState&);

}  // namespace v0
}  // namespace polhode
