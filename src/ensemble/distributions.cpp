// SPDX-License-Identifier: MIT
// Distributions as functions of uniform numbers, and normal ones of several correlated numbers.
#include "polhode/ensemble/distributions.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "math/number_text.hpp"
#include "math/pack_functions.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace ensemble {

namespace {

using polhode::detail::number_text;
using One = Pack<InstructionSet::baseline>;  // its functions have the same bits on any machine

constexpr double largest_ratio = 1e300;
constexpr double reach = 37.0;  // beyond, probabilities are no normal doubles

[[noreturn]] void refuse(const std::string& function, const std::string& what, double value,
                         const std::string& requirement) {
  throw DomainError(function + ": " + what + " " + number_text(value) + " " + requirement);
}

void require_finite(const std::string& function, const std::string& what, double value) {
  if (!std::isfinite(value)) refuse(function, what, value, "must be finite");
}

// NaN fails, too.
void require_order(const std::string& function, double low, double high) {
  if (!(low < high))
    refuse(function, "low", low, "must be below high, which is " + number_text(high));
}

// The probability below z <= 0: where normal_quantile, which grows with the bits of u, becomes z.
double probability_below(double z) {
  if (z == 0.0) return 0.5;
  if (z == -std::numeric_limits<double>::infinity()) return 0.0;
  auto low = std::bit_cast<std::uint64_t>(std::numeric_limits<double>::min());
  auto high = std::bit_cast<std::uint64_t>(0.5);
  while (high - low > 1) {  // 62 times at most
    const std::uint64_t middle = low + (high - low) / 2;
    (normal_quantile(std::bit_cast<double>(middle)) < z ? low : high) = middle;
  }
  return std::bit_cast<double>(high);
}

// That of z of any sign.
double below(double z) { return z <= 0.0 ? probability_below(z) : 1.0 - probability_below(-z); }

}  // namespace

Uniform::Uniform(double low, double high) : low_(low), high_(high) {
  require_finite("Uniform", "low", low);
  require_finite("Uniform", "high", high);
  require_order("Uniform", low, high);
  if (!std::isfinite(high - low)) refuse("Uniform", "high - low", high - low, "must be finite");
}

double Uniform::from_uniform(double u) const { return std::min(low_ + u * (high_ - low_), high_); }

LogUniform::LogUniform(double low, double high)
    : low_(low), high_(high), log_ratio_(log_of(One(high / low)).lanes[0]) {
  if (!(low > 0.0)) refuse("LogUniform", "low", low, "must be positive");
  require_finite("LogUniform", "high", high);
  require_order("LogUniform", low, high);
  if (!(high / low <= largest_ratio))
    refuse("LogUniform", "high / low", high / low, "must be at most 1e300");
}

double LogUniform::from_uniform(double u) const {
  const double part = exp_of_negative(One(-(1.0 - u) * log_ratio_)).lanes[0];
  return std::clamp(high_ * part, low_, high_);
}

Normal::Normal(double mean, double sigma) : mean_(mean), sigma_(sigma) {
  require_finite("Normal", "mean", mean);
  require_finite("Normal", "sigma", sigma);
  if (sigma < 0.0) refuse("Normal", "sigma", sigma, "must not be negative");
}

TruncatedNormal::TruncatedNormal(double mean, double sigma, double low, double high)
    : mean_(mean), sigma_(sigma), low_(low), high_(high), turned_(low > mean) {
  const std::string name = "TruncatedNormal";
  require_finite(name, "mean", mean);
  require_finite(name, "sigma", sigma);
  if (sigma < 0.0) refuse(name, "sigma", sigma, "must not be negative");
  require_order(name, low, high);
  if (sigma == 0.0) {
    if (low > mean) refuse(name, "low", low, "must be at most the mean, where sigma is 0");
    if (high < mean) refuse(name, "high", high, "must be at least the mean, where sigma is 0");
    below_ = above_ = 0.0;
    within_ = 1.0;
    return;
  }
  if (low > mean + reach * sigma)
    refuse(name, "low", low, "must be at most 37 sigma above the mean");
  if (high < mean - reach * sigma)
    refuse(name, "high", high, "must be at most 37 sigma below the mean");
  const double from = (turned_ ? mean - high : low - mean) / sigma;
  const double to = (turned_ ? mean - low : high - mean) / sigma;
  below_ = probability_below(from);
  above_ = below(-to);
  within_ = below(to) - below_;
}

double TruncatedNormal::from_uniform(double u) const {
  const double up = turned_ ? 1.0 - u : u;
  const double p = below_ + up * within_;
  const double z = p <= 0.5 ? normal_quantile(std::max(p, std::numeric_limits<double>::min()))
                            : -normal_quantile(above_ + (1.0 - up) * within_);
  return std::clamp(mean_ + sigma_ * (turned_ ? -z : z), low_, high_);
}

