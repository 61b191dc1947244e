// SPDX-License-Identifier: MIT
// From the chart of a scenario to the hub, and the system that moves it.
#include "polhode/io/scenario.hpp"
#include "polhode/rotor/attitude.hpp"

namespace polhode {
inline namespace v0 {
namespace {

// One overload per chart.
struct ToMotion {
  const Body& body;
  Quaternion q_IS;  // at t = 0

  FreeRotation operator()(const TumblerState& s) const {
    return FreeRotation(body, to_rotor(body, s));
  }
  FreeRotation operator()(const AttitudeRate& s) const {
    const Quaternion& q_FB = body.q_FB();
    const Quaternion q = s.q * q_FB;
    return FreeRotation(body, s.omega_axes == AttitudeRate::Axes::body
                                  ? rotor_state(body, q, rotate(conj(q_FB), s.omega))
                                  : rotor_state_inertial(body, q, rotate(conj(q_IS), s.omega)));
  }
  FreeRotation operator()(const EulerState& s) const { return FreeRotation(body, to_rotor(s)); }
  FreeRotation operator()(const AndoyerState& s) const { return FreeRotation(body, to_rotor(s)); }
  FreeRotation operator()(const SerretState& s) const { return free_rotation(body, s); }
  FreeRotation operator()(const SadovState& s) const {
    return FreeRotation(body, to_rotor(body, s));
  }
};

}  // namespace

System rotor_system(const Scenario& scenario) {
  return System(scenario.body, scenario.frame, scenario.terms);
}

FreeRotation free_rotation(const Scenario& scenario) {
  return std::visit(ToMotion{scenario.body, scenario.frame.at(0.0).q_IS}, scenario.state);
}

// Serret's elements have their own epoch; what others give is the state itself.
RotorState initial_state(const Scenario& scenario) {
  const FreeRotation motion = free_rotation(scenario);
  return motion.epoch() == 0.0 ? motion.initial_state() : motion.at(0.0);
}

std::optional<Method> propagation_method(const Scenario& scenario) {
  if (scenario.method) return scenario.method;
  if (scenario.terms.empty() && scenario.events.empty()) return std::nullopt;
  return Adaptive{};
}

}  // namespace v0
}  // namespace polhode
