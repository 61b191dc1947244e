// SPDX-License-Identifier: MIT
#include "fit/detail/snapshot_rows.hpp"

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <limits>

#include "fit/detail/inverse_root.hpp"
#include "fit/detail/rotation_vector.hpp"
#include "polhode/fit/spin_fit.hpp"

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
  const Eigen::Matrix3d root = inverse_root(c.llt());
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

// Where rows of residuals and their derivatives go, one observation after the other.
class SnapshotRows::Rows {
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

SnapshotRows::SnapshotRows(const Snapshots& seen, const std::optional<ObservedAttitude>& prior)
    : seen_(seen), prior_(prior) {
  for (const ObservedAttitude& a : seen.attitudes) {
    times_.push_back(a.t);
    attitude_roots_.push_back(whitening(a.covariance));
  }
  for (const ObservedDirection& d : seen.directions) times_.push_back(d.t);
  for (const ObservedRate& r : seen.rates) {
    times_.push_back(r.t);
    rate_roots_.push_back(whitening(r.covariance));
  }
  if (prior) prior_root_ = whitening(prior->covariance);
}

std::vector<std::size_t> SnapshotRows::blocks() const {
  std::vector<std::size_t> found(seen_.attitudes.size(), 3);
  found.insert(found.end(), seen_.directions.size(), 2);
  found.insert(found.end(), seen_.rates.size(), 3);
  return found;
}

double SnapshotRows::attitude_rms(std::span<const Quaternion> points) const {
  if (seen_.attitudes.empty()) return std::numeric_limits<double>::quiet_NaN();
  double sum = 0.0;
  for (std::size_t i = 0; i < seen_.attitudes.size(); ++i) {
    const Vec3 r = attitude_residual(seen_.attitudes[i].q, points[i]);
    sum += dot(r, r);
  }
  return std::sqrt(sum / (3.0 * static_cast<double>(seen_.attitudes.size())));
}

void SnapshotRows::at(std::span<const MovedPoint> points, const MovedPoint& t0,
                      std::span<double> numbers, std::span<double> jacobian) const {
  Rows rows(numbers, jacobian, t0.turn.size());
  std::size_t n = 0;
  for (std::size_t i = 0; i < seen_.attitudes.size(); ++i, ++n) {
    const Vec3 r = attitude_residual(seen_.attitudes[i].q, points[n].q);
    const Mat3 slope = log_derivative(r);
    rows.add(attitude_roots_[i], r, [&](std::size_t k) { return slope * points[n].turn[k]; });
  }
  for (const ObservedDirection& d : seen_.directions) {
    const Vec3 seen = unit(d.direction_I), axis = unit(d.axis_F);
    const Vec3 u = rotate(points[n].q, axis);
    const Stretch f = stretch(norm(cross(seen, u)), dot(seen, u));
    for (const Vec3& e : across(seen)) {
      rows.add(f.k * dot(u, e) / d.sigma, [&](std::size_t k) {
        const Vec3 du = rotate(points[n].q, cross(points[n].turn[k], axis));
        return (f.k * dot(du, e) + f.slope * dot(du, seen) * dot(u, e)) / d.sigma;
      });
    }
    ++n;
  }
  for (std::size_t i = 0; i < seen_.rates.size(); ++i, ++n) {
    rows.add(rate_roots_[i], points[n].w_F - seen_.rates[i].w_F,
             [&](std::size_t k) { return points[n].rate[k]; });
  }
  if (prior_) {
    const Vec3 r = attitude_residual(prior_->q, t0.q);
    const Mat3 slope = log_derivative(r);
    rows.add(prior_root_, r, [&](std::size_t k) { return slope * t0.turn[k]; });
  }
}

}  // namespace detail

Vec3 attitude_residual(const Quaternion& seen, const Quaternion& predicted) {
  return detail::rotation_vector(normalized(conj(seen) * predicted));
}

}  // namespace v0
}  // namespace polhode
