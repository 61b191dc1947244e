// SPDX-License-Identifier: MIT
#include "polhode/system/system.hpp"

#include <algorithm>
#include <utility>

namespace polhode {
inline namespace v0 {
namespace {

Setting setting(const System& system, double t, const RotorState& s, const FrameMotion& frame) {
  return {system.body(), t, {normalized(s.q), s.g}, frame.q_IS};
}

}  // namespace

System::System(const Body& body, Frame frame, std::vector<AnyPerturbation> terms)
    : body_(body), frame_(std::move(frame)), terms_(std::move(terms)) {}

bool System::is_hamiltonian() const {
  return std::all_of(terms_.begin(), terms_.end(),
                     [](const AnyPerturbation& term) { return term.supports_energy(); });
}

Effect effect(const System& system, double t, const RotorState& s) {
  const FrameMotion frame = system.frame().at(t);
  const Setting at = setting(system, t, s, frame);
  const Effect terms = terms_effect(system, at);
  const Vec3 mu = body_from_reference(at, frame.mu_S);
  return terms + Effect{-mu, cross(s.g, mu)};
}

AngularVelocities angular_velocity(const System& system, double t, const RotorState& s) {
  const FrameMotion frame = system.frame().at(t);
  const Setting at = setting(system, t, s, frame);
  const Vec3 w = angular_velocity(system.body(), s) + terms_effect(system, at).v;
  return {w, w - body_from_reference(at, frame.mu_S)};
}

double energy(const System& system, double t, const RotorState& s) {
  const FrameMotion frame = system.frame().at(t);
  const Setting at = setting(system, t, s, frame);
  double sum = kinetic_energy(system.body(), s) - dot(frame.mu_S, rotate(at.s.q, s.g));
  for (const AnyPerturbation& term : system.terms()) sum += term.energy(at);
  return sum;
}

RotorState inertial_state(const System& system, double t, const RotorState& s) {
  return {system.frame().at(t).q_IS * s.q, s.g};
}

RotorState reference_state(const System& system, double t, const RotorState& s_I) {
  return {conj(system.frame().at(t).q_IS) * s_I.q, s_I.g};
}

}  // namespace v0
}  // namespace polhode
