// SPDX-License-Identifier: MIT
#include "fit/detail/snapshot_residuals.hpp"

#include <array>
#include <limits>

#include "fit/detail/rotation_vector.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

std::vector<std::size_t> parameters_of(const SpinUnknowns& unknowns) {
  std::vector<std::size_t> found;
  const auto add = [&found](bool wanted, std::size_t first, std::size_t end) {
    for (std::size_t p = first; wanted && p < end; ++p) found.push_back(p);
  };
  add(unknowns.attitude, 0, first_rate);
  add(unknowns.rate, first_rate, first_ratio);
  add(unknowns.moment_ratios, first_ratio, first_product);
  add(unknowns.products, first_product, spin_parameters);
  return found;
}

const char* parameter_name(std::size_t parameter) {
  constexpr std::array<const char*, spin_parameters> names{
      "turn_x",  "turn_y",  "turn_z",  "w_x",     "w_y",    "w_z",
      "Ixx/Izz", "Iyy/Izz", "Ixy/Izz", "Iyz/Izz", "Ixz/Izz"};
  return names[parameter];
}

double parameter_of(const SpinState& s, std::size_t p) {
  const Mat3& T = s.inertia_F;
  const double unit = T(2, 2);
  switch (p) {
    case 6:
      return T(0, 0) / unit;
    case 7:
      return T(1, 1) / unit;
    case 8:
      return T(0, 1) / unit;
    case 9:
      return T(1, 2) / unit;
    case 10:
      return T(0, 2) / unit;
    default:
      return p < first_rate ? 0.0 : s.w_F[static_cast<int>(p - first_rate)];
  }
}

SpinState state_at(const SpinState& start, const std::vector<std::size_t>& parameters,
                   std::span<const double> x) {
  SpinState s = start;
  const double unit = s.inertia_F(2, 2);
  Vec3 turn;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const std::size_t p = parameters[k];
    Mat3& T = s.inertia_F;
    const double product = unit * x[k];
    if (p < first_rate)
      turn[static_cast<int>(p)] = x[k];
    else if (p < first_ratio)
      s.w_F[static_cast<int>(p - first_rate)] = x[k];
    else if (p == 6)
      T(0, 0) = product;
    else if (p == 7)
      T(1, 1) = product;
    else if (p == 8)
      T(0, 1) = T(1, 0) = product;
    else if (p == 9)
      T(1, 2) = T(2, 1) = product;
    else
      T(0, 2) = T(2, 0) = product;
  }
  s.q = normalized(s.q);
  if (!(turn == Vec3{})) s.q = normalized(s.q * turn_by(turn));
  return s;
}

SnapshotResiduals::SnapshotResiduals(const SpinFit& fit)
    : fit_(fit), parameters_(parameters_of(fit.unknowns)), rows_(fit.seen, fit.attitude_prior) {}

double SnapshotResiduals::attitude_rms(const SpinState& state) const {
  std::vector<MotionPoint> points;
  if (!free_motion(state, rows_.times(), {}, points)) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  std::vector<Quaternion> attitudes;
  for (const MotionPoint& point : points) attitudes.push_back(point.q);
  return rows_.attitude_rms(attitudes);
}

bool SnapshotResiduals::at(std::span<const double> x, std::span<double> numbers,
                           std::span<double> jacobian) const {
  const SpinState state = state_at(fit_.start, parameters_, x);
  std::vector<MotionPoint> points;
  if (!free_motion(state, rows_.times(), {!jacobian.empty(), fit_.unknowns.products}, points)) {
    return false;
  }
  // Turns about the start move the attitude by this times themselves.
  Mat3 of_turn = Mat3::identity();
  if (fit_.unknowns.attitude) of_turn = exp_derivative({x[0], x[1], x[2]});
  const auto column = [&](const std::array<Vec3, spin_parameters>& by, std::size_t k) {
    const std::size_t p = parameters_[k];
    if (p >= first_rate) return by[p];
    const int j = static_cast<int>(p);
    return of_turn(0, j) * by[0] + of_turn(1, j) * by[1] + of_turn(2, j) * by[2];
  };
  std::vector<MovedPoint> moved;
  for (const MotionPoint& point : points) {
    MovedPoint& to = moved.emplace_back(MovedPoint{point.q, point.w_F, {}, {}});
    for (std::size_t k = 0; !jacobian.empty() && k < parameters_.size(); ++k) {
      to.turn.push_back(column(point.turn, k));
      to.rate.push_back(column(point.rate, k));
    }
  }
  MovedPoint t0{state.q, state.w_F, {}, {}};
  for (const std::size_t p : parameters_) {
    const int j = static_cast<int>(p);
    t0.turn.push_back(p < first_rate ? Vec3{of_turn(0, j), of_turn(1, j), of_turn(2, j)} : Vec3{});
  }
  rows_.at(moved, t0, numbers, jacobian);
  return true;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
