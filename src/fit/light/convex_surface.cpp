// SPDX-License-Identifier: MIT
#include "fit/detail/convex_surface.hpp"

#include <algorithm>
#include <numeric>
#include <string>

#include "polhode/light/patch_brightness.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

ConvexSurface::ConvexSurface(const GaussianImage& image, std::vector<double> usual,
                             const ConvexFit& fit)
    : image_(image),
      usual_(std::move(usual)),
      rough_(image.roughness()),
      along_(6),
      closure_error_(fit.closure_error),
      axes_error_(fit.axes_error),
      roughness_error_(fit.roughness_error) {
  for (const Vec3& n : image.normals()) {
    const double values[6] = {n.x, n.y, n.z, n.x * n.y, n.y * n.z, n.x * n.z};
    for (std::size_t k = 0; k < 6; ++k) along_[k].push_back(values[k]);
  }
}

std::vector<double> ConvexSurface::coefficients(std::span<const double> own) const {
  std::vector<double> c{usual_.front()};
  c.insert(c.end(), own.begin(), own.end());
  return c;
}

double ConvexSurface::brightness(const Shape& shape, const Scattering& law, const Vec3& s,
                                 const Vec3& o) const {
  return patch_brightness<double>(image_.normals(), image_.widths(), shape.areas, law, s, o);
}

BrightnessGradient ConvexSurface::gradient(const Shape& shape, const Scattering& law, const Vec3& s,
                                           const Vec3& o, std::span<double> own_row) const {
  const FacetGradient g = patch_gradient(image_.normals(), image_.widths(), shape.areas, law, s, o);
  const std::vector<double> by = image_.by_coefficients(g.by_areas, shape.areas);
  std::copy(by.begin() + 1, by.end(), own_row.begin());
  return static_cast<const BrightnessGradient&>(g);
}

double ConvexSurface::mean(const Shape& shape, std::span<const double> values, double error,
                           double* row) const {
  const std::vector<double>& A = shape.areas;
  const double total = std::accumulate(A.begin(), A.end(), 0.0);
  const double value = std::inner_product(A.begin(), A.end(), values.begin(), 0.0) / total;
  if (row != nullptr) {
    std::vector<double> by_areas;
    for (const double v : values) by_areas.push_back((v - value) / (total * error));
    const std::vector<double> by = image_.by_coefficients(by_areas, A);
    std::copy(by.begin() + 1, by.end(), row);
  }
  return value / error;
}

void ConvexSurface::prior_numbers(const Shape& shape, std::span<const double> own_numbers,
                                  std::span<double> numbers, double* rows) const {
  const auto row = [&](std::size_t k) { return rows == nullptr ? nullptr : rows + k * own(); };
  for (std::size_t k = 0; k < 6; ++k)
    numbers[k] = mean(shape, along_[k], k < 3 ? closure_error_ : axes_error_, row(k));
  for (std::size_t k = 0; k < own(); ++k) {
    const double slope = rough_[k + 1] / roughness_error_;
    numbers[6 + k] = slope * (own_numbers[k] - usual_[k + 1]);
    if (rows == nullptr) continue;
    std::fill_n(row(6 + k), own(), 0.0);
    row(6 + k)[k] = slope;
  }
}

std::vector<std::string> coefficient_names(int degree) {
  std::vector<std::string> names;
  for (int l = 0; l <= degree; ++l)
    for (int m = -l; m <= l; ++m)
      names.push_back("c_" + std::to_string(l) + "_" + std::to_string(m));
  return names;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
