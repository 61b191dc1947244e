// SPDX-License-Identifier: MIT
// Brightness with its gradient: of ellipsoids, of facets and patches, and of meshes that shade
// themselves.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "math/gauss_legendre.hpp"
#include "polhode/error.hpp"
#include "polhode/light/facet_brightness.hpp"
#include "polhode/light/lommel_seeliger.hpp"
#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {
namespace light {

namespace {

// Component by component.
constexpr Vec3 product(const Vec3& a, const Vec3& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }

struct Direction {
  double inverse_length;
  Vec3 unit;

  explicit Direction(const Vec3& v)
      : inverse_length(1.0 / std::sqrt(dot(v, v))), unit(inverse_length * v) {}

  Vec3 by_vector(const Vec3& by_unit) const {
    return inverse_length * (by_unit - dot(unit, by_unit) * unit);
  }
};

template <int points>
detail::LatitudeRule<points> made_rule() {
  constexpr auto count = static_cast<std::size_t>(points);
  const GaussRule<double, count> gauss = gauss_legendre<double, count>();
  detail::LatitudeRule<points> rule{};
  rule.x = gauss.x;
  rule.w = gauss.w;
  const double quarter = 0.5 * pi<double>();
  for (std::size_t i = 0; i < count; ++i) {
    rule.sine[i] = std::sin(quarter * gauss.x[i]);
    rule.cosine[i] = std::cos(quarter * gauss.x[i]);
    rule.weight[i] = quarter * gauss.w[i] * rule.cosine[i];
  }
  return rule;
}

// Of both laws, weighed.
EllipsoidGradient weighed(const EllipsoidGradient& first, double k, const EllipsoidGradient& second,
                          double l) {
  EllipsoidGradient out;
  out.value = k * first.value + l * second.value;
  out.by_sun = k * first.by_sun + l * second.by_sun;
  out.by_observer = k * first.by_observer + l * second.by_observer;
  out.by_single = first.value;
  out.by_multiple = second.value;
  out.by_axes = k * first.by_axes + l * second.by_axes;
  return out;
}

}  // namespace

namespace detail {

template <int points>
const LatitudeRule<points>& latitude_rule() {
  static const LatitudeRule<points> rule = made_rule<points>();
  return rule;
}

}  // namespace detail

template <int points>
EllipsoidGradient lambert_gradient(const Ellipsoid& body, const Vec3& to_sun,
                                   const Vec3& to_observer) {
  const Vec3 axes{body.a, body.b, body.c};
  const Vec3 inverse{1.0 / body.a, 1.0 / body.b, 1.0 / body.c};
  const Vec3 root{std::sqrt(inverse.x), std::sqrt(inverse.y), std::sqrt(inverse.z)};
  const Direction sun(to_sun), observer(to_observer);
  const Vec3 s = product(root, sun.unit), o = product(root, observer.unit);
  double sum = 0.0;
  Vec3 by_s, by_o;   // of the integral, by s' and o'
  Vec3 power, area;  // integrals of integrand v^2 / (v.R^2 v) and v^2 / (v.R^-2 v)
  detail::for_lune_points<points>(s, o, [&](const Vec3& v, double weight) {
    const Vec3 squares = product(v, v);
    const double U = 1.0 / dot(axes, squares), W = 1.0 / dot(inverse, squares);
    const double g = weight * U * U * std::sqrt(W);
    const double lit = dot(v, s), seen = dot(v, o), f = g * lit * seen;
    sum += f;
    by_s = by_s + (g * seen) * v;
    by_o = by_o + (g * lit) * v;
    power = power + (f * U) * squares;
    area = area + (f * W) * squares;
  });
  const double volume = 1.0 / (root.x * root.y * root.z);
  const double K = volume * volume * volume;
  EllipsoidGradient out;
  out.value = out.by_multiple = K * sum;
  out.by_sun = sun.by_vector(K * product(root, by_s));
  out.by_observer = observer.by_vector(K * product(root, by_o));
  // of the factor, of s' and o', of both denominators
  const Vec3 sums{1.5 * sum, 1.5 * sum, 1.5 * sum};
  const Vec3 turned = 0.5 * (product(s, by_s) + product(o, by_o));
  const Vec3 denominators = 0.5 * product(product(inverse, inverse), area) - 2.0 * power;
  out.by_axes = K * (product(inverse, sums - turned) + denominators);
  return out;
}

template <int points>
EllipsoidGradient brightness_gradient(const Ellipsoid& body, const Scattering& law,
                                      const Vec3& to_sun, const Vec3& to_observer) {
  const EllipsoidGradient first = lommel_seeliger_gradient(body, to_sun, to_observer);
  if (law.multiple == 0.0) return weighed(first, law.single, {}, 0.0);
  return weighed(first, law.single, lambert_gradient<points>(body, to_sun, to_observer),
                 law.multiple);
}

#define POLHODE_POINTS(points)                                                                     \
  template const detail::LatitudeRule<points>& detail::latitude_rule<points>();                    \
  template EllipsoidGradient lambert_gradient<points>(const Ellipsoid&, const Vec3&, const Vec3&); \
  template EllipsoidGradient brightness_gradient<points>(const Ellipsoid&, const Scattering&,      \
                                                         const Vec3&, const Vec3&);
POLHODE_POINTS(8)
POLHODE_POINTS(16)
POLHODE_POINTS(32)
POLHODE_POINTS(64)
#undef POLHODE_POINTS

// The letters of lommel_seeliger_brightness: B = p F / sum, with dp/dS = o q, dp/dO = s q, de/dS =
// 2 o d / sum^2 - 2 e u / sum, de/dO = -2 s d / sum^2 - 2 e v / sum.
EllipsoidGradient lommel_seeliger_gradient(const Ellipsoid& body, const Vec3& to_sun,
                                           const Vec3& to_observer) {
  const Vec3 inverse{1.0 / body.a, 1.0 / body.b, 1.0 / body.c};
  const Direction sun(to_sun), observer(to_observer);
  const Vec3 S = product(inverse, sun.unit), O = product(inverse, observer.unit), V = S + O;
  const double s = std::sqrt(dot(S, S)), o = std::sqrt(dot(O, O));
  const Vec3 u = (1.0 / s) * S, v = (1.0 / o) * O;
  const Vec3 q = u + v, d = u - v;
  const double so = s * o, inverse_sum = 1.0 / (s + o), inverse_square = inverse_sum * inverse_sum;
  const double p = 0.5 * so * dot(q, q);
  const double e = so * dot(d, d) * inverse_square;
  const auto [F, slope] = detail::lune_slope(dot(V, V) * inverse_square, e);
  const double B = p * F * inverse_sum;
  const double K = 0.5 * pi<double>() * body.a * body.b * body.c;

  const double along_q = F * inverse_sum, by_e = p * slope * inverse_sum;
  const double along_d = 2.0 * by_e * inverse_square;
  const double along_own = (B + 2.0 * e * by_e) * inverse_sum;
  const Vec3 by_S = o * (along_q * q + along_d * d) - along_own * u;
  const Vec3 by_O = s * (along_q * q - along_d * d) - along_own * v;

  EllipsoidGradient out;
  out.value = out.by_single = K * B;
  out.by_sun = sun.by_vector(K * product(inverse, by_S));
  out.by_observer = observer.by_vector(K * product(inverse, by_O));
  const Vec3 stretched = product(S, by_S) + product(O, by_O);
  out.by_axes = product(inverse, K * (Vec3{B, B, B} - stretched));
  return out;
}

void require_areas(std::span<const Vec3> normals, std::size_t areas) {
  if (normals.size() == areas) return;
  throw DomainError("facet_brightness: " + std::to_string(areas) + " areas for " +
                    std::to_string(normals.size()) + " normals; expected one for each");
}

FacetGradient facet_gradient(std::span<const Vec3> normals, std::span<const double> areas,
                             const Scattering& law, const Vec3& to_sun, const Vec3& to_observer) {
  require_areas(normals, areas.size());
  const Direction sun(to_sun), observer(to_observer);
  FacetGradient out;
  out.by_areas.assign(areas.size(), 0.0);
  Vec3 by_s, by_o;
  for (std::size_t j = 0; j < normals.size(); ++j) {
    const double mu = dot(normals[j], observer.unit), mu0 = dot(normals[j], sun.unit);
    if (mu <= 0.0 || mu0 <= 0.0) continue;
    const double part = mu / (mu + mu0), part0 = mu0 / (mu + mu0);
    const double first = mu * part0, second = mu * mu0;
    const double S = law.single * first + law.multiple * second;
    out.by_areas[j] = S;
    out.value += areas[j] * S;
    out.by_single += areas[j] * first;
    out.by_multiple += areas[j] * second;
    // d(mu mu0 / (mu + mu0)) = part0^2 dmu + part^2 dmu0
    by_o = by_o + (areas[j] * (law.single * part0 * part0 + law.multiple * mu0)) * normals[j];
    by_s = by_s + (areas[j] * (law.single * part * part + law.multiple * mu)) * normals[j];
  }
  out.by_sun = sun.by_vector(by_s);
  out.by_observer = observer.by_vector(by_o);
  return out;
}

namespace {

using SoftCosine = BasicSoftCosine<double>;

// Most facets that are lit are so beyond their width.
SoftCosine soft(double mu, double h) {
  return mu < h ? SoftCosine::at(mu, h) : SoftCosine{mu, mu, 1.0, 1.0};
}

}  // namespace

void require_widths(std::span<const Vec3> normals, std::size_t widths) {
  if (normals.size() == widths) return;
  throw DomainError("patch_brightness: " + std::to_string(widths) + " widths for " +
                    std::to_string(normals.size()) + " normals; expected one for each");
}

FacetGradient patch_gradient(std::span<const Vec3> normals, std::span<const double> widths,
                             std::span<const double> areas, const Scattering& law,
                             const Vec3& to_sun, const Vec3& to_observer) {
  require_areas(normals, areas.size());
  require_widths(normals, widths.size());
  const Direction sun(to_sun), observer(to_observer);
  FacetGradient out;
  out.by_areas.assign(areas.size(), 0.0);
  Vec3 by_s, by_o;
  for (std::size_t j = 0; j < normals.size(); ++j) {
    const double h = widths[j];
    const double mu = dot(normals[j], observer.unit), mu0 = dot(normals[j], sun.unit);
    if (mu <= -h || mu0 <= -h) continue;                 // with all derivatives
    const SoftCosine a = soft(mu, h), b = soft(mu0, h);  // M > 0 each
    const double inverse = 1.0 / (a.positive + b.positive);
    const double second = a.even * b.even, first = second * inverse;
    const double S = law.single * first + law.multiple * second;
    out.by_areas[j] = S;
    out.value += areas[j] * S;
    out.by_single += areas[j] * first;
    out.by_multiple += areas[j] * second;
    const double both = law.single * inverse + law.multiple;
    const double by_sum = law.single * first * inverse;
    by_o =
        by_o + (areas[j] * (both * b.even * a.even_slope - by_sum * a.positive_slope)) * normals[j];
    by_s =
        by_s + (areas[j] * (both * a.even * b.even_slope - by_sum * b.positive_slope)) * normals[j];
  }
  out.by_sun = sun.by_vector(by_s);
  out.by_observer = observer.by_vector(by_o);
  return out;
}

namespace {

// What stands above a plane by less than this part of the size of the body lies in it.
constexpr double flat = 1e-12;

using Corners = std::array<Vec3, 3>;

Corners corners(const shape::FacetShape& shape, std::size_t facet) {
  const shape::FacetShape::Triangle& t = shape.triangles()[facet];
  return {shape.vertices()[t[0]], shape.vertices()[t[1]], shape.vertices()[t[2]]};
}

double size_of(const shape::FacetShape& shape) {
  const Vec3& origin = shape.vertices().front();
  double square = 0.0;
  for (const Vec3& v : shape.vertices()) square = std::max(square, dot(v - origin, v - origin));
  return std::sqrt(square);
}

// Whether the ray from x along d, ahead of x, meets the triangle.
bool meets(const Vec3& x, const Vec3& d, const Corners& at) {
  const Vec3 e1 = at[1] - at[0], e2 = at[2] - at[0], p = cross(d, e2);
  const double det = dot(e1, p);
  if (det == 0.0) return false;  // along the triangle
  const Vec3 t = x - at[0], q = cross(t, e1);
  const double k = 1.0 / det, u = k * dot(t, p), v = k * dot(d, q);
  return u >= 0.0 && v >= 0.0 && u + v <= 1.0 && k * dot(e2, q) > 0.0;
}

// The sine of the highest elevation over the plane of normal n that the triangle reaches, as seen
// from x: of its inside, of an edge (the top of the great circle, where the edge has it), or of a
// corner.
double highest(const Vec3& x, const Vec3& n, const Corners& at) {
  if (meets(x, n, at)) return 1.0;
  double sine = -1.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 p = at[k] - x, q = at[(k + 1) % 3] - x, m = cross(p, q);
    sine = std::max(sine, dot(n, p) / std::sqrt(dot(p, p)));
    const double square = dot(m, m);
    if (!(square > 0.0)) continue;
    const Vec3 top = n - (dot(n, m) / square) * m;
    if (dot(cross(p, top), m) > 0.0 && dot(cross(top, q), m) > 0.0)
      sine = std::max(sine, std::sqrt(dot(top, top)));
  }
  return sine;
}

struct Obstacle {
  std::uint32_t facet;
  double width;  // square of the angle that it takes
};

// Facets with a part above the plane of facet i. Of a closed mesh those that turn their face to its
// centre: a ray goes in by one of them before it comes out again.
std::vector<Obstacle> obstacles_of(const shape::FacetShape& shape, std::size_t i, double least,
                                   bool is_closed) {
  const shape::Facet& own = shape.facets()[i];
  std::vector<Obstacle> found;
  for (std::size_t j = 0; j < shape.facets().size(); ++j) {
    if (j == i) continue;
    const shape::FacetShape::Triangle& t = shape.triangles()[j];
    double height = 0.0;
    for (const std::uint32_t k : t)
      height = std::max(height, dot(own.normal, shape.vertices()[k] - own.centre));
    if (height <= least) continue;
    const shape::Facet& other = shape.facets()[j];
    const Vec3 way = own.centre - other.centre;
    const double turned = dot(other.normal, way);
    if (is_closed && turned <= 0.0) continue;
    const double square = dot(way, way);
    found.push_back({static_cast<std::uint32_t>(j),
                     other.area * std::fabs(turned) / (square * std::sqrt(square))});
  }
  std::sort(found.begin(), found.end(), [](const Obstacle& a, const Obstacle& b) {
    return a.width != b.width ? a.width > b.width : a.facet < b.facet;
  });
  return found;
}

}  // namespace