Vec3 IsotropicDirection::from_uniform(double u0, double u1) const {
  const SinCos<One> longitude = sincos(One(2.0 * std::numbers::pi * u1));
  const double across = 2.0 * std::sqrt(u0 * (1.0 - u0));  // sqrt(1 - z^2), not cancelling
  return {across * longitude.cos.lanes[0], across * longitude.sin.lanes[0], 2.0 * u0 - 1.0};
}

Quaternion UniformAttitude::from_uniform(double u0, double u1, double u2) const {
  // both in one go
  const SinCos<One> at = sincos(One(2.0 * std::numbers::pi) * One(One::Doubles{u1, u2}));
  const double a = std::sqrt(1.0 - u0), b = std::sqrt(u0);
  return {b * at.cos.lanes[1], a * at.sin.lanes[0], a * at.cos.lanes[0], b * at.sin.lanes[1]};
}

namespace {

using polhode::detail::number_text;

constexpr double eps = std::numeric_limits<double>::epsilon();
// By how many eps the halves of a covariance may differ, and n times as many its eigenvalues be
// below 0: what roundings leave.
constexpr double slack = 8.0;

// A square matrix, row by row.
struct Square {
  std::size_t n;
  std::vector<double> entries;

  double& at(std::size_t i, std::size_t j) { return entries[i * n + j]; }
  double at(std::size_t i, std::size_t j) const { return entries[i * n + j]; }
};

std::string place(std::size_t i, std::size_t j) {
  return "covariance[" + std::to_string(i) + "][" + std::to_string(j) + "] = ";
}

[[noreturn]] void refuse(const std::string& message) {
  throw DomainError("JointNormal: " + message);
}

void require_numbers(const std::vector<double>& mean, const std::vector<double>& covariance) {
  const std::size_t n = mean.size();
  if (n == 0) refuse("a mean of 0 numbers must have one or more");
  if (covariance.size() != n * n)
    refuse("a covariance of " + std::to_string(covariance.size()) + " numbers must have " +
           std::to_string(n * n) + " for a mean of " + std::to_string(n));
  for (std::size_t i = 0; i < n; ++i)
    if (!std::isfinite(mean[i]))
      refuse("mean[" + std::to_string(i) + "] = " + number_text(mean[i]) + " must be finite");
}

void require_variances(const Square& c) {
  for (std::size_t i = 0; i < c.n; ++i) {
    for (std::size_t j = 0; j < c.n; ++j)
      if (!std::isfinite(c.at(i, j)))
        refuse(place(i, j) + number_text(c.at(i, j)) + " must be finite");
    if (c.at(i, i) < 0.0) refuse(place(i, i) + number_text(c.at(i, i)) + " must not be negative");
  }
}

// The correlations; 0 beside a variance of 0.
Square correlations(const Square& c, const std::vector<double>& sigmas) {
  Square r{c.n, std::vector<double>(c.n * c.n, 0.0)};
  for (std::size_t i = 0; i < c.n; ++i) {
    if (sigmas[i] > 0.0) r.at(i, i) = 1.0;
    for (std::size_t j = 0; j < i; ++j) {
      const double above = c.at(j, i), below = c.at(i, j), size = sigmas[i] * sigmas[j];
      if (std::abs(above - below) > slack * eps * std::max(size, std::abs(above)))
        refuse(place(j, i) + number_text(above) + " and " + place(i, j) + number_text(below) +
               " must be equal");
      if (size == 0.0 && above != 0.0)
        refuse(place(j, i) + number_text(above) + " must be 0 beside a variance of 0");
      if (size > 0.0) r.at(i, j) = r.at(j, i) = (0.5 * (above + below) / sigmas[i]) / sigmas[j];
    }
  }
  return r;
}

void require_positive(const Square& r) {
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic>;
  const auto n = static_cast<Eigen::Index>(r.n);
  const Matrix matrix = Eigen::Map<const Matrix>(r.entries.data(), n, n);
  const double least =
      Eigen::SelfAdjointEigenSolver<Matrix>(matrix, Eigen::EigenvaluesOnly).eigenvalues()[0];
  if (!(least >= -slack * static_cast<double>(r.n) * eps))
    refuse("the least eigenvalue of the correlations, " + polhode::detail::rounded_text(least) +
           ", must not be negative");
}

// Cholesky's factor, column by column: the next column is that of the largest variance left, the
// first of equal ones, until none is left but roundings. Plain sums, so that it has the same bits
// everywhere, which eigenvectors have not: their signs are the solver's.
std::vector<double> factor_of(Square r) {
  std::vector<double> factor;
  for (std::size_t k = 0; k < r.n; ++k) {
    std::size_t p = 0;
    for (std::size_t i = 1; i < r.n; ++i)
      if (r.at(i, i) > r.at(p, p)) p = i;
    const double left = r.at(p, p);
    if (left <= slack * static_cast<double>(r.n) * eps) break;
    std::vector<double> column(r.n);
    for (std::size_t i = 0; i < r.n; ++i) column[i] = r.at(i, p) / std::sqrt(left);
    for (std::size_t i = 0; i < r.n; ++i)
      for (std::size_t j = 0; j < r.n; ++j)
        r.at(i, j) = i == p || j == p ? 0.0 : r.at(i, j) - column[i] * column[j];
    factor.insert(factor.end(), column.begin(), column.end());
  }
  return factor;
}

}  // namespace

