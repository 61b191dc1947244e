// SPDX-License-Identifier: MIT
#include "polhode/ensemble/distributions.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>

#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/math/pack_functions.hpp"

namespace polhode {
inline namespace v0 {
namespace {

using detail::number_text;
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

}  // namespace v0
}  // namespace polhode
