// SPDX-License-Identifier: MIT
// Torques of gravity: the gravity gradient, its higher degrees, an oblate primary, and tides.
#include "polhode/perturb/gravity_gradient.hpp"

#include <cmath>

#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/orbit/any_orbit.hpp"
#include "polhode/perturb/tidal_torque.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

void require_gravity(double gm) {
  if (!(gm > 0.0) || !std::isfinite(gm))
    throw DomainError("GravityGradient: gm " + number_text(gm) + " must be positive and finite");
}

namespace {

constexpr Vec3 axes[3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};

// The product with x^2 + y^2 + z^2.
template <int degree>
shape::BasicMoments<double, degree + 2> times_square(const shape::BasicMoments<double, degree>& p) {
  shape::BasicMoments<double, degree + 2> sum{};
  for (const Vec3& axis : axes) {
    const shape::BasicMoments<double, degree + 2> part =
        shape::detail::times<degree + 1>(shape::detail::times<degree>(p, axis), axis);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += part[i];
  }
  return sum;
}

// integral of (the monomials of degree - 2) |x|^2 dm: what the product with |x|^2 is dual to.
template <int degree>
shape::BasicMoments<double, degree - 2> traces(const shape::BasicMoments<double, degree>& m) {
  shape::BasicMoments<double, degree - 2> out{};
  for (int c = 0; c <= degree - 2; ++c)
    for (int b = 0; b + c <= degree - 2; ++b)
      out[shape::moment_place(b, c)] = m[shape::moment_place(b, c)] +
                                       m[shape::moment_place(b + 2, c)] +
                                       m[shape::moment_place(b, c + 2)];
  return out;
}

// integral of (x . y)^degree dm(y), a polynomial in x: moments times multinomial coefficients.
template <int degree>
shape::BasicMoments<double, degree> power_sum(const shape::BasicMoments<double, degree>& m) {
  shape::BasicMoments<double, degree> out{};
  for (int c = 0; c <= degree; ++c) {
    double ways = 1.0;  // degree! / (a! b! c!)
    for (int k = 1; k <= c; ++k) ways = ways * (degree - c + k) / k;
    for (int b = 0; b + c <= degree; ++b) {
      out[shape::moment_place(b, c)] = ways * m[shape::moment_place(b, c)];
      ways = ways * (degree - c - b) / (b + 1);
    }
  }
  return out;
}

template <int degree>
HarmonicGradient<degree> gradient_of(const shape::BasicMoments<double, degree>& p) {
  HarmonicGradient<degree> g{};
  for (int c = 0; c < degree; ++c) {
    for (int b = 0; b + c < degree; ++b) {
      const int a = degree - 1 - b - c;
      const std::size_t at = shape::moment_place(b, c);
      g.by[0][at] = (a + 1) * p[shape::moment_place(b, c)];
      g.by[1][at] = (b + 1) * p[shape::moment_place(b + 1, c)];
      g.by[2][at] = (c + 1) * p[shape::moment_place(b, c + 1)];
    }
  }
  return g;
}

}  // namespace

// (5 (n.x)^3 - 3 |n|^2 |x|^2 n.x) / 2
HarmonicGradient<3> potential_gradient(const shape::BasicMoments<double, 3>& m) {
  const shape::BasicMoments<double, 3> cube = power_sum<3>(m);
  const shape::BasicMoments<double, 3> mean = times_square<1>(traces<3>(m));
  shape::BasicMoments<double, 3> p{};
  for (std::size_t i = 0; i < p.size(); ++i) p[i] = 2.5 * cube[i] - 1.5 * mean[i];
  return gradient_of<3>(p);
}

// (35 (n.x)^4 - 30 |n|^2 |x|^2 (n.x)^2 + 3 |n|^4 |x|^4) / 8
HarmonicGradient<4> potential_gradient(const shape::BasicMoments<double, 4>& m) {
  const shape::BasicMoments<double, 2> second = traces<4>(m);
  const shape::BasicMoments<double, 4> fourth = power_sum<4>(m);
  const shape::BasicMoments<double, 4> square = times_square<2>(power_sum<2>(second));
  const shape::BasicMoments<double, 4> mean = times_square<2>(times_square<0>(traces<2>(second)));
  shape::BasicMoments<double, 4> p{};
  for (std::size_t i = 0; i < p.size(); ++i)
    p[i] = 4.375 * fourth[i] - 3.75 * square[i] + 0.375 * mean[i];
  return gradient_of<4>(p);
}

void require_higher_gravity(double gm, const shape::MassMoments& moments) {
  if (!(gm > 0.0) || !std::isfinite(gm))
    throw DomainError("HigherGravity: gm " + number_text(gm) + " must be positive and finite");
  const auto require_finite = [](const auto& of, const char* degree) {
    for (const double x : of)
      if (!std::isfinite(x))
        throw DomainError(std::string("HigherGravity: ") + degree + " moment " + number_text(x) +
                          " must be finite");
  };
  require_finite(moments.third, "third-degree");
  require_finite(moments.fourth, "fourth-degree");
}

namespace {

void require(const char* whose, bool good, const char* what, double x, const char* needed) {
  if (!good || !std::isfinite(x))
    throw DomainError(std::string(whose) + ": " + what + " " + number_text(x) + " must be " +
                      needed);
}

}  // namespace

ValidOblateness::ValidOblateness(double J2, double radius, const Vec3& pole) {
  require("Oblateness", radius > 0.0, "radius", radius, "positive and finite");
  require("Oblateness", true, "J2", J2, "finite");
  const double length = norm(pole);
  if (!(length > 0.0) || !std::isfinite(length))
    throw DomainError("Oblateness: pole " + tuple_text({pole.x, pole.y, pole.z}) +
                      " must be a direction: finite and not 0");
}

double checked_strength(double gm, const Oblateness& of) {
  require("OblateGravity", gm > 0.0, "gm", gm, "positive and finite");
  static_cast<void>(ValidOblateness(of.J2, of.radius, of.pole));  // as it is now
  return gm * of.J2 * of.radius * of.radius;
}

double tidal_strength(double gm, double mass, const TidalBody& of) {
  const auto require = [](bool good, const char* what, double x, const char* needed) {
    if (!good || !std::isfinite(x))
      throw DomainError(std::string("TidalTorque: ") + what + " " + number_text(x) + " must be " +
                        needed + " and finite");
  };
  require(gm > 0.0, "gm", gm, "positive");
  require(mass > 0.0, "mass", mass, "positive");
  require(of.radius > 0.0, "radius", of.radius, "positive");
  require(of.k2 >= 0.0, "k2", of.k2, ">= 0");
  require(of.lag >= 0.0, "lag", of.lag, ">= 0");
  return 3.0 * of.k2 * gm * mass * std::pow(of.radius, 5) * of.lag;
}

void require_velocity(const AnyOrbit& orbit) {
  if (!orbit.supports_velocity())
    throw DomainError("TidalTorque: orbit \"" + orbit.name() + "\" must have a velocity");
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
