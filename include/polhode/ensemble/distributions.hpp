// SPDX-License-Identifier: MIT
// Distributions of one number and of several, of directions and of attitudes. Each is a function of
// uniform numbers in (0, 1), so that random numbers and Sobol points go the same way.
//
// Equations   from_uniform(u) of one number is the inverse of its distribution function; that of
//             the normal one by the rational functions of Wichura's AS 241 (1988). Several normal
//             numbers: mean + F z with F F^T the covariance. Direction: z = 2 u0 - 1 at longitude 2
//             pi u1. Attitude (Haar's measure): Shoemake (1992).
// Units       those of the arguments; a direction is a unit vector, an attitude a unit quaternion.
// Domain      u in the open interval (0, 1). Bounds of TruncatedNormal may be infinite; the
//             interval must reach within 37 sigma of the mean. A sigma of 0 is a fixed number. Of
//             several, variances may be 0 and correlations 1: what others fix is given so.
// Accuracy    budgets normal_quantile_ulp, truncated_normal and others of
//             tests/budgets/ensemble.hpp. Bits are those of plain arithmetic and square roots, the
//             same on any machine.
// Errors      DomainError names the value and what it must be; of a covariance, the entry or the
//             eigenvalue.
// Cost        time/number of benchmarks/draws.cpp; n normal numbers take n^2 multiplications.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "polhode/math/quaternion.hpp"
#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {
namespace ensemble {

// The standard normal number with the probability u below it; NaN outside [2.3e-308, 1).
double normal_quantile(double u);

class Uniform {
 public:
  Uniform(double low, double high);
  double low() const { return low_; }
  double high() const { return high_; }
  double from_uniform(double u) const;

 private:
  double low_, high_;
};

// Its logarithm is uniform; high / low up to 1e300.
class LogUniform {
 public:
  LogUniform(double low, double high);
  double low() const { return low_; }
  double high() const { return high_; }
  double from_uniform(double u) const;

 private:
  double low_, high_;
  double log_ratio_;  // ln(high / low)
};

class Normal {
 public:
  Normal(double mean, double sigma);  // sigma 0 is a fixed number
  double mean() const { return mean_; }
  double sigma() const { return sigma_; }
  double from_uniform(double u) const { return mean_ + sigma_ * normal_quantile(u); }

 private:
  double mean_, sigma_;
};

// The normal numbers that lie between two bounds.
class TruncatedNormal {
 public:
  TruncatedNormal(double mean, double sigma, double low, double high);
  double mean() const { return mean_; }
  double sigma() const { return sigma_; }
  double low() const { return low_; }
  double high() const { return high_; }
  double from_uniform(double u) const;

 private:
  double mean_, sigma_, low_, high_;
  // Turned about the mean where both bounds are above it, so that small probabilities stay exact.
  bool turned_;
  double below_, within_, above_;  // probabilities
};

// Normal numbers with a covariance.
class JointNormal {
 public:
  // Row by row, n^2 numbers for a mean of n.
  JointNormal(std::vector<double> mean, std::vector<double> covariance);
  std::size_t size() const { return mean_.size(); }
  const std::vector<double>& mean() const { return mean_; }
  const std::vector<double>& covariance() const { return covariance_; }
  // x = mean + F z, by as many uniform numbers.
  void from_uniform(std::span<const double> u, std::span<double> x) const;

 private:
  std::vector<double> mean_, covariance_;
  std::vector<double> factor_;  // column by column; those that would be 0 are left out
};

// All directions alike.
struct IsotropicDirection {
  Vec3 from_uniform(double u0, double u1) const;
};

// All attitudes alike: Haar's measure on rotations. q and -q are drawn alike.
struct UniformAttitude {
  Quaternion from_uniform(double u0, double u1, double u2) const;
};

}  // namespace ensemble
}  // namespace v0
}  // namespace polhode
