// SPDX-License-Identifier: MIT
#include "polhode/secular/yorp.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "math/gauss_legendre.hpp"
#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace secular {
namespace {

constexpr std::size_t nodes = 32;

using Rule = GaussRule<double, nodes>;

// Means over a turn of c+, c+ cos, c+^2, c+^2 cos, where c = A + B cos(angle), c+ = max(c, 0).
struct TurnMeans {
  double one, one_cos, two, two_cos;
};
TurnMeans turn_means(double A, double B) {
  // half of the lit arc
  const double half = A >= B ? std::numbers::pi : (A <= -B ? 0.0 : std::acos(-A / B));
  const double s = std::sin(half), quarter = 0.5 * half + 0.25 * std::sin(2.0 * half);
  constexpr double turn = std::numbers::inv_pi;
  return {turn * (A * half + B * s), turn * (A * s + B * quarter),
          turn * (A * A * half + 2.0 * A * B * s + B * B * quarter),
          turn * (A * A * s + 2.0 * A * B * quarter + B * B * (s - s * s * s / 3.0))};
}

// A facet with the spin axis along z: how its vectors lie about it.
struct TurningFacet {
  double area;
  StreamLaw law;
  double n_z, n_across;
  Vec3 centre, arm;  // r, r x n, their x along the part of n across the axis
};

Mat3 axes_about(const Vec3& axis) {
  const double length = norm(axis);
  if (!(length > 0.0) || !std::isfinite(length))
    throw DomainError("yorp_torque: axis " + polhode::detail::tuple_text({axis.x, axis.y, axis.z}) +
                      " must have a direction");
  const Vec3 z = (1.0 / length) * axis;
  const Vec3 other = std::fabs(z.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 across = cross(z, other);
  const Vec3 y = (1.0 / norm(across)) * across;
  return {{cross(y, z), y, z}};
}

TurningFacet turning(const SurfaceFacet& f, const Mat3& axes) {
  const Vec3 n = axes * f.normal, r = axes * f.centre;
  const double across = std::hypot(n.x, n.y);
  const double x = across > 0.0 ? n.x / across : 1.0, y = across > 0.0 ? n.y / across : 0.0;
  const auto turned = [&](const Vec3& v) {
    return Vec3{x * v.x + y * v.y, x * v.y - y * v.x, v.z};
  };
  return {f.area, light_law(f.finish), n.z, across, turned(r), turned(cross(r, n))};
}

// Mean torque over a turn, the Sun in the plane y = 0 at this latitude.
Vec3 turn_torque(const TurningFacet& f, double sine, double cosine) {
  const TurnMeans mean = turn_means(f.n_z * sine, f.n_across * cosine);
  const auto averaged = [](const Vec3& v, double one, double with_cos) {
    return Vec3{with_cos * v.x, with_cos * v.y, one * v.z};
  };
  const Vec3 shifted = f.law.along * averaged(f.centre, mean.one, mean.one_cos);
  const Vec3 turned = averaged(f.arm, f.law.normal * mean.one + f.law.mirrored * mean.two,
                               f.law.normal * mean.one_cos + f.law.mirrored * mean.two_cos);
  return f.area * (cross(Vec3{cosine, 0.0, sine}, shifted) - turned);
}

struct Tilt {
  double sine, cosine;
};

// s along z, N = (0, -sin o, cos o), the Sun at the longitude f from x.
YorpTorque torque_at(const TurningFacet& facet, const Tilt& tilt, double f) {
  const double x = std::cos(f), y = std::sin(f) * tilt.cosine, z = std::sin(f) * tilt.sine;
  const double across = std::hypot(x, y);
  const Vec3 u = turn_torque(facet, z, across);
  if (!(across > 0.0)) return {u.z, 0.0, 0.0};  // the Sun at the pole has no meridian
  const double c = x / across, s = y / across;
  return {u.z, s * u.x + c * u.y, c * u.x - s * u.y};
}

// The arcs of the orbit end where the facet begins to have polar day or night; what the integrand
// does there, a power 1/2 or 3/2, is smooth in the angle whose sine runs along the arc.
YorpTorque orbit_mean(const TurningFacet& facet, const Tilt& tilt, const Rule& rule) {
  const double steepest = std::fabs(tilt.sine);
  const double edge =
      facet.n_across < steepest ? std::asin(facet.n_across / steepest) : 0.5 * std::numbers::pi;
  const double half_turn = std::numbers::pi;
  const std::array<double, 5> ends{-edge, edge, half_turn - edge, half_turn + edge,
                                   2.0 * half_turn - edge};
  YorpTorque sum{};
  for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
    const double middle = 0.5 * (ends[k] + ends[k + 1]), half = 0.5 * (ends[k + 1] - ends[k]);
    if (!(half > 0.0)) continue;
    for (std::size_t i = 0; i < nodes; ++i) {
      const double angle = 0.5 * half_turn * rule.x[i];
      const double w = 0.25 * half * std::cos(angle) * rule.w[i];  // pi/2 over a turn of 2 pi
      const YorpTorque at = torque_at(facet, tilt, middle + half * std::sin(angle));
      sum = {sum.spin + w * at.spin, sum.obliquity + w * at.obliquity,
             sum.precession + w * at.precession};
    }
  }
  return sum;
}

}  // namespace

YorpTorque yorp_torque(const Surface& surface, double obliquity, const Vec3& axis) {
  if (!std::isfinite(obliquity))
    throw DomainError("yorp_torque: obliquity " + polhode::detail::number_text(obliquity) +
                      " must be finite");
  static const Rule rule = gauss_legendre<double, nodes>();
  const Mat3 axes = axes_about(axis);
  const Tilt tilt{std::sin(obliquity), std::cos(obliquity)};
  YorpTorque sum{};
  for (const SurfaceFacet& f : surface.facets()) {
    const YorpTorque own = orbit_mean(turning(f, axes), tilt, rule);
    sum = {sum.spin + own.spin, sum.obliquity + own.obliquity, sum.precession + own.precession};
  }
  return sum;
}

double mean_pressure(const Sunlight& light, double semi_major_axis, double eccentricity) {
  if (!(semi_major_axis > 0.0) || !std::isfinite(semi_major_axis))
    throw DomainError("mean_pressure: semi_major_axis " +
                      polhode::detail::number_text(semi_major_axis) +
                      " must be positive and finite");
  if (!(eccentricity >= 0.0 && eccentricity < 1.0))
    throw DomainError("mean_pressure: eccentricity " + polhode::detail::number_text(eccentricity) +
                      " must be at least 0 and below 1");
  const double ratio = light.distance / semi_major_axis;
  return light.pressure * (ratio * ratio) / std::sqrt((1.0 - eccentricity) * (1.0 + eccentricity));
}

}  // namespace secular
}  // namespace v0
}  // namespace polhode
