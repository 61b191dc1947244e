// SPDX-License-Identifier: MIT
// System: its terms, effects and energy, and the axes that its states and outputs refer to.
#include "polhode/system/system.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {

namespace {

Setting setting(const System& system, double t, const RotorState& s, const FrameMotion& frame) {
  return {system.body(), t, {normalized(s.q), s.g}, frame.q_IS};
}

// What a damper adds to the system at one moment.
struct DamperAtRate {
  Vec3 v;
  double stored;

  template <Real T>
  BasicEffect<T> effect(const BasicSetting<T>&) const {
    return {{T(v.x), T(v.y), T(v.z)}, {}};
  }
  template <Real T>
  T energy(const BasicSetting<T>&) const {
    return T(stored);
  }
};

}  // namespace

System::System(const Body& body, Frame frame, std::vector<AnyPerturbation> terms,
               const std::optional<KaneDamper>& damper)
    : body_(body), frame_(std::move(frame)), terms_(std::move(terms)), damper_(damper) {
  if (damper_) damper_->require_room(body_);
}

System at_damper_rate(const System& system, const Vec3& rate) {
  if (!system.damper()) {
    if (rate == Vec3{}) return system;
    throw DomainError("at_damper_rate: rate " + detail::tuple_text({rate.x, rate.y, rate.z}) +
                      " must be zero for a system without a damper");
  }
  std::vector<AnyPerturbation> terms = system.terms();
  terms.emplace_back("Kane damper", DamperAtRate{system.damper()->rate_of_body(system.body(), rate),
                                                 system.damper()->energy(system.body(), rate)});
  return System(system.body(), system.frame(), std::move(terms));
}

void require_no_damper(const System& system) {
  if (!system.damper()) return;
  throw DomainError(
      "a system with a Kane damper has no angular velocity without the rate of the damper: take "
      "at_damper_rate(system, rate)");
}

bool System::has_energy() const {
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
  require_no_damper(system);
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
