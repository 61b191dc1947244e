// SPDX-License-Identifier: MIT
#include "polhode/shape/mass_properties.hpp"

#include <array>
#include <cmath>

#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace shape {
namespace {

// Six points of a triangle by their weights of two corners, the third weight being what is left
// next to two equal ones; exact to degree 4, weights positive.
struct TriangleRule {
  double equal[2];   // of two corners
  double other[2];   // of the third
  double weight[2];  // of each of the three points of a class; 3 (w0 + w1) = 1
};

TriangleRule six_points() {
  const double r = std::sqrt(10.0), s = std::sqrt(38.0 - 44.0 * std::sqrt(0.4));
  const double a = (8.0 - r + s) / 18.0, b = (8.0 - r - s) / 18.0;
  const double v = std::sqrt(213125.0 - 53320.0 * r);
  return {{a, b}, {1.0 - 2.0 * a, 1.0 - 2.0 * b}, {(620.0 + v) / 3720.0, (620.0 - v) / 3720.0}};
}

// Integrals over the body at density 1, of the powers of the position.
struct Powers {
  double zero = 0.0;
  Vec3 one;
  BasicMoments<double, 2> two{};
  BasicMoments<double, 3> three{};
  BasicMoments<double, 4> four{};
};

template <int degree>
void add(BasicMoments<double, degree>& sum, double weight,
         const std::array<std::array<double, 5>, 3>& power) {
  for (int c = 0; c <= degree; ++c)
    for (int b = 0; b + c <= degree; ++b)
      sum[moment_place(b, c)] +=
          weight *
          (power[0][static_cast<std::size_t>(degree - b - c)] *
           (power[1][static_cast<std::size_t>(b)] * power[2][static_cast<std::size_t>(c)]));
}

std::array<std::array<double, 5>, 3> powers_of(const Vec3& x) {
  std::array<std::array<double, 5>, 3> power{};
  for (int i = 0; i < 3; ++i) {
    auto& of = power[static_cast<std::size_t>(i)];
    of[0] = 1.0;
    for (std::size_t k = 1; k < 5; ++k) of[k] = of[k - 1] * x[i];
  }
  return power;
}

Vec3 point(const std::array<Vec3, 3>& corner, const TriangleRule& rule, std::size_t kind,
           std::size_t own) {
  return rule.other[kind] * corner[own] +
         rule.equal[kind] * (corner[(own + 1) % 3] + corner[(own + 2) % 3]);
}

// Only up to degree 1 for the centre; all from the centre on.
Powers integrals(const FacetShape& shape, const Vec3& origin, bool all) {
  const TriangleRule rule = six_points();
  Powers sum;
  for (const FacetShape::Triangle& t : shape.triangles()) {
    const std::array<Vec3, 3> corner{shape.vertices()[t[0]] - origin,
                                     shape.vertices()[t[1]] - origin,
                                     shape.vertices()[t[2]] - origin};
    const double six = dot(corner[0], cross(corner[1], corner[2]));
    sum.zero += six / 6.0;
    sum.one = sum.one + (six / 24.0) * (corner[0] + corner[1] + corner[2]);
    if (!all) continue;
    for (std::size_t kind = 0; kind < 2; ++kind) {
      for (std::size_t own = 0; own < 3; ++own) {
        const auto power = powers_of(point(corner, rule, kind, own));
        const double w = 0.5 * six * rule.weight[kind];
        add<2>(sum.two, w / 5.0, power);
        add<3>(sum.three, w / 6.0, power);
        add<4>(sum.four, w / 7.0, power);
      }
    }
  }
  return sum;
}

Vec3 middle(const FacetShape& shape) {
  Vec3 low = shape.vertices()[shape.triangles()[0][0]], high = low;
  for (const FacetShape::Triangle& t : shape.triangles()) {
    for (const std::uint32_t i : t) {
      for (int k = 0; k < 3; ++k) {
        low[k] = std::fmin(low[k], shape.vertices()[i][k]);
        high[k] = std::fmax(high[k], shape.vertices()[i][k]);
      }
    }
  }
  return 0.5 * low + 0.5 * high;
}

Mat3 tensor(const BasicMoments<double, 2>& m) {
  const double xx = m[moment_place(0, 0)], xy = m[moment_place(1, 0)], xz = m[moment_place(0, 1)];
  const double yy = m[moment_place(2, 0)], yz = m[moment_place(1, 1)], zz = m[moment_place(0, 2)];
  return {{{yy + zz, -xy, -xz}, {-xy, xx + zz, -yz}, {-xz, -yz, xx + yy}}};
}

template <std::size_t size>
std::array<double, size> scaled(std::array<double, size> m, double factor) {
  for (double& x : m) x *= factor;
  return m;
}

}  // namespace

MassProperties mass_properties(const FacetShape& shape, double density) {
  const std::string function = "mass_properties";
  if (!(density > 0.0) || !std::isfinite(density))
    throw DomainError(function + ": density " + polhode::detail::number_text(density) +
                      " must be positive and finite");
  require_closed(shape, function);
  const Vec3 near = middle(shape);
  const Powers from_near = integrals(shape, near, false);
  const double volume = from_near.zero;
  if (!(volume > 0.0))
    throw DomainError(function + ": volume " + polhode::detail::number_text(volume) +
                      " must be positive: corners run counterclockwise as seen from outside");
  const Vec3 centre = near + (1.0 / volume) * from_near.one;
  const Powers about = integrals(shape, centre, true);
  return {.volume = volume,
          .mass = density * volume,
          .centre = centre,
          .inertia = tensor(scaled(about.two, density)),
          .moments = {scaled(about.three, density), scaled(about.four, density)}};
}

Body body(const MassProperties& properties) { return Body::from_tensor(properties.inertia); }

MassMoments principal_moments(const MassProperties& properties, const Body& body) {
  return rotated(properties.moments, rotation_matrix(conj(body.q_FB())));
}

}  // namespace shape
}  // namespace v0
}  // namespace polhode
