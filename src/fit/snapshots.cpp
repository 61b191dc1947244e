// SPDX-License-Identifier: MIT
#include "polhode/fit/snapshots.hpp"

#include <Eigen/Dense>
#include <cmath>

#include "math/is_finite.hpp"
#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace {

std::string text(const Vec3& v) { return detail::tuple_text({v.x, v.y, v.z}); }
std::string name(const char* kind, std::size_t i) {
  return "Snapshots: " + std::string(kind) + " " + std::to_string(i + 1);
}

void require_time(const std::string& what, double t) {
  if (!std::isfinite(t)) {
    throw DomainError(what + ": t = " + detail::number_text(t) + " must be finite");
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
  throw DomainError(what + ": variances " + detail::tuple_text({c(0, 0), c(1, 1), c(2, 2)}) +
                    " and covariances " + detail::tuple_text({c(0, 1), c(0, 2), c(1, 2)}) +
                    " must be finite, symmetric and positive definite");
}

void require_direction(const std::string& what, const char* which, const Vec3& v) {
  if (!detail::is_finite(v) || !(norm(v) > 0.0)) {
    throw DomainError(what + ": " + which + " = " + text(v) + " must be finite and not 0");
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
                        std::to_string(j + 1) + ", at t = " + detail::number_text(seen[i].t) +
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
      throw DomainError(what + ": quaternion " + detail::tuple_text({a.q.w, a.q.x, a.q.y, a.q.z}) +
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
      throw DomainError(what + ": sigma = " + detail::number_text(d.sigma) +
                        " must be positive and finite");
    }
  }
  for (std::size_t i = 0; i < seen.rates.size(); ++i) {
    const ObservedRate& r = seen.rates[i];
    const std::string what = name("rate", i);
    require_time(what, r.t);
    if (!detail::is_finite(r.w_F)) throw DomainError(what + ": " + text(r.w_F) + " must be finite");
    require_covariance(what, r.covariance);
  }
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
  return found;
}

}  // namespace v0
}  // namespace polhode
