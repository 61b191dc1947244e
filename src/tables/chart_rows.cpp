// SPDX-License-Identifier: MIT
#include "tables/detail/chart_rows.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "polhode/error.hpp"
#include "polhode/free/free_rotation.hpp"
#include "polhode/free/sadov.hpp"
#include "polhode/free/serret.hpp"
#include "polhode/rotor/andoyer.hpp"
#include "polhode/rotor/attitude.hpp"
#include "polhode/rotor/euler.hpp"
#include "polhode/rotor/poincare.hpp"
#include "tables/sadov_region.hpp"
#include "text/nearest.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

using Row = ChartRow;
using Context = ChartContext;

Quaternion attitude_in(const Row& x) { return unit_quaternion(x[0], x[1], x[2], x[3]); }
Row attitude_row(const Quaternion& q, const Vec3& v) { return {q.w, q.x, q.y, q.z, v.x, v.y, v.z}; }

RotorState from_rotor(const Row& x, const Context&) { return {attitude_in(x), {x[4], x[5], x[6]}}; }
Row to_rotor_row(const RotorState& s, const Context&) { return attitude_row(s.q, s.g); }

RotorState from_rate(const Row& x, const Context& o) {
  return rotor_state(*o.body, attitude_in(x), {x[4], x[5], x[6]});
}
Row to_rate(const RotorState& s, const Context& o) {
  return attitude_row(s.q, angular_velocity(*o.body, s));
}

RotorState from_inertial_rate(const Row& x, const Context& o) {
  return rotor_state_inertial(*o.body, attitude_in(x), {x[4], x[5], x[6]});
}
Row to_inertial_rate(const RotorState& s, const Context& o) {
  return attitude_row(s.q, inertial_angular_velocity(*o.body, s));
}

RotorState from_matrix(const Row& x, const Context&) {
  const Mat3 R{{{x[0], x[1], x[2]}, {x[3], x[4], x[5]}, {x[6], x[7], x[8]}}};
  return {attitude(R), {x[9], x[10], x[11]}};
}
Row to_matrix(const RotorState& s, const Context&) {
  const Mat3 R = attitude_matrix(s.q);
  return {R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2),
          R(2, 0), R(2, 1), R(2, 2), s.g.x,   s.g.y,   s.g.z};
}

RotorState from_euler(const Row& x, const Context&) {
  return to_rotor(euler_state(x[0], x[1], x[2], x[3], x[4], x[5]));
}
Row to_euler_row(const RotorState& s, const Context&) {
  const EulerState e = to_euler(s);
  return {e.phi, e.theta, e.psi, e.Phi, e.Theta, e.Psi};
}

RotorState from_euler_rates(const Row& x, const Context& o) {
  return to_rotor(*o.body, EulerRates{x[0], x[1], x[2], x[3], x[4], x[5]});
}
Row to_euler_rates_row(const RotorState& s, const Context& o) {
  const EulerRates e = to_euler_rates(*o.body, s);
  return {e.phi, e.theta, e.psi, e.phi_dot, e.theta_dot, e.psi_dot};
}

RotorState from_andoyer(const Row& x, const Context&) {
  return to_rotor(andoyer_state(x[0], x[1], x[2], x[3], x[4], x[5]));
}
Row to_andoyer_row(const RotorState& s, const Context&) {
  const AndoyerState a = to_andoyer(s);
  return {a.l, a.g, a.h, a.L, a.G, a.H};
}

template <Pole J, Pole I>
RotorState from_poincare(const Row& x, const Context&) {
  return to_rotor(poincare_state(x[0], x[1], x[2], x[3], x[4], x[5], J, I));
}
template <Pole J, Pole I>
Row to_poincare_row(const RotorState& s, const Context&) {
  const PoincareState p = to_poincare(s, J, I);
  return {p.sigma, p.Q1, p.Q2, p.G, p.P1, p.P2};
}

// A column of signs; a NaN stands for one that the table does not have.
int sign_of(double x, int missing) {
  if (std::isnan(x)) return missing;
  if (x != 1.0 && x != -1.0) throw DomainError("a column of signs must hold 1 or -1");
  return x > 0.0 ? 1 : -1;
}

RotorState from_serret(const Row& x, const Context& o) {
  const SerretState e{x[0], x[1], x[2], x[3], x[4], x[5], sign_of(x[6], 1), sign_of(x[7], 1)};
  return to_rotor(*o.body, e, o.t);
}
Row to_serret_row(const RotorState& s, const Context& o) {
  const SerretState e = to_serret(FreeRotation(*o.body, s, o.t), o.t);
  return {e.g0,
          e.h,
          e.t0,
          e.G,
          e.H,
          e.T,
          static_cast<double>(e.sign_g1),
          static_cast<double>(e.sign_g3)};
}