ShadedMesh::ShadedMesh(shape::FacetShape shape) : shape_(std::move(shape)) {
  const std::size_t count = shape_.facets().size();
  const double least = flat * size_of(shape_);
  const bool is_closed = shape_.is_closed();
  Sky sky{{0}, {}, std::vector<double>(count, 0.0)};
  for (std::size_t i = 0; i < count; ++i) {
    const shape::Facet& own = shape_.facets()[i];
    for (const Obstacle& o : obstacles_of(shape_, i, least, is_closed)) {
      sky.above.push_back(o.facet);
      const double sine = highest(own.centre, own.normal, corners(shape_, o.facet));
      sky.horizon[i] = std::max(sky.horizon[i], sine);
    }
    sky.first.push_back(sky.above.size());
  }
  sky_ = std::make_shared<const Sky>(std::move(sky));
}

bool ShadedMesh::is_free(std::size_t i, const Vec3& direction) const {
  const shape::Facet& own = shape_.facets()[i];
  constexpr double margin = 1e-9;  // of the horizon, which has roundings
  if (dot(own.normal, direction) > sky_->horizon[i] + margin) return true;
  for (std::size_t k = sky_->first[i]; k < sky_->first[i + 1]; ++k)
    if (meets(own.centre, direction, corners(shape_, sky_->above[k]))) return false;
  return true;
}

double ShadedMesh::brightness(const Scattering& law, const Vec3& to_sun,
                              const Vec3& to_observer) const {
  const Vec3 s = Direction(to_sun).unit, o = Direction(to_observer).unit;
  double sum = 0.0;
  for (std::size_t i = 0; i < shape_.facets().size(); ++i) {
    const shape::Facet& f = shape_.facets()[i];
    const double mu = dot(f.normal, o), mu0 = dot(f.normal, s);
    if (mu <= 0.0 || mu0 <= 0.0) continue;  // NaN goes on
    if (obstacles(i) > 0 && !(is_free(i, s) && is_free(i, o))) continue;
    sum += f.area * law.at(mu, mu0);
  }
  return sum;
}

bool is_convex(const shape::FacetShape& shape) {
  const double least = flat * size_of(shape);
  for (const shape::Facet& f : shape.facets())
    for (const Vec3& v : shape.vertices())
      if (dot(f.normal, v - f.centre) > least) return false;
  return shape.is_closed();
}

}  // namespace light
}  // namespace v0
}  // namespace polhode
