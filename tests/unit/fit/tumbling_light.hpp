// SPDX-License-Identifier: MIT
// Light curves of tumbling ellipsoids, for tests of scans: Lommel and Seeliger's law by quadrature.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "polhode/free/free_rotation.hpp"
#include "polhode/light/light_curve.hpp"
#include "polhode/math/real.hpp"

namespace polhode::test {

inline Vec3 unit(const Vec3& v) { return (1.0 / norm(v)) * v; }

struct Ellipsoid {
  double a, b, c;  // a > b > c along b1, b2, b3

  Body body() const { return {b * b + c * c, a * a + c * c, a * a + b * b}; }
  // Of directions along the body's axes; evenly spread points of a sphere, drawn out.
  double light(const Vec3& to_sun, const Vec3& to_observer) const {
    constexpr int points = 400;
    double sum = 0.0;
    for (int i = 0; i < points; ++i) {
      const double z = (2.0 * i + 1.0) / points - 1.0, r = std::sqrt(1.0 - z * z);
      const double turn = 2.399963229728653 * i;  // the golden angle
      const Vec3 n{r * std::cos(turn) / a, r * std::sin(turn) / b, z / c};
      const double size = norm(n), sun = dot(n, to_sun) / size, seen = dot(n, to_observer) / size;
      if (sun > 0.0 && seen > 0.0) sum += size * sun * seen / (sun + seen);
    }
    return sum;
  }
};

struct Tumbling {
  Ellipsoid shape;
  FreeRotation motion;

  // Momentum of size 1 along a direction of the body, and any attitude.
  static Tumbling of(const Ellipsoid& shape, const Vec3& along) {
    return {shape,
            FreeRotation(shape.body(), {normalized(Quaternion{0.6, 0.3, -0.5, 0.2}), unit(along)})};
  }
  double f_phi() const { return motion.precession_rate_long() / (2.0 * pi<double>()); }
  double f_psi() const { return 1.0 / motion.polhode_period(); }

  // `turns` of precession in so many points, not quite evenly spaced, with relative noise.
  light::LightCurve light_curve(double turns, std::size_t count, double noise,
                                std::uint64_t seed) const {
    std::mt19937_64 engine(seed);
    const auto uniform = [&] { return std::ldexp(static_cast<double>(engine() >> 11U), -53); };
    const Vec3 to_sun = unit({1.0, 0.2, 0.3}), to_observer = unit({0.8, 0.6, 0.1});
    light::LightCurve curve{.name = "night", .is_calibrated = false, .points = {}};
    for (std::size_t i = 0; i < count; ++i) {
      const double part = (static_cast<double>(i) + 0.8 * uniform()) / static_cast<double>(count);
      const double t = turns * part / f_phi();
      const Quaternion back = conj(motion.at(t).q);
      const double flux = shape.light(rotate(back, to_sun), rotate(back, to_observer));
      const double normal =
          std::sqrt(-2.0 * std::log(1.0 - uniform())) * std::cos(2.0 * pi<double>() * uniform());
      curve.points.push_back({t, flux * (1.0 + noise * normal), flux * noise, to_sun, to_observer});
    }
    return curve;
  }
};

}  // namespace polhode::test
