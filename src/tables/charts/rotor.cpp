// SPDX-License-Identifier: MIT
// The hub itself, and attitudes with a rate: a scenario has these in [state.attitude-rate], and its
// rows in the columns q, g, omega and omega_inertial.
#include "polhode/rotor/attitude.hpp"
#include "tables/detail/chart_families.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

constexpr ChartVariable qw{"qw", Dimension::number, "Scalar part of the quaternion.", "1.0"};
constexpr ChartVariable qx{"qx", Dimension::number, "Its component x.", "0.0"};
constexpr ChartVariable qy{"qy", Dimension::number, "Its component y.", "0.0"};
constexpr ChartVariable qz{"qz", Dimension::number, "Its component z.", "0.0"};
constexpr ChartVariable g1{"g1", Dimension::momentum, "Momentum along body axis 1.", "0.1"};
constexpr ChartVariable g2{"g2", Dimension::momentum, "Momentum along body axis 2.", "2.0"};
constexpr ChartVariable g3{"g3", Dimension::momentum, "Momentum along body axis 3.", "0.5"};

constexpr ChartVariable with_momentum[] = {qw, qx, qy, qz, g1, g2, g3};
constexpr ChartVariable with_rate[] = {
    qw,
    qx,
    qy,
    qz,
    {"w1", Dimension::rate, "Angular velocity along body axis 1.", "1.0"},
    {"w2", Dimension::rate, "Angular velocity along body axis 2.", "20.0"},
    {"w3", Dimension::rate, "Angular velocity along body axis 3.", "5.0"}};
constexpr ChartVariable with_inertial_rate[] = {
    qw,
    qx,
    qy,
    qz,
    {"W1", Dimension::rate, "Angular velocity along inertial axis 1.", "1.0"},
    {"W2", Dimension::rate, "Angular velocity along inertial axis 2.", "20.0"},
    {"W3", Dimension::rate, "Angular velocity along inertial axis 3.", "5.0"}};
constexpr ChartVariable with_matrix[] = {
    {"R11", Dimension::number, "Inertial axis 1 along body axis 1.", "1.0"},
    {"R12", Dimension::number, "Inertial axis 2 along body axis 1.", "0.0"},
    {"R13", Dimension::number, "Inertial axis 3 along body axis 1.", "0.0"},
    {"R21", Dimension::number, "Inertial axis 1 along body axis 2.", "0.0"},
    {"R22", Dimension::number, "Inertial axis 2 along body axis 2.", "1.0"},
    {"R23", Dimension::number, "Inertial axis 3 along body axis 2.", "0.0"},
    {"R31", Dimension::number, "Inertial axis 1 along body axis 3.", "0.0"},
    {"R32", Dimension::number, "Inertial axis 2 along body axis 3.", "0.0"},
    {"R33", Dimension::number, "Inertial axis 3 along body axis 3.", "1.0"},
    g1,
    g2,
    g3};

Quaternion attitude_in(const ChartNumbers& x) { return unit_quaternion(x[0], x[1], x[2], x[3]); }
ChartNumbers numbers(const Quaternion& q, const Vec3& v) {
  return {q.w, q.x, q.y, q.z, v.x, v.y, v.z};
}

RotorState from_rotor(const ChartNumbers& x, const ChartPlace&) {
  return {attitude_in(x), {x[4], x[5], x[6]}};
}
ChartNumbers to_rotor_numbers(const RotorState& s, const ChartPlace&) { return numbers(s.q, s.g); }

RotorState from_rate(const ChartNumbers& x, const ChartPlace& at) {
  return rotor_state(*at.body, attitude_in(x), {x[4], x[5], x[6]});
}
ChartNumbers to_rate(const RotorState& s, const ChartPlace& at) {
  return numbers(s.q, angular_velocity(*at.body, s));
}

RotorState from_inertial_rate(const ChartNumbers& x, const ChartPlace& at) {
  return rotor_state_inertial(*at.body, attitude_in(x), {x[4], x[5], x[6]});
}
ChartNumbers to_inertial_rate(const RotorState& s, const ChartPlace& at) {
  return numbers(s.q, inertial_angular_velocity(*at.body, s));
}

RotorState from_matrix(const ChartNumbers& x, const ChartPlace&) {
  const Mat3 R{{{x[0], x[1], x[2]}, {x[3], x[4], x[5]}, {x[6], x[7], x[8]}}};
  return {attitude(R), {x[9], x[10], x[11]}};
}
ChartNumbers to_matrix(const RotorState& s, const ChartPlace&) {
  const Mat3 R = attitude_matrix(s.q);
  return {R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2),
          R(2, 0), R(2, 1), R(2, 2), s.g.x,   s.g.y,   s.g.z};
}

constexpr ChartKind charts[] = {
    {.name = "rotor",
     .help = "Attitude quaternion and body angular momentum.",
     .variables = with_momentum,
     .to_hub = from_rotor,
     .from_hub = to_rotor_numbers},
    {.name = "attitude-rate",
     .help = "Attitude quaternion and angular velocity, body components.",
     .variables = with_rate,
     .to_hub = from_rate,
     .from_hub = to_rate,
     .needs_body = true},
    {.name = "attitude-rate-inertial",
     .help = "Attitude quaternion and angular velocity, inertial components.",
     .variables = with_inertial_rate,
     .to_hub = from_inertial_rate,
     .from_hub = to_inertial_rate,
     .needs_body = true},
    {.name = "matrix",
     .help = "Rotation matrix, inertial to body, and body angular momentum.",
     .variables = with_matrix,
     .to_hub = from_matrix,
     .from_hub = to_matrix},
};

}  // namespace

std::span<const ChartKind> rotor_charts() { return charts; }

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
