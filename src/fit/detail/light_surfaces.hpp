// SPDX-License-Identifier: MIT
// The shapes that fits of light curves know, each as a Surface of light_residuals.hpp.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "polhode/fit/least_squares.hpp"
#include "polhode/fit/light_fit.hpp"
#include "polhode/light/convex_body.hpp"
#include "polhode/light/facet_brightness.hpp"

namespace polhode {
inline namespace v0 {
namespace fit {
namespace detail {

// Ixx and Iyy over Izz.
struct MomentRatios {
  double Ixx, Iyy;
};

class EllipsoidSurface {
 public:
  using Shape = light::Ellipsoid;
  static constexpr bool own_first = true;
  static constexpr double least_axis_ratio = 0.05;

  EllipsoidSurface(const LightFit& fit, const LightModel& body);

  std::size_t own() const { return is_free_ ? 2 : 0; }
  std::vector<Unknown> own_unknowns(const LightShape& at) const;
  light::Ellipsoid shape_at(std::span<const double> own) const;
  static light::Ellipsoid shape_of(const LightShape& shape) {
    return std::get<light::Ellipsoid>(shape);
  }
  LightShape light_shape(std::span<const double> own) const { return shape_at(own); }
  double brightness(const light::Ellipsoid& shape, const light::Scattering& law, const Vec3& s,
                    const Vec3& o) const;
  light::BrightnessGradient gradient(const light::Ellipsoid& shape, const light::Scattering& law,
                                     const Vec3& s, const Vec3& o, std::span<double> own_row) const;

  bool moments_follow() const { return moments_ == MomentSource::shape; }
  MomentRatios moments(const light::Ellipsoid& shape, std::span<const double> own) const;
  void finish_row(const light::Ellipsoid& shape, const MomentRatios& by,
                  std::span<double> own_row) const;

  std::size_t priors() const { return 0; }
  void prior_numbers(const light::Ellipsoid&, std::span<const double>, std::span<double>,
                     double*) const {}

 private:
  light::Ellipsoid start_;
  bool is_free_;
  MomentSource moments_;
};

// Ratios of moments as a linear function of the coefficients of a convex body, about `own`; where
// that is empty they do not follow.
struct FollowedMoments {
  double Ixx = 0.0, Iyy = 0.0;
  std::vector<double> own, Ixx_by_own, Iyy_by_own;

  static FollowedMoments at(const light::GaussianImage& image,
                            const std::vector<double>& coefficients,
                            const light::ConvexMoments& moments);
};

// Its own unknowns are coefficients but the first, which is a usual one; they depart smoothly from
// these.
class ConvexSurface {
 public:
  struct Shape {
    std::vector<double> areas;
  };
  static constexpr bool own_first = false;

  ConvexSurface(const LightFit& fit, const LightModel& body);
  ConvexSurface with(FollowedMoments followed) const;
  const FollowedMoments& followed() const { return followed_; }
  const std::vector<double>& usual() const { return usual_; }

  std::size_t own() const { return is_free_ ? start_.size() - 1 : 0; }
  std::vector<Unknown> own_unknowns(const LightShape& at) const;
  Shape shape_at(std::span<const double> own) const { return {image_.areas(coefficients(own))}; }
  static Shape shape_of(const LightShape& shape) { return {std::get<ConvexShape>(shape).areas()}; }
  LightShape light_shape(std::span<const double> own) const {
    return ConvexShape{image_, coefficients(own)};
  }
  std::vector<double> coefficients(std::span<const double> own) const;
  double brightness(const Shape& shape, const light::Scattering& law, const Vec3& s,
                    const Vec3& o) const;
  light::BrightnessGradient gradient(const Shape& shape, const light::Scattering& law,
                                     const Vec3& s, const Vec3& o, std::span<double> own_row) const;

  bool moments_follow() const { return !followed_.own.empty(); }
  MomentRatios moments(const Shape& shape, std::span<const double> own) const;
  void finish_row(const Shape& shape, const MomentRatios& by, std::span<double> own_row) const;

  // Closure, products of the area tensor, roughness.
  std::size_t priors() const { return is_free_ ? 6 + own() : 0; }
  void prior_numbers(const Shape& shape, std::span<const double> own, std::span<double> numbers,
                     double* rows) const;

 private:
  // sum A_j value_j / (sum A_j error), and its derivatives.
  double mean(const Shape& shape, std::span<const double> values, double error, double* row) const;

  light::GaussianImage image_;
  bool is_free_;
  std::vector<double> start_, usual_, rough_;  // coefficients

  std::vector<std::vector<double>> along_;  // n_x, n_y, n_z, n_x n_y, n_y n_z, n_x n_z
  double closure_error_, axes_error_, roughness_error_;
  FollowedMoments followed_;
};

// A mesh as it is: nothing of it is unknown.
class MeshSurface {
 public:
  struct Shape {};
  static constexpr bool own_first = false;

  MeshSurface(const LightFit& fit, const LightModel& body);

  std::size_t own() const { return 0; }
  std::vector<Unknown> own_unknowns(const LightShape&) const { return {}; }
  Shape shape_at(std::span<const double>) const { return {}; }
  static Shape shape_of(const LightShape&) { return {}; }
  LightShape light_shape(std::span<const double>) const { return mesh_; }
  double brightness(const Shape&, const light::Scattering& law, const Vec3& s,
                    const Vec3& o) const {
    return mesh_.brightness(law, s, o);
  }
  light::BrightnessGradient gradient(const Shape&, const light::Scattering& law, const Vec3& s,
                                     const Vec3& o, std::span<double>) const;

  bool moments_follow() const { return false; }
  MomentRatios moments(const Shape&, std::span<const double>) const { return {}; }
  void finish_row(const Shape&, const MomentRatios&, std::span<double>) const {}
  std::size_t priors() const { return 0; }
  void prior_numbers(const Shape&, std::span<const double>, std::span<double>, double*) const {}

 private:
  light::ShadedMesh mesh_;
  std::vector<Vec3> normals_;
  std::vector<double> areas_;
};

}  // namespace detail
}  // namespace fit
}  // namespace v0
}  // namespace polhode
