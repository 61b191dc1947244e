// SPDX-License-Identifier: MIT
// Snapshots: checks of what was observed, and its residuals beside a motion.
#include "polhode/fit/snapshots.hpp"

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "fit/detail/rotation_vector.hpp"
#include "fit/detail/scaling.hpp"
#include "fit/detail/snapshot_residuals.hpp"
#include "math/finite.hpp"
#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/fit/spin_fit.hpp"

namespace polhode {
inline namespace v0 {
namespace fit {

namespace {

std::string text(const Vec3& v) { return polhode::detail::tuple_text({v.x, v.y, v.z}); }
std::string name(const char* kind, std::size_t i) {
  return "Snapshots: " + std::string(kind) + " " + std::to_string(i + 1);
}

void require_time(const std::string& what, double t) {
  if (!std::isfinite(t)) {
    throw DomainError(what + ": t = " + polhode::detail::number_text(t) + " must be finite");
  }
}

void require_covariance(const std::string& what, const Mat3& c) {
  Eigen::Matrix3d m;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) m(i, j) = c(i, j);
  }
  // Scaled to correlations, so that units do not matter.
  const Eigen::Vector3d d = m.diagonal().cwiseSqrt();
  const bool positive = m.allFinite() && d.allFinite() && d.minCoeff() > 0.0;
  if (positive) {
    m = d.cwiseInverse().asDiagonal() * m * d.cwiseInverse().asDiagonal();
    const Eigen::LLT<Eigen::Matrix3d> factor(m);
    if (m.isApprox(m.transpose(), 1e-9) && factor.info() == Eigen::Success) return;
  }
  throw DomainError(what + ": variances " +
                    polhode::detail::tuple_text({c(0, 0), c(1, 1), c(2, 2)}) + " and covariances " +
                    polhode::detail::tuple_text({c(0, 1), c(0, 2), c(1, 2)}) +
                    " must be finite, symmetric and positive definite");
}

void require_direction(const std::string& what, const char* which, const Vec3& v) {
  if (!polhode::detail::is_finite(v) || !(norm(v) > 0.0)) {
    throw DomainError(what + ": " + which + " = " + text(v) + " must be finite and not 0");
  }
}

void require_measurement(const std::string& what, const Measurement& m) {
  require_time(what, m.t);
  if (m.function == nullptr || !*m.function)
    throw DomainError(what + ": there is no function of the motion; expected one");
  const bool has_angles = m.are_angles.empty() || m.are_angles.size() == m.seen.size();
  if (m.seen.empty() || m.sigmas.size() != m.seen.size() || !has_angles)
    throw DomainError(what + ": " + std::to_string(m.seen.size()) + " numbers and " +
                      std::to_string(m.sigmas.size()) +
                      " errors; expected one error for each number, and one number or more");
  for (std::size_t i = 0; i < m.seen.size(); ++i) {
    if (!std::isfinite(m.seen[i]))
      throw DomainError(what + ": " + polhode::detail::number_text(m.seen[i]) + " must be finite");
    if (!(m.sigmas[i] > 0.0) || !std::isfinite(m.sigmas[i]))
      throw DomainError(what + ": sigma = " + polhode::detail::number_text(m.sigmas[i]) +
                        " must be positive and finite");
  }
}

template <class Seen>
void add_repeated(std::vector<std::string>& found, const char* kind, const std::vector<Seen>& seen,
                  const auto& same) {
  // Few observations: each is compared with all earlier ones.
  for (std::size_t i = 0; i < seen.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (seen[i].t == seen[j].t && same(seen[i], seen[j])) {
        found.push_back(std::string(kind) + " " + std::to_string(i + 1) + " repeats " +
                        std::to_string(j + 1) +
                        ", at t = " + polhode::detail::number_text(seen[i].t) +
                        ": counted as two independent ones");
        break;
      }
    }
  }
}

}  // namespace

std::vector<double> times_of(const Snapshots& seen) {
  std::vector<double> times;
  for (const ObservedAttitude& one : seen.attitudes) times.push_back(one.t);
  for (const ObservedDirection& one : seen.directions) times.push_back(one.t);
  for (const ObservedRate& one : seen.rates) times.push_back(one.t);
  for (const Measurement& one : seen.measurements) times.push_back(one.t);
  return times;
}

Mat3 covariance_of(const Vec3& sigma) {
  Mat3 c;
  for (int i = 0; i < 3; ++i) c(i, i) = sigma[i] * sigma[i];
  return c;
}

Mat3 covariance_of(double sigma) { return covariance_of(Vec3{sigma, sigma, sigma}); }

