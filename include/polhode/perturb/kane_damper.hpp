// SPDX-License-Identifier: MIT
// KaneDamper: a sphere in a cavity of the body, held by friction alone. It has a state of its own,
// its rate relative to the body: a System owns it, and it is no term.
//
// Equations   I are the moments of body and sphere together, J that of the sphere, s its rate
//             relative to the body; g is all of the momentum. Of g the body and the sphere have
//             (I - J) w0 and J (w0 + s), hence w0 = I^-1 (g - J s), which is v = -J I^-1 s; the
//             friction turns the sphere by -c s: (1 - J/I) ds/dt = s x w0 - (c/J) s - I^-1 dg/dt,
//             whatever dg/dt is. The kinetic energy is (1/2) g.I^-1 g + (1/2) J s.(1 - J/I) s; it
//             falls by c |s|^2. Where c/J is large, s = -(J/c) I^-1 dg/dt: InternalDamping with
//             k = J^2/c I^-2. After Kane and Barba (1966).
// Units       J as the moments of the body, c a torque per rate, s rad per time.
// Domain      J > 0, c >= 0, and what is left of the body without the sphere must be a body:
//             I1 + I2 - I3 >= J of its largest moment. The v of a term turns body and sphere alike,
//             so that the energy of Hamiltonian terms is kept with them; terms that ask for a rate
//             (friction outside, eddy currents) take I^-1 g, the mean one.
// Accuracy    a few roundings; of I - J where the sphere is nearly all of the body.
// Errors      DomainError for a moment that is not positive or a friction that is negative, and
//             from System for a body that cannot hold the sphere.
// Cost        some 40 flops an evaluation. Adaptive takes steps below about 3 J/c: where the
//             rotation is much slower than c/J, take InternalDamping.
#pragma once

#include "polhode/rotor/body.hpp"

namespace polhode {
inline namespace v0 {

class KaneDamper {
 public:
  KaneDamper(double moment, double friction);

  double moment() const { return moment_; }      // J
  double friction() const { return friction_; }  // c
  constexpr bool operator==(const KaneDamper&) const = default;

  // What body and sphere turn with in addition to I^-1 g, at the relative rate s: v.
  Vec3 rate_of_body(const Body& body, const Vec3& s) const;
  // ds/dt at the momentum g, of which the rate in body axes is dg.
  Vec3 acceleration(const Body& body, const Vec3& g, const Vec3& dg, const Vec3& s) const;
  // The kinetic energy in addition to (1/2) g.I^-1 g.
  double energy(const Body& body, const Vec3& s) const;
  // Momentum of the sphere about its centre, in body axes; and the relative rate that has it.
  Vec3 momentum(const Body& body, const Vec3& g, const Vec3& s) const;
  Vec3 relative_rate(const Body& body, const Vec3& g, const Vec3& momentum) const;

  // DomainError where the body has no room for it.
  void require_room(const Body& body) const;

 private:
  double moment_;
  double friction_;
};

}  // namespace v0
}  // namespace polhode
