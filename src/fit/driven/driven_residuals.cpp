// SPDX-License-Identifier: MIT
#include "fit/driven/driven_residuals.hpp"

#include <limits>
#include <string>

#include "fit/detail/rotation_vector.hpp"
#include "fit/detail/snapshot_residuals.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

Vec3 unit_vector(std::size_t k) {
  Vec3 e;
  e[static_cast<int>(k)] = 1.0;
  return e;
}

}  // namespace

std::vector<Vec3> changes_of(const SpinDrive& drive) {
  std::vector<Vec3> found;
  for (const SpinJump& jump : drive.jumps) found.push_back(jump.change);
  return found;
}

std::vector<double> starts_of(const SpinDrive& drive) {
  std::vector<double> found;
  for (const TorqueParameter& one : drive.parameters) found.push_back(one.start);
  return found;
}

DrivenResiduals::DrivenResiduals(const SpinFit& fit, const SpinDrive& drive)
    : fit_(fit),
      drive_(drive),
      parameters_(parameters_of(fit.unknowns)),
      rows_(fit.seen, fit.attitude_prior) {}

std::vector<Unknown> DrivenResiduals::unknowns() const {
  std::vector<Unknown> found;
  for (const std::size_t p : parameters_) {
    Unknown u;
    u.name = parameter_name(p);
    u.start = parameter_of(fit_.start, p);
    found.push_back(u);
  }
  for (const TorqueParameter& one : drive_.parameters) {
    found.push_back({one.name, one.start, one.low, one.high});
  }
  for (const SpinJump& jump : drive_.jumps) {
    for (int k = 0; k < 3; ++k) {
      Unknown u;
      u.name = jump.name + "[" + std::to_string(k) + "]";
      u.start = jump.change[k];
      found.push_back(u);
    }
  }
  return found;
}

std::optional<TriangleBound> DrivenResiduals::triangle() const {
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    if (parameters_[i] == first_ratio) return TriangleBound{i, i + 1};
  }
  return std::nullopt;
}

SpinState DrivenResiduals::state(std::span<const double> x) const {
  return state_at(fit_.start, parameters_, x);
}

SpinDrive DrivenResiduals::drive(std::span<const double> x) const {
  SpinDrive found = drive_;
  std::size_t i = parameters_.size();
  for (TorqueParameter& one : found.parameters) one.start = x[i++];
  for (SpinJump& jump : found.jumps) {
    for (int k = 0; k < 3; ++k) jump.change[k] = x[i++];
  }
  return found;
}

std::vector<DrivenColumn> DrivenResiduals::columns(std::span<const double> x) const {
  using enum DrivenColumn::Of;
  // Turns about the start move the attitude by this times themselves.
  Mat3 of_turn = Mat3::identity();
  if (fit_.unknowns.attitude) of_turn = exp_derivative({x[0], x[1], x[2]});
  std::vector<DrivenColumn> found;
  for (const std::size_t p : parameters_) {
    if (p < first_rate)
      found.push_back({turn, 0, of_turn * unit_vector(p)});
    else if (p < first_ratio)
      found.push_back({rate, 0, unit_vector(p - first_rate)});
    else
      found.push_back({ratio, p - first_ratio, {}});
  }
  for (std::size_t k = 0; k < drive_.parameters.size(); ++k) found.push_back({torque, k, {}});
  for (std::size_t j = 0; j < drive_.jumps.size(); ++j) {
    for (std::size_t k = 0; k < 3; ++k) found.push_back({jump, j, unit_vector(k)});
  }
  return found;
}

std::optional<std::vector<MovedPoint>> DrivenResiduals::moved(
    std::span<const double> x, std::span<const DrivenColumn> columns) const {
  const SpinDrive at = drive(x);
  try {
    return DrivenMotion(at, state(x), starts_of(at), changes_of(at)).at(rows_.times(), columns);
  } catch (const DomainError&) {
    return std::nullopt;  // a trial step to a body or a torque that there is not
  }
}

bool DrivenResiduals::at(std::span<const double> x, std::span<double> numbers,
                         std::span<double> jacobian) const {
  std::vector<DrivenColumn> by;
  if (!jacobian.empty()) by = columns(x);
  const auto points = moved(x, by);
  if (!points) return false;
  const SpinState s = state(x);
  MovedPoint t0{s.q, s.w_F, {}, {}};
  for (const DrivenColumn& column : columns(x)) {
    t0.turn.push_back(column.of == DrivenColumn::Of::turn ? column.axis_F : Vec3{});
  }
  rows_.at(*points, t0, numbers, jacobian);
  return true;
}

double DrivenResiduals::attitude_rms(std::span<const double> x) const {
  const auto points = moved(x, {});
  if (!points) return std::numeric_limits<double>::quiet_NaN();
  std::vector<Quaternion> attitudes;
  for (const MovedPoint& point : *points) attitudes.push_back(point.q);
  return rows_.attitude_rms(attitudes);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
