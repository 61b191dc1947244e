// SPDX-License-Identifier: MIT
#include "output/detail/column_table.hpp"

#include "polhode/free/sadov.hpp"
#include "polhode/free/serret.hpp"
#include "polhode/rotor/andoyer.hpp"
#include "polhode/rotor/euler.hpp"
#include "polhode/system/axes.hpp"
#include "polhode/system/osculation.hpp"
#include "tables/sadov_region.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

using enum Dimension;

Numbers numbers_of(const Vec3& v) { return {v.x, v.y, v.z}; }
Numbers numbers_of(const Quaternion& q) { return {q.w, q.x, q.y, q.z}; }
Numbers numbers_of(const EulerState& e) { return {e.phi, e.theta, e.psi, e.Phi, e.Theta, e.Psi}; }
Numbers numbers_of(const AndoyerState& a) { return {a.l, a.g, a.h, a.L, a.G, a.H}; }
Numbers numbers_of(const RotorAxes& a) {
  return {a.figure.I, a.figure.h, a.momentum.I, a.momentum.h, a.rotation.I, a.rotation.h};
}

// Principal axes B to the axes F of the body's tensor; the identity without one.
Vec3 in_body_axes(const RowSample& s, const Vec3& v_B) {
  return rotate(s.system.body().q_FB(), v_B);
}
Quaternion of_body_axes(const RowSample& s, const Quaternion& q) {
  return q * conj(s.system.body().q_FB());
}

Numbers attitude_numbers(const RowSample& s) { return numbers_of(of_body_axes(s, s.state.q)); }
Numbers inertial_attitude_numbers(const RowSample& s) {
  return numbers_of(of_body_axes(s, inertial_state(s.system, s.t, s.state).q));
}
Numbers omega_numbers(const RowSample& s) {
  return numbers_of(in_body_axes(s, angular_velocity(s.system, s.t, s.state).inertial));
}
Numbers inertial_omega_numbers(const RowSample& s) {
  const Quaternion q = normalized(inertial_state(s.system, s.t, s.state).q);
  return numbers_of(rotate(q, angular_velocity(s.system, s.t, s.state).inertial));
}
Numbers relative_omega_numbers(const RowSample& s) {
  return numbers_of(in_body_axes(s, angular_velocity(s.system, s.t, s.state).relative));
}
Numbers convective_numbers(const RowSample& s) {
  return numbers_of(in_body_axes(s, effect(s.system, s.t, s.state).v));
}
Numbers damper_numbers(const RowSample& s) { return numbers_of(in_body_axes(s, s.damper_rate)); }
Numbers momentum_numbers(const RowSample& s) { return numbers_of(in_body_axes(s, s.state.g)); }
Numbers euler_numbers(const RowSample& s) { return numbers_of(to_euler(s.state)); }
Numbers andoyer_numbers(const RowSample& s) { return numbers_of(to_andoyer(s.state)); }
Numbers osculating_euler_numbers(const RowSample& s) {
  return numbers_of(to_euler(osculating_state(s.system, s.t, s.state)));
}
Numbers osculating_andoyer_numbers(const RowSample& s) {
  return numbers_of(osculating_andoyer(s.system, s.t, s.state));
}
Numbers axes_numbers(const RowSample& s) {
  return numbers_of(inertial_axes(s.system, s.t, s.state));
}
Numbers relative_axes_numbers(const RowSample& s) {
  return numbers_of(relative_axes(s.system, s.t, s.state));
}
Numbers energy_numbers(const RowSample& s) {
  const double E = polhode::energy(s.system, s.t, s.state);
  return {E, E - s.initial_energy};
}

