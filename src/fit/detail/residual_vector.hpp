// SPDX-License-Identifier: MIT
// All numbers whose squares are minimised: data under their loss, then priors.
#pragma once

#include <cstddef>
#include <vector>

#include "polhode/fit/least_squares.hpp"

namespace polhode {
inline namespace v0 {
namespace fit {
namespace detail {

class ResidualVector {
 public:
  explicit ResidualVector(const LeastSquares& problem);

  std::size_t data() const { return problem_->residuals.data; }
  std::size_t size() const { return size_; }
  std::size_t unknowns() const { return problem_->unknowns.size(); }

  // What the derivatives are for: those of the numbers themselves, or of numbers whose squares have
  // the weights that the loss leaves (for covariances).
  enum class Derivatives { exact, weighted };
  // At x; the derivatives row by row where `jacobian` is not null. False: no value.
  bool at(const std::vector<double>& x, double* numbers, double* jacobian,
          Derivatives which = Derivatives::exact) const;
  // Residuals as they were given, data and then priors.
  bool given(const std::vector<double>& x, std::vector<double>& numbers) const;

 private:
  struct Whitened {
    std::vector<std::size_t> unknowns;
    std::vector<double> mean;
    std::vector<double> root;  // the inverse of the Cholesky factor of the covariance, row by row
  };
  void add_prior(const NormalPrior& prior);
  void weigh(std::size_t first, std::size_t count, double* numbers, double* jacobian,
             Derivatives which) const;

  const LeastSquares* problem_;
  std::vector<Whitened> priors_;
  std::size_t size_ = 0;
};

}  // namespace detail
}  // namespace fit
}  // namespace v0
}  // namespace polhode
