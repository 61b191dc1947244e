// SPDX-License-Identifier: MIT
// From the chart of a scenario to the hub, and the system that moves it.
#include "polhode/rotor/attitude.hpp"
#include "polhode/scenario/scenario.hpp"
#include "scenario/scenario_parts.hpp"

namespace polhode {
inline namespace v0 {
namespace {

// One overload per chart.
struct ToMotion {
  const Body& body;
  const Quaternion& q_file;
  FrameMotion frame;        // at t = 0
  Vec3 momentum_of_damper;  // in addition to I w, body axes

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
    if (s.given == AttitudeRate::Given::momentum_body)
      return {unit_quaternion(q.w, q.x, q.y, q.z), along_B};
    return with_damper(s.given == AttitudeRate::Given::omega_inertial
                           ? rotor_state_inertial(body, q, rotate(conj(frame.q_IS), s.vector))
                       : s.given == AttitudeRate::Given::omega_body
                           ? rotor_state(body, q, along_B)
                           : rotor_state(body, q, along_B + rotate(conj(q), frame.mu_S)));
  }
  // g = I w + J s
  RotorState with_damper(RotorState s) const {
    if (momentum_of_damper != Vec3{}) s.g = s.g + momentum_of_damper;
    return s;
  }
};

}  // namespace

System rotor_system(const Scenario& scenario) {
  return System(scenario.body, scenario.frame, scenario.terms, scenario.damper);
}

FreeRotation free_rotation(const Scenario& scenario) {
  const double J = scenario.damper ? scenario.damper->moment() : 0.0;
  return std::visit(
      ToMotion{scenario.body, scenario.q_file, scenario.frame.at(0.0), J * scenario.damper_rate},
      scenario.state);
}

// Serret's elements have their own epoch; what others give is the state itself.
RotorState initial_state(const Scenario& scenario) {
  const FreeRotation motion = free_rotation(scenario);
  return motion.epoch() == 0.0 ? motion.initial_state() : motion.at(0.0);
}

double detail::initial_energy(const Scenario& scenario) {
  const System system = rotor_system(scenario);
  if (!system.has_energy()) return 0.0;
  return energy(at_damper_rate(system, scenario.damper_rate), 0.0, initial_state(scenario));
}

std::optional<Method> propagation_method(const Scenario& scenario) {
  if (scenario.method) return scenario.method;
  if (scenario.terms.empty() && !scenario.damper) return std::nullopt;
  return Adaptive{};
}

}  // namespace v0
}  // namespace polhode
