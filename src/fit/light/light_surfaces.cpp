// SPDX-License-Identifier: MIT
// Shapes that scatter light: an ellipsoid by ratios of its axes, a convex body by its Gaussian
// image, a given mesh.
#include "fit/detail/light_surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "fit/detail/light_residuals.hpp"
#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/light/facet_brightness.hpp"
#include "polhode/light/lommel_seeliger.hpp"
#include "polhode/shape/mass_properties.hpp"

namespace polhode {
inline namespace v0 {
namespace fit {

ConvexShape ConvexShape::of(const light::Ellipsoid& e, int degree, int rows) {
  for (const double axis : {e.a, e.b, e.c})
    if (!(axis > 0.0) || !std::isfinite(axis))
      throw DomainError("ConvexShape: semi-axis " + polhode::detail::number_text(axis) +
                        " must be above 0");
  const light::GaussianImage image(degree, rows);
  return {image, image.coefficients(light::Ellipsoid{e.a / e.b, 1.0, e.c / e.b})};
}

shape::FacetShape ConvexShape::mesh() const { return light::convex_body(image.normals(), areas()); }

LightModel LightModel::homogeneous(double t0, const Quaternion& q, const Vec3& w_F,
                                   const light::Ellipsoid& shape, const light::Scattering& law) {
  const Vec3 I = light::homogeneous_moments(shape, 1.0);
  return {{t0, q, w_F, detail::inertia_of({I.x / I.z, I.y / I.z})}, shape, law};
}

Mat3 homogeneous_inertia(const shape::FacetShape& shape) {
  Mat3 T = shape::mass_properties(shape, 1.0).inertia;
  const double unit = T(2, 2);
  for (Vec3& row : T.row) row = (1.0 / unit) * row;
  return T;
}

light::Ellipsoid ellipsoid_of_moments(const Mat3& inertia) {
  const Vec3 I = Body::from_tensor(inertia).moments();
  double all[3] = {I.x, I.y, I.z};
  std::ranges::sort(all);
  const light::Ellipsoid e = light::homogeneous_ellipsoid(Vec3{all[0], all[1], all[2]}, 1.0);
  return {1.0, e.b / e.a, e.c / e.a};
}

ShapeInertia shape_inertia(const ConvexShape& shape) {
  const Mat3 T = shape::mass_properties(shape.mesh(), 1.0).inertia;
  const Quaternion q = Body::from_tensor(T).q_FB();
  return {T(0, 0) / T(2, 2), T(1, 1) / T(2, 2), norm(attitude_residual({}, normalized(q)))};
}

namespace detail {

EllipsoidSurface::EllipsoidSurface(const LightFit& fit, const LightModel& body)
    : start_(body.ellipsoid()), is_free_(fit.unknowns.shape), moments_(fit.unknowns.moments) {}

std::vector<Unknown> EllipsoidSurface::own_unknowns(const LightShape& at) const {
  if (!is_free_) return {};
  const light::Ellipsoid& e = std::get<light::Ellipsoid>(at);
  const double high = moments_ == MomentSource::shape ? 1.0 : 1.0 / least_axis_ratio;
  const auto ratio = [&](const char* name, double value) -> Unknown {
    return {name, std::clamp(value, least_axis_ratio, high), least_axis_ratio, high};
  };
  return {ratio("b/a", e.b / e.a), ratio("c/b", e.c / e.b)};
}

light::Ellipsoid EllipsoidSurface::shape_at(std::span<const double> own) const {
  if (!is_free_) return {1.0, start_.b / start_.a, start_.c / start_.a};
  return {1.0, own[0], own[0] * own[1]};
}

double EllipsoidSurface::brightness(const light::Ellipsoid& shape, const light::Scattering& law,
                                    const Vec3& s, const Vec3& o) const {
  return light::brightness(shape, law, s, o);
}

light::BrightnessGradient EllipsoidSurface::gradient(const light::Ellipsoid& shape,
                                                     const light::Scattering& law, const Vec3& s,
                                                     const Vec3& o,
                                                     std::span<double> own_row) const {
  const light::EllipsoidGradient g = light::brightness_gradient(shape, law, s, o);
  if (is_free_) {
    own_row[0] = g.by_axes.y;
    own_row[1] = g.by_axes.z;
  }
  return static_cast<const light::BrightnessGradient&>(g);
}

MomentRatios EllipsoidSurface::moments(const light::Ellipsoid& shape,
                                       std::span<const double>) const {
  const Vec3 I = light::homogeneous_moments(shape, 1.0);
  return {I.x / I.z, I.y / I.z};
}

void EllipsoidSurface::finish_row(const light::Ellipsoid& shape, const MomentRatios& by,
                                  std::span<double> own_row) const {
  if (!is_free_) return;
  const double b = shape.b, c = shape.c;
  double by_b = own_row[0], by_c = own_row[1];
  if (moments_follow()) {
    // Ixx/Izz = (b^2 + c^2) / (1 + b^2), Iyy/Izz = (1 + c^2) / (1 + b^2)
    const double inverse = 2.0 / (1.0 + b * b);
    const auto [X, Y] = moments(shape, {});
    by_b += inverse * b * ((1.0 - X) * by.Ixx - Y * by.Iyy);
    by_c += inverse * c * (by.Ixx + by.Iyy);
  }
  own_row[0] = by_b + c / b * by_c;
  own_row[1] = b * by_c;
}

namespace {

std::vector<double> without_first(std::vector<double> of_all) {
  of_all.erase(of_all.begin());
  return of_all;
}

// The usual coefficients of a fit that begins with `body`.
std::vector<double> usual_coefficients(const LightFit& fit, const ConvexShape& body) {
  const std::optional<LightModel>& given = fit.regularisation.about;
  const LightModel& about = given ? *given : fit.start;
  if (about.is_convex()) return about.convex().coefficients;
  const light::Ellipsoid& e = about.ellipsoid();
  return body.image.coefficients(light::Ellipsoid{e.a / e.b, 1.0, e.c / e.b});
}

}  // namespace

FollowedMoments FollowedMoments::at(const light::GaussianImage& image,
                                    const std::vector<double>& coefficients,
                                    const light::ConvexMoments& m) {
  const std::vector<double> A = image.areas(coefficients);
  return {m.Ixx, m.Iyy, without_first(coefficients),
          without_first(image.by_coefficients(m.Ixx_by_areas, A)),
          without_first(image.by_coefficients(m.Iyy_by_areas, A))};
}

ConvexSurface::ConvexSurface(const LightFit& fit, const LightModel& body)
    : image_(body.convex().image),
      is_free_(fit.unknowns.shape),
      start_(body.convex().coefficients),
      usual_(usual_coefficients(fit, body.convex())),
      rough_(image_.roughness()),
      along_(6),
      closure_error_(fit.regularisation.closure_error),
      axes_error_(fit.regularisation.axes_error),
      roughness_error_(fit.regularisation.roughness_error) {
  for (const Vec3& n : image_.normals()) {
    const double values[6] = {n.x, n.y, n.z, n.x * n.y, n.y * n.z, n.x * n.z};
    for (std::size_t k = 0; k < 6; ++k) along_[k].push_back(values[k]);
  }
}

ConvexSurface ConvexSurface::with(FollowedMoments followed) const {
  ConvexSurface other = *this;
  other.followed_ = std::move(followed);
  return other;
}

std::vector<Unknown> ConvexSurface::own_unknowns(const LightShape& at) const {
  std::vector<Unknown> found;
  if (!is_free_) return found;
  const std::vector<double>& c = std::get<ConvexShape>(at).coefficients;
  for (int l = 1; l <= image_.degree(); ++l)
    for (int m = -l; m <= l; ++m)
      found.push_back({.name = "c_" + std::to_string(l) + "_" + std::to_string(m),
                       .start = c[found.size() + 1]});
  return found;
}

std::vector<double> ConvexSurface::coefficients(std::span<const double> own) const {
  std::vector<double> c = start_;
  c.front() = usual_.front();
  std::ranges::copy(own, c.begin() + 1);
  return c;
}

double ConvexSurface::brightness(const Shape& shape, const light::Scattering& law, const Vec3& s,
                                 const Vec3& o) const {
  return light::patch_brightness<double>(image_.normals(), image_.widths(), shape.areas, law, s, o);
}

light::BrightnessGradient ConvexSurface::gradient(const Shape& shape, const light::Scattering& law,
                                                  const Vec3& s, const Vec3& o,
                                                  std::span<double> own_row) const {
  const light::FacetGradient g =
      light::patch_gradient(image_.normals(), image_.widths(), shape.areas, law, s, o);
  if (!is_free_) return static_cast<const light::BrightnessGradient&>(g);
  const std::vector<double> by = image_.by_coefficients(g.by_areas, shape.areas);
  std::copy(by.begin() + 1, by.end(), own_row.begin());
  return static_cast<const light::BrightnessGradient&>(g);
}

MomentRatios ConvexSurface::moments(const Shape&, std::span<const double> own) const {
  MomentRatios found{followed_.Ixx, followed_.Iyy};
  for (std::size_t k = 0; k < own.size(); ++k) {
    const double by = own[k] - followed_.own[k];
    found.Ixx += followed_.Ixx_by_own[k] * by;
    found.Iyy += followed_.Iyy_by_own[k] * by;
  }
  return found;
}

void ConvexSurface::finish_row(const Shape&, const MomentRatios& by,
                               std::span<double> own_row) const {
  for (std::size_t k = 0; moments_follow() && k < own_row.size(); ++k)
    own_row[k] += followed_.Ixx_by_own[k] * by.Ixx + followed_.Iyy_by_own[k] * by.Iyy;
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
  for (std::size_t k = 0; is_free_ && k < 6; ++k)
    numbers[k] = mean(shape, along_[k], k < 3 ? closure_error_ : axes_error_, row(k));
  for (std::size_t k = 0; k < own(); ++k) {
    const double slope = rough_[k + 1] / roughness_error_;
    numbers[6 + k] = slope * (own_numbers[k] - usual_[k + 1]);
    if (rows == nullptr) continue;
    std::fill_n(row(6 + k), own(), 0.0);
    row(6 + k)[k] = slope;
  }
}

MeshSurface::MeshSurface(const LightFit&, const LightModel& body) : mesh_(body.mesh()) {
  for (const shape::Facet& f : mesh_.shape().facets()) {
    normals_.push_back(f.normal);
    areas_.push_back(f.area);
  }
}

// The gradient of the facets which are lit and seen. At the edge of a shadow, where a facet goes
// out as a whole, the brightness has a jump and no derivative; what a finer mesh would lose there
// evenly is left out. At a terminator nothing is missing: the light of a facet is 0 there.
light::BrightnessGradient MeshSurface::gradient(const Shape&, const light::Scattering& law,
                                                const Vec3& s, const Vec3& o,
                                                std::span<double>) const {
  const auto of_lit = [&](const std::vector<double>& areas) {
    return static_cast<light::BrightnessGradient>(
        light::facet_gradient(normals_, areas, law, s, o));
  };
  if (mesh_.is_shadowless()) return of_lit(areas_);
  const Vec3 sun = (1.0 / norm(s)) * s, observer = (1.0 / norm(o)) * o;
  std::vector<double> lit = areas_;
  for (std::size_t i = 0; i < lit.size(); ++i) {
    const bool faces = dot(normals_[i], sun) > 0.0 && dot(normals_[i], observer) > 0.0;
    if (!faces || mesh_.obstacles(i) == 0) continue;
    if (!mesh_.is_free(i, sun) || !mesh_.is_free(i, observer)) lit[i] = 0.0;
  }
  return of_lit(lit);
}

}  // namespace detail
}  // namespace fit
}  // namespace v0
}  // namespace polhode