JointNormal::JointNormal(std::vector<double> mean, std::vector<double> covariance)
    : mean_(std::move(mean)), covariance_(std::move(covariance)) {
  require_numbers(mean_, covariance_);
  const Square c{size(), covariance_};
  require_variances(c);
  std::vector<double> sigmas(size());
  for (std::size_t i = 0; i < size(); ++i) sigmas[i] = std::sqrt(c.at(i, i));
  const Square r = correlations(c, sigmas);
  require_positive(r);
  factor_ = factor_of(r);
  for (std::size_t i = 0; i < factor_.size(); ++i) factor_[i] *= sigmas[i % size()];
}

void JointNormal::from_uniform(std::span<const double> u, std::span<double> x) const {
  const std::size_t n = size();
  std::copy(mean_.begin(), mean_.end(), x.begin());
  for (std::size_t k = 0; k * n < factor_.size(); ++k) {
    const double z = normal_quantile(u[k]);
    for (std::size_t i = 0; i < n; ++i) x[i] += factor_[k * n + i] * z;
  }
}

namespace {

// A rational function with numerator and denominator of degree 7, by pairs of terms.
struct Rational {
  double n[8], d[8];

  static double sum(const double (&c)[8], double x) {
    const double x2 = x * x, x4 = x2 * x2;
    return ((c[0] + c[1] * x) + x2 * (c[2] + c[3] * x)) +
           x4 * ((c[4] + c[5] * x) + x2 * (c[6] + c[7] * x));
  }
  double at(double x) const { return sum(n, x) / sum(d, x); }
};

// Wichura, algorithm AS 241 (PPND16), Applied Statistics 37 (1988) 477: |u - 1/2| <= 0.425, then
// sqrt(-ln u) up to 5, and up to 27.
constexpr Rational middle{
    {3.3871328727963666080e0, 1.3314166789178437745e2, 1.9715909503065514427e3,
     1.3731693765509461125e4, 4.5921953931549871457e4, 6.7265770927008700853e4,
     3.3430575583588128105e4, 2.5090809287301226727e3},
    {1.0, 4.2313330701600911252e1, 6.8718700749205790830e2, 5.3941960214247511077e3,
     2.1213794301586595867e4, 3.9307895800092710610e4, 2.8729085735721942674e4,
     5.2264952788528545610e3}};
constexpr Rational tail{
    {1.42343711074968357734e0, 4.63033784615654529590e0, 5.76949722146069140550e0,
     3.64784832476320460504e0, 1.27045825245236838258e0, 2.41780725177450611770e-1,
     2.27238449892691845833e-2, 7.74545014278341407640e-4},
    {1.0, 2.05319162663775882187e0, 1.67638483018380384940e0, 6.89767334985100004550e-1,
     1.48103976427480074590e-1, 1.51986665636164571966e-2, 5.47593808499534494600e-4,
     1.05075007164441684324e-9}};
constexpr Rational far_tail{
    {6.65790464350110377720e0, 5.46378491116411436990e0, 1.78482653991729133580e0,
     2.96560571828504891230e-1, 2.65321895265761230930e-2, 1.24266094738807843860e-3,
     2.71155556874348757815e-5, 2.01033439929228813265e-7},
    {1.0, 5.99832206555887937690e-1, 1.36929880922735805310e-1, 1.48753612908506148525e-2,
     7.86869131145613259100e-4, 1.84631831751005468180e-5, 1.42151175831644588870e-7,
     2.04426310338993978564e-15}};

}  // namespace

double normal_quantile(double u) {
  using One = Pack<InstructionSet::baseline>;  // its logarithm has the same bits on any machine
  const double q = u - 0.5;
  if (std::abs(q) <= 0.425) return q * middle.at(0.180625 - q * q);
  const double least = q < 0.0 ? u : 1.0 - u;
  if (!(least >= std::numeric_limits<double>::min()))
    return std::numeric_limits<double>::quiet_NaN();
  const double r = std::sqrt(-log_of(One(least)).lanes[0]);
  const double size = r <= 5.0 ? tail.at(r - 1.6) : far_tail.at(r - 5.0);
  return q < 0.0 ? -size : size;
}

}  // namespace ensemble
}  // namespace v0
}  // namespace polhode
