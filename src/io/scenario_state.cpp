// SPDX-License-Identifier: MIT
// From the chart of a scenario to the hub.
#include "polhode/io/scenario.hpp"
#include "polhode/rotor/attitude.hpp"

namespace polhode {
inline namespace v0 {
namespace {

// One overload per chart.
struct ToMotion {
  const Body& body;

  FreeRotation operator()(const TumblerState& s) const {
    return FreeRotation(body, to_rotor(body, s));
  }
  FreeRotation operator()(const AttitudeRate& s) const {
    const Quaternion& q_FB = body.q_FB();
    const Quaternion q = s.q * q_FB;
    return FreeRotation(body, s.omega_axes == AttitudeRate::Axes::body
                                  ? rotor_state(body, q, rotate(conj(q_FB), s.omega))
                                  : rotor_state_inertial(body, q, s.omega));
  }
  FreeRotation operator()(const EulerState& s) const { return FreeRotation(body, to_rotor(s)); }
  FreeRotation operator()(const AndoyerState& s) const { return FreeRotation(body, to_rotor(s)); }
  FreeRotation operator()(const SerretState& s) const { return free_rotation(body, s); }
  FreeRotation operator()(const SadovState& s) const {
    return FreeRotation(body, to_rotor(body, s));
  }
};

}  // namespace

FreeRotation free_rotation(const Scenario& scenario) {
  return std::visit(ToMotion{scenario.body}, scenario.state);
}

RotorState initial_state(const Scenario& scenario) { return free_rotation(scenario).at(0.0); }

}  // namespace v0
}  // namespace polhode
