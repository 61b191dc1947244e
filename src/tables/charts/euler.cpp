// SPDX-License-Identifier: MIT
#include "polhode/rotor/euler.hpp"

#include "tables/detail/chart_families.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

constexpr ChartVariable phi{"phi", Dimension::angle, "First angle, about inertial axis 3.", "10"};
constexpr ChartVariable psi{"psi", Dimension::angle, "Third angle, about body axis 3.", "30"};

constexpr ChartVariable with_momenta[] = {
    phi,
    {"theta", Dimension::angle,
     "Second angle, about the line of nodes; not 0 or 180 deg, where the momenta end.", "60"},
    psi,
    {"Phi", Dimension::momentum, "Momentum of phi: the angular momentum along inertial axis 3.",
     "0.8"},
    {"Theta", Dimension::momentum,
     "Momentum of theta: the angular momentum along the line of nodes.", "0.1"},
    {"Psi", Dimension::momentum, "Momentum of psi: the angular momentum along body axis 3.", "0.9"},
};
constexpr ChartVariable with_rates[] = {
    phi,
    {"theta", Dimension::angle, "Second angle, about the line of nodes.", "60"},
    psi,
    {"phi_dot", Dimension::rate, "Rate of phi.", "0.8"},
    {"theta_dot", Dimension::rate, "Rate of theta.", "0.1"},
    {"psi_dot", Dimension::rate, "Rate of psi.", "0.9"},
};

RotorState from_euler(const ChartNumbers& x, const ChartPlace&) {
  return to_rotor(euler_state(x[0], x[1], x[2], x[3], x[4], x[5]));
}
ChartNumbers to_euler_numbers(const RotorState& s, const ChartPlace&) {
  const EulerState e = to_euler(s);
  return {e.phi, e.theta, e.psi, e.Phi, e.Theta, e.Psi};
}

RotorState from_rates(const ChartNumbers& x, const ChartPlace& at) {
  return to_rotor(*at.body, EulerRates{x[0], x[1], x[2], x[3], x[4], x[5]});
}
ChartNumbers to_rates(const RotorState& s, const ChartPlace& at) {
  const EulerRates e = to_euler_rates(*at.body, s);
  return {e.phi, e.theta, e.psi, e.phi_dot, e.theta_dot, e.psi_dot};
}

constexpr ChartKind charts[] = {
    {.name = "euler",
     .help = "3-1-3 Euler angles and their canonical momenta.",
     .variables = with_momenta,
     .to_hub = from_euler,
     .from_hub = to_euler_numbers,
     .in_scenarios = true,
     .state_class = "EulerState"},
    {.name = "euler-rates",
     .help = "3-1-3 Euler angles and their rates.",
     .variables = with_rates,
     .to_hub = from_rates,
     .from_hub = to_rates,
     .needs_body = true},
};

}  // namespace

std::span<const ChartKind> euler_charts() { return charts; }

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
