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
  const Quaternion& q_file;
  FrameMotion frame;  // at t = 0

  FreeRotation operator()(const TumblerState& s) const {
    return FreeRotation(body, to_rotor(body, s));
  }
  FreeRotation operator()(const AttitudeRate& s) const { return FreeRotation(body, hub_state(s)); }
  FreeRotation operator()(const EulerState& s) const { return FreeRotation(body, to_rotor(s)); }
  FreeRotation operator()(const AndoyerState& s) const { return FreeRotation(body, to_rotor(s)); }
  FreeRotation operator()(const SerretState& s) const { return free_rotation(body, s); }
  FreeRotation operator()(const SadovState& s) const {
    return FreeRotation(body, to_rotor(body, s));
  }

  RotorState hub_state(const AttitudeRate& s) const {
    // without a tensor the numbers of the file, bit for bit
    const bool principal = q_file == Quaternion{};
    const Quaternion q = principal ? s.q : s.q * q_file;
    const Vec3 along_B = principal ? s.vector : rotate(conj(q_file), s.vector);
    if (s.given == AttitudeRate::Given::omega_inertial)
      return rotor_state_inertial(body, q, rotate(conj(frame.q_IS), s.vector));
    if (s.given == AttitudeRate::Given::omega_body) return rotor_state(body, q, along_B);
    if (s.given == AttitudeRate::Given::omega_relative)
      return rotor_state(body, q, along_B + rotate(conj(q), frame.mu_S));
    return {unit_quaternion(q.w, q.x, q.y, q.z), along_B};
  }
};

}  // namespace

System rotor_system(const Scenario& scenario) {
  return System(scenario.body, scenario.frame, scenario.terms);
}

FreeRotation free_rotation(const Scenario& scenario) {
  return std::visit(ToMotion{scenario.body, scenario.q_file, scenario.frame.at(0.0)},
                    scenario.state);
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