void check(const Snapshots& seen) {
  for (std::size_t i = 0; i < seen.attitudes.size(); ++i) {
    const ObservedAttitude& a = seen.attitudes[i];
    const std::string what = name("attitude", i);
    require_time(what, a.t);
    const double size = std::hypot(std::hypot(a.q.w, a.q.x), std::hypot(a.q.y, a.q.z));
    if (!std::isfinite(size) || !(size > 0.0)) {
      throw DomainError(what + ": quaternion " +
                        polhode::detail::tuple_text({a.q.w, a.q.x, a.q.y, a.q.z}) +
                        " must be finite and not 0");
    }
    require_covariance(what, a.covariance);
  }
  for (std::size_t i = 0; i < seen.directions.size(); ++i) {
    const ObservedDirection& d = seen.directions[i];
    const std::string what = name("direction", i);
    require_time(what, d.t);
    require_direction(what, "axis_F", d.axis_F);
    require_direction(what, "direction_I", d.direction_I);
    if (!(d.sigma > 0.0) || !std::isfinite(d.sigma)) {
      throw DomainError(what + ": sigma = " + polhode::detail::number_text(d.sigma) +
                        " must be positive and finite");
    }
  }
  for (std::size_t i = 0; i < seen.rates.size(); ++i) {
    const ObservedRate& r = seen.rates[i];
    const std::string what = name("rate", i);
    require_time(what, r.t);
    if (!polhode::detail::is_finite(r.w_F))
      throw DomainError(what + ": " + text(r.w_F) + " must be finite");
    require_covariance(what, r.covariance);
  }
  for (std::size_t i = 0; i < seen.measurements.size(); ++i)
    require_measurement(name("measurement", i), seen.measurements[i]);
}

std::vector<std::string> repeated(const Snapshots& seen) {
  std::vector<std::string> found;
  add_repeated(found, "attitude", seen.attitudes,
               [](const auto& a, const auto& b) { return a.q == b.q; });
  add_repeated(found, "direction", seen.directions, [](const auto& a, const auto& b) {
    return a.axis_F == b.axis_F && a.direction_I == b.direction_I;
  });
  add_repeated(found, "rate", seen.rates,
               [](const auto& a, const auto& b) { return a.w_F == b.w_F; });
  add_repeated(found, "measurement", seen.measurements, [](const auto& a, const auto& b) {
    return a.seen == b.seen && a.function == b.function;
  });
  return found;
}

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

constexpr double whole_turn = 2.0 * std::numbers::pi;

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

namespace {

// The numbers of a measurement, and their derivatives by a turn in body axes and by the rate.
struct MeasuredPoint {
  std::vector<double> numbers;
  std::vector<Vec3> by_turn, by_rate;
};
MeasuredPoint measured_point(const Measurement& m, const MovedPoint& at, bool has_derivatives) {
  const std::size_t n = m.seen.size();
  const auto numbers_at = [&](const Quaternion& q, const Vec3& w) {
    std::vector<double> numbers(n);
    (*m.function)(m.t, q, w, numbers);
    return numbers;
  };
  MeasuredPoint point{numbers_at(at.q, at.w_F), {}, {}};
  if (!has_derivatives) return point;
  constexpr double turn = 6e-6;  // the third root of a rounding
  const double size = norm(at.w_F);
  const double rate = size > 0.0 ? turn * size : turn;  // at rest: of one radian per unit of time
  point.by_turn.resize(n);
  point.by_rate.resize(n);
  for (int j = 0; j < 3; ++j) {
    Vec3 step;
    step[j] = 1.0;
    const auto difference = [&](const std::vector<double>& up, const std::vector<double>& down,
                                double h, std::vector<Vec3>& into) {
      for (std::size_t i = 0; i < n; ++i) {
        double change = up[i] - down[i];
        if (!m.are_angles.empty() && m.are_angles[i]) change = std::remainder(change, whole_turn);
        into[i][j] = change / (2.0 * h);
      }
    };
    difference(numbers_at(normalized(at.q * turn_by(turn * step)), at.w_F),
               numbers_at(normalized(at.q * turn_by(-turn * step)), at.w_F), turn, point.by_turn);
    difference(numbers_at(at.q, at.w_F + rate * step), numbers_at(at.q, at.w_F - rate * step), rate,
               point.by_rate);
  }
  return point;
}

void add_measurement(auto& rows, const Measurement& m, const MovedPoint& at) {
  const MeasuredPoint point = measured_point(m, at, rows.has_derivatives());
  for (std::size_t i = 0; i < m.seen.size(); ++i) {
    double r = point.numbers[i] - m.seen[i];
    if (!m.are_angles.empty() && m.are_angles[i]) r = std::remainder(r, whole_turn);
    rows.add(r / m.sigmas[i], [&](std::size_t k) {
      return (dot(point.by_turn[i], at.turn[k]) + dot(point.by_rate[i], at.rate[k])) / m.sigmas[i];
    });
  }
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
  for (const Measurement& m : seen.measurements) times_.push_back(m.t);
  if (prior) prior_root_ = whitening(prior->covariance);
}

std::vector<std::size_t> SnapshotRows::blocks() const {
  std::vector<std::size_t> found(seen_.attitudes.size(), 3);
  found.insert(found.end(), seen_.directions.size(), 2);
  found.insert(found.end(), seen_.rates.size(), 3);
  for (const Measurement& m : seen_.measurements) found.push_back(m.seen.size());
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
  for (const Measurement& m : seen_.measurements) add_measurement(rows, m, points[n++]);
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
}  // namespace fit
}  // namespace v0
}  // namespace polhode