SadovState sadov_elements(const RowSample& s) {
  if (s.motion != nullptr) return to_sadov(*s.motion, s.t);
  return to_sadov(FreeRotation(s.system.body(), s.state, s.t), s.t);
}
Numbers sadov_numbers(const RowSample& s) {
  const SadovState a = sadov_elements(s);
  return {a.phi_l, a.phi_g, a.phi_h, a.I_l, a.I_g, a.I_h, lobe_column(a)};
}
Numbers serret_numbers(const RowSample& s) {
  const SerretState a = s.elements != nullptr
                            ? *s.elements
                            : to_serret(FreeRotation(s.system.body(), s.state, s.t), s.t);
  return {a.g0,
          a.t0,
          a.T,
          a.h,
          a.G,
          a.H,
          static_cast<double>(a.sign_g1),
          static_cast<double>(a.sign_g3)};
}

constexpr GroupSpec specs[] = {
    {"q", {{{"qw"}, {"qx"}, {"qy"}, {"qz"}}}, attitude_numbers},
    {"omega", {{{"w1", rate}, {"w2", rate}, {"w3", rate}}}, omega_numbers},
    {"omega_inertial", {{{"W1", rate}, {"W2", rate}, {"W3", rate}}}, inertial_omega_numbers},
    {"g", {{{"g1", momentum}, {"g2", momentum}, {"g3", momentum}}}, momentum_numbers},
    {"euler",
     {{{"phi", angle},
       {"theta", angle},
       {"psi", angle},
       {"Phi", momentum},
       {"Theta", momentum},
       {"Psi", momentum}}},
     euler_numbers},
    {"andoyer",
     {{{"l", angle},
       {"g", angle},
       {"h", angle},
       {"L", momentum},
       {"G", momentum},
       {"H", momentum}}},
     andoyer_numbers},
    {"sadov",
     {{{"phi_l", angle},
       {"phi_g", angle},
       {"phi_h", angle},
       {"I_l", momentum},
       {"I_g", momentum},
       {"I_h", momentum},
       {"lobe", Dimension::number, true}}},
     sadov_numbers},
    {"serret",
     {{{"g0", angle},
       {"t0", time},
       {"T", Dimension::energy},
       {"h", angle},
       {"G", momentum},
       {"H", momentum},
       {"sign_g1", Dimension::number, true},
       {"sign_g3", Dimension::number, true}}},
     serret_numbers},
    {"q_inertial", {{{"Qw"}, {"Qx"}, {"Qy"}, {"Qz"}}}, inertial_attitude_numbers},
    {"omega_rel", {{{"w1_rel", rate}, {"w2_rel", rate}, {"w3_rel", rate}}}, relative_omega_numbers},
    {"convective", {{{"v1", rate}, {"v2", rate}, {"v3", rate}}}, convective_numbers},
    {"andoyer_osc",
     {{{"l_osc", angle},
       {"g_osc", angle},
       {"h_osc", angle},
       {"L_osc", momentum},
       {"G_osc", momentum},
       {"H_osc", momentum}}},
     osculating_andoyer_numbers},
    {"euler_osc",
     {{{"phi_osc", angle},
       {"theta_osc", angle},
       {"psi_osc", angle},
       {"Phi_osc", momentum},
       {"Theta_osc", momentum},
       {"Psi_osc", momentum}}},
     osculating_euler_numbers},
    {"axes",
     {{{"I_f", angle},
       {"h_f", angle},
       {"I_m", angle},
       {"h_m", angle},
       {"I_r", angle},
       {"h_r", angle}}},
     axes_numbers},
    {"axes_rel",
     {{{"I_f_rel", angle},
       {"h_f_rel", angle},
       {"I_m_rel", angle},
       {"h_m_rel", angle},
       {"I_r_rel", angle},
       {"h_r_rel", angle}}},
     relative_axes_numbers},
    {"damper", {{{"s1", rate}, {"s2", rate}, {"s3", rate}}}, damper_numbers},
    {"energy", {{{"E", Dimension::energy}, {"dE", Dimension::energy}}}, energy_numbers},
};

}  // namespace

std::span<const GroupSpec> column_table() { return specs; }

}  // namespace detail
}  // namespace v0
}  // namespace polhode
