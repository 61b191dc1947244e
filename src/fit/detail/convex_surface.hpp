// SPDX-License-Identifier: MIT
// A convex body by the coefficients of its Gaussian image, with what regularises them.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "fit/detail/surface_residuals.hpp"
#include "polhode/fit/convex_fit.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

class ConvexSurface {
 public:
  struct Shape {
    std::vector<double> areas;
  };

  // Own unknowns: coefficients but the first, which stays; `usual`, from which they depart
  // smoothly.
  ConvexSurface(const GaussianImage& image, std::vector<double> usual, const ConvexFit& fit);

  std::size_t own() const { return usual_.size() - 1; }
  Shape shape_at(std::span<const double> own) const { return {image_.areas(coefficients(own))}; }
  std::vector<double> coefficients(std::span<const double> own) const;
  double brightness(const Shape& shape, const Scattering& law, const Vec3& s, const Vec3& o) const;
  BrightnessGradient gradient(const Shape& shape, const Scattering& law, const Vec3& s,
                              const Vec3& o, std::span<double> own_row) const;

  // Closure, products of the area tensor, roughness.
  std::size_t priors() const { return 6 + own(); }
  void prior_numbers(const Shape& shape, std::span<const double> own, std::span<double> numbers,
                     double* rows) const;

 private:
  // sum A_j value_j / (sum A_j error), and its derivatives.
  double mean(const Shape& shape, std::span<const double> values, double error, double* row) const;

  GaussianImage image_;
  std::vector<double> usual_, rough_;
  std::vector<std::vector<double>> along_;  // n_x, n_y, n_z, n_x n_y, n_y n_z, n_x n_z
  double closure_error_, axes_error_, roughness_error_;
};

using ConvexResiduals = SurfaceResiduals<ConvexSurface>;

std::vector<std::string> coefficient_names(int degree);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
