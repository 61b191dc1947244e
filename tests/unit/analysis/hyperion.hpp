// SPDX-License-Identifier: MIT
// Hyperion as Wisdom, Peale and Mignard (1984) have it, the mean motion being 1: the system, and
// the planar equation of its rotation with the equation of its deviation, in a program of its own.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "polhode/dynamics/integrate.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "polhode/perturb/gravity_gradient.hpp"

namespace polhode::test {

inline constexpr double hyperion_e = 0.1;
inline constexpr double hyperion_orbit = 2.0 * std::numbers::pi;  // one orbit
inline constexpr double hyperion_day = hyperion_orbit / 21.277;

// Semi-axes 190, 145 and 114 km, homogeneous; the longest along b1.
inline Body hyperion_body() {
  const double a2 = 190.0 * 190.0, b2 = 145.0 * 145.0, c2 = 114.0 * 114.0;
  return Body((b2 + c2) / (a2 + b2), (a2 + c2) / (a2 + b2), 1.0);
}
inline System hyperion_system() {
  const KeplerOrbit orbit({.gm = 1.0, .pericentre = 1.0 - hyperion_e, .eccentricity = hyperion_e});
  return System(hyperion_body(), Frame::inertial(),
                {AnyPerturbation("Saturn", GravityGradient(1.0, orbit))});
}
// At the pericentre, the long axis turned by `angle` from Saturn, the spin axis tilted by `tilt`.
inline RotorState hyperion_state(double angle, double spin, double tilt = 0.0) {
  return {rotation_x(tilt) * rotation_z(angle), {0.0, 0.0, spin * hyperion_body().moments().z}};
}
inline Problem hyperion(const RotorState& s, double orbits, const Method& method) {
  return {hyperion_system(), s, 0.0, orbits * hyperion_orbit, method, {}};
}

// angle'' = -(3/2) (B - A)/C r^-3 sin 2(angle - f), f = 0 at t = 0, and d(angle)'' of a deviation:
// {angle, rate, d angle, d rate} by the classical Runge-Kutta rule with equal steps.
class PlanarSpin {
 public:
  using Values = std::array<double, 4>;

  static Values after(Values y, double stop, int steps) {
    const double h = stop / steps;
    for (int k = 0; k < steps; ++k) {
      const double t = h * k;
      const Values k1 = rates(t, y), k2 = rates(t + 0.5 * h, moved(y, 0.5 * h, k1)),
                   k3 = rates(t + 0.5 * h, moved(y, 0.5 * h, k2)),
                   k4 = rates(t + h, moved(y, h, k3));
      for (std::size_t i = 0; i < 4; ++i)
        y[i] += h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]);
    }
    return y;
  }

 private:
  static Values moved(Values y, double h, const Values& rate) {
    for (std::size_t i = 0; i < 4; ++i) y[i] += h * rate[i];
    return y;
  }
  static Values rates(double t, const Values& y) {
    const Vec3 I = hyperion_body().moments();
    const double e = hyperion_e;
    double E = t;  // Kepler's equation by Newton's method; e = 0.1: six trips are plenty
    for (int i = 0; i < 6; ++i) E -= (E - e * std::sin(E) - t) / (1.0 - e * std::cos(E));
    const double r = 1.0 - e * std::cos(E);
    const double f = std::atan2(std::sqrt(1.0 - e * e) * std::sin(E), std::cos(E) - e);
    const double strength = 1.5 * (I.y - I.x) / I.z / (r * r * r);
    return {y[1], -strength * std::sin(2.0 * (y[0] - f)), y[3],
            -2.0 * strength * std::cos(2.0 * (y[0] - f)) * y[2]};
  }
};

}  // namespace polhode::test
