// SPDX-License-Identifier: MIT
#include "fit/detail/snapshot_residuals.hpp"

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <limits>

#include "fit/detail/rotation_vector.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

// L^-1 of C = L L^T.
Mat3 whitening(const Mat3& covariance) {
  Eigen::Matrix3d c;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) c(i, j) = covariance(i, j);
  }
  const Eigen::Matrix3d root =
      c.llt().matrixL().solve(Eigen::Matrix3d(Eigen::Matrix3d::Identity()));
  Mat3 found;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) found(i, j) = root(i, j);
  }
  return found;
}

Vec3 unit(const Vec3& v) { return (1.0 / norm(v)) * v; }

// Two directions across d.
std::array<Vec3, 2> across(const Vec3& d) {
  const Vec3 other = std::abs(d.x) < 0.6 ? Vec3{1.0, 0.0, 0.0} : Vec3{0.0, 1.0, 0.0};
  const Vec3 e = unit(cross(d, other));
  return {e, cross(d, e)};
}

// k = angle / sin(angle), and dk/dcos(angle).
struct Stretch {
  double k, slope;
};
Stretch stretch(double sine, double cosine) {
  const double s2 = sine * sine;
  if (s2 < 1e-6 && cosine > 0.0) {
    return {1.0 + s2 / 6.0 + 3.0 * s2 * s2 / 40.0, -(1.0 + 0.4 * s2) / 3.0};
  }
  const double k = std::atan2(sine, cosine) / sine;
  return {k, (cosine * k - 1.0) / s2};
}

}  // namespace

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

// Where rows of residuals and their derivatives go, one observation after the other.
class SnapshotResiduals::Rows {
 public:
  Rows(std::span<double> numbers, std::span<double> jacobian, std::size_t unknowns)
      : numbers_(numbers), jacobian_(jacobian), unknowns_(unknowns) {}

  bool has_derivatives() const { return !jacobian_.empty(); }
  // root r, and by unknown k root slope(k).
  void add(const Mat3& root, const Vec3& r, const auto& slope) {
    const Vec3 white = root * r;
    for (int i = 0; i < 3; ++i) numbers_[row_ + static_cast<std::size_t>(i)] = white[i];
    for (std::size_t k = 0; has_derivatives() && k < unknowns_; ++k) {
      const Vec3 column = root * slope(k);
      for (int i = 0; i < 3; ++i) {
        jacobian_[(row_ + static_cast<std::size_t>(i)) * unknowns_ + k] = column[i];
      }
    }
    row_ += 3;
  }
  void add(double r, const auto& slope) {
    numbers_[row_] = r;
    for (std::size_t k = 0; has_derivatives() && k < unknowns_; ++k) {
      jacobian_[row_ * unknowns_ + k] = slope(k);
    }
    ++row_;
  }

 private:
  std::span<double> numbers_, jacobian_;
  std::size_t unknowns_;
  std::size_t row_ = 0;
};

SnapshotResiduals::SnapshotResiduals(const SpinFit& fit)
    : fit_(fit), parameters_(parameters_of(fit.unknowns)) {
  for (const ObservedAttitude& a : fit.seen.attitudes) {
    times_.push_back(a.t);
    attitude_roots_.push_back(whitening(a.covariance));
  }
  for (const ObservedDirection& d : fit.seen.directions) times_.push_back(d.t);
  for (const ObservedRate& r : fit.seen.rates) {
    times_.push_back(r.t);
    rate_roots_.push_back(whitening(r.covariance));
  }
  if (fit.attitude_prior) prior_root_ = whitening(fit.attitude_prior->covariance);
}

std::vector<std::size_t> SnapshotResiduals::blocks() const {
  std::vector<std::size_t> found(fit_.seen.attitudes.size(), 3);
  found.insert(found.end(), fit_.seen.directions.size(), 2);
  found.insert(found.end(), fit_.seen.rates.size(), 3);
  return found;
}

double SnapshotResiduals::attitude_rms(const SpinState& state) const {
  const std::vector<ObservedAttitude>& seen = fit_.seen.attitudes;
  std::vector<MotionPoint> points;
  if (seen.empty() || !free_motion(state, times_, {}, points)) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const Vec3 r = attitude_residual(seen[i].q, points[i].q);
    sum += dot(r, r);
  }
  return std::sqrt(sum / (3.0 * static_cast<double>(seen.size())));
}

bool SnapshotResiduals::at(std::span<const double> x, std::span<double> numbers,
                           std::span<double> jacobian) const {
  const SpinState state = state_at(fit_.start, parameters_, x);
  std::vector<MotionPoint> points;
  if (!free_motion(state, times_, {!jacobian.empty(), fit_.unknowns.products}, points)) {
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
  Rows rows(numbers, jacobian, parameters_.size());
  std::size_t n = 0;
  for (std::size_t i = 0; i < fit_.seen.attitudes.size(); ++i, ++n) {
    const Vec3 r = attitude_residual(fit_.seen.attitudes[i].q, points[n].q);
    const Mat3 slope = log_derivative(r);
    rows.add(attitude_roots_[i], r,
             [&](std::size_t k) { return slope * column(points[n].turn, k); });
  }
  for (const ObservedDirection& d : fit_.seen.directions) {
    const Vec3 seen = unit(d.direction_I), axis = unit(d.axis_F);
    const Vec3 u = rotate(points[n].q, axis);
    const Stretch f = stretch(norm(cross(seen, u)), dot(seen, u));
    for (const Vec3& e : across(seen)) {
      rows.add(f.k * dot(u, e) / d.sigma, [&](std::size_t k) {
        const Vec3 du = rotate(points[n].q, cross(column(points[n].turn, k), axis));
        return (f.k * dot(du, e) + f.slope * dot(du, seen) * dot(u, e)) / d.sigma;
      });
    }
    ++n;
  }
  for (std::size_t i = 0; i < fit_.seen.rates.size(); ++i, ++n) {
    rows.add(rate_roots_[i], points[n].w_F - fit_.seen.rates[i].w_F,
             [&](std::size_t k) { return column(points[n].rate, k); });
  }
  if (fit_.attitude_prior) {
    const Vec3 r = attitude_residual(fit_.attitude_prior->q, state.q);
    const Mat3 slope = log_derivative(r);
    rows.add(prior_root_, r, [&](std::size_t k) {
      const std::size_t p = parameters_[k];
      if (p >= first_rate) return Vec3{};
      const int j = static_cast<int>(p);
      return slope * Vec3{of_turn(0, j), of_turn(1, j), of_turn(2, j)};
    });
  }
  return true;
}

}  // namespace detail

Vec3 attitude_residual(const Quaternion& seen, const Quaternion& predicted) {
  return detail::rotation_vector(normalized(conj(seen) * predicted));
}

}  // namespace v0
}  // namespace polhode