// The column lobe is 0 in the short-axis region.
RotorState from_sadov(const Row& x, const Context& o) {
  SadovState a{x[0], x[1], x[2], x[3], x[4], x[5]};
  const bool is_given = !std::isnan(x[6]);
  a.region = is_given ? (x[6] == 0.0 ? SadovRegion::short_axis : SadovRegion::long_axis)
                      : sadov_region(*o.body, a.I_l, a.I_g);
  if (x[6] != 0.0) a.lobe = sign_of(x[6], 1);
  return to_rotor(*o.body, a);
}
Row to_sadov_row(const RotorState& s, const Context& o) {
  const SadovState a = to_sadov(FreeRotation::short_arc(*o.body, s, o.t), o.t);
  return {a.phi_l, a.phi_g, a.phi_h, a.I_l, a.I_g, a.I_h, lobe_column(a)};
}

constexpr std::string_view poincare_columns = "sigma,Q1,Q2,G,P1,P2";

constexpr ChartMaps maps[] = {
    {{"rotor", "qw,qx,qy,qz,g1,g2,g3", "", false, "attitude quaternion and body angular momentum"},
     from_rotor,
     to_rotor_row},
    {{"attitude-rate", "qw,qx,qy,qz,w1,w2,w3", "", true,
      "attitude quaternion and angular velocity, body components"},
     from_rate,
     to_rate},
    {{"attitude-rate-inertial", "qw,qx,qy,qz,W1,W2,W3", "", true,
      "attitude quaternion and angular velocity, inertial components"},
     from_inertial_rate,
     to_inertial_rate},
    {{"matrix", "R11,R12,R13,R21,R22,R23,R31,R32,R33,g1,g2,g3", "", false,
      "rotation matrix, inertial to body, and body angular momentum"},
     from_matrix,
     to_matrix},
    {{"euler", "phi,theta,psi,Phi,Theta,Psi", "", false, "3-1-3 Euler angles and their momenta"},
     from_euler,
     to_euler_row},
    {{"euler-rates", "phi,theta,psi,phi_dot,theta_dot,psi_dot", "", true,
      "3-1-3 Euler angles and their rates"},
     from_euler_rates,
     to_euler_rates_row},
    {{"andoyer", "l,g,h,L,G,H", "", false, "Andoyer variables"}, from_andoyer, to_andoyer_row},
    {{"poincare-0-0", poincare_columns, "", false, "Poincare-type set for J near 0, I near 0"},
     from_poincare<Pole::zero, Pole::zero>,
     to_poincare_row<Pole::zero, Pole::zero>},
    {{"poincare-0-pi", poincare_columns, "", false, "Poincare-type set for J near 0, I near pi"},
     from_poincare<Pole::zero, Pole::pi>,
     to_poincare_row<Pole::zero, Pole::pi>},
    {{"poincare-pi-0", poincare_columns, "", false, "Poincare-type set for J near pi, I near 0"},
     from_poincare<Pole::pi, Pole::zero>,
     to_poincare_row<Pole::pi, Pole::zero>},
    {{"poincare-pi-pi", poincare_columns, "", false, "Poincare-type set for J near pi, I near pi"},
     from_poincare<Pole::pi, Pole::pi>,
     to_poincare_row<Pole::pi, Pole::pi>},
    {{"serret", "g0,h,t0,G,H,T", "sign_g1,sign_g3", true,
      "Serret's elements at the time of the column t (0 without one)"},
     from_serret,
     to_serret_row},
    {{"sadov", "phi_l,phi_g,phi_h,I_l,I_g,I_h", "lobe", true,
      "Sadov's action-angle variables; lobe is 0 in short-axis mode, else the sign of g1"},
     from_sadov,
     to_sadov_row},
};

}  // namespace

const ChartMaps& chart_maps(const std::string& name, const char* option) {
  std::vector<std::string_view> names;
  for (const ChartMaps& entry : maps) names.push_back(entry.chart.name);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return maps[found - names.begin()];
  const std::string_view near = nearest(name, names);
  std::string message =
      std::string("convert: ") + option + ": unknown chart \"" + name + "\"; expected ";
  for (std::size_t i = 0; i < names.size(); ++i)
    message += (i == 0 ? "" : i + 1 == names.size() ? " or " : ", ") + std::string(names[i]);
  throw DomainError(message + (near.empty() ? "" : "; did you mean " + std::string(near) + "?"));
}

}  // namespace detail

std::span<const TableChart> table_charts() {
  static const std::vector<TableChart> charts = [] {
    std::vector<TableChart> list;
    for (const detail::ChartMaps& entry : detail::maps) list.push_back(entry.chart);
    return list;
  }();
  return charts;
}

}  // namespace v0
}  // namespace polhode
