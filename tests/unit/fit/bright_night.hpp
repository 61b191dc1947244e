// SPDX-License-Identifier: MIT
// Light curves of tumbling ellipsoids whose truth is known, for tests of fits.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "fit/detail/light_residuals.hpp"
#include "polhode/ensemble/distributions.hpp"
#include "polhode/ensemble/draws.hpp"
#include "polhode/fit/light_fit.hpp"
#include "polhode/free/free_rotation.hpp"
#include "polhode/light/lommel_seeliger.hpp"
#include "polhode/math/real.hpp"

namespace polhode::test {

inline const fit::LightModel in_long_axis_mode = fit::LightModel::homogeneous(
    0.0, normalized(Quaternion{0.6, 0.3, -0.5, 0.2}), {2.4, 0.9, 0.3}, {1.0, 0.6, 0.45});
inline const fit::LightModel in_short_axis_mode = fit::LightModel::homogeneous(
    0.0, normalized(Quaternion{0.6, 0.3, -0.5, 0.2}), {0.6, 0.5, 1.0}, {1.0, 0.85, 0.5});

inline FreeRotation motion_of(const fit::LightModel& b) {
  const Mat3& T = b.spin.inertia_F;
  const Vec3 g{T(0, 0) * b.spin.w_F.x, T(1, 1) * b.spin.w_F.y, b.spin.w_F.z};
  return FreeRotation(Body(T(0, 0), T(1, 1), 1.0), {b.spin.q, g}, b.spin.t0);
}

inline fit::detail::LightResiduals<fit::detail::EllipsoidSurface> ellipsoid_residuals(
    const std::vector<light::LightCurve>& curves, const fit::LightUnknowns& unknowns,
    const fit::LightModel& body, const fit::Loss& loss = {},
    fit::detail::Rows rows = fit::detail::Rows::exact) {
  const fit::LightFit fit{curves, body, unknowns, loss};
  return {std::make_shared<const fit::detail::WeighedCurves>(curves, loss), unknowns, body,
          fit::detail::EllipsoidSurface(fit, body), rows};
}

// One night, of `turns` of precession, with noise relative to the flux.
inline light::LightCurve night(const fit::LightModel& b, double turns, std::size_t count,
                               double noise, std::uint64_t seed) {
  const FreeRotation motion = motion_of(b);
  const double P = 2.0 * pi<double>() / motion.precession_rate_long();
  const ensemble::CounterRandom random(seed, ensemble::key_of("night"));
  light::LightCurve curve{.name = "night", .is_calibrated = false, .points = {}};
  for (std::size_t i = 0; i < count; ++i) {
    const double t = turns * P * (static_cast<double>(i) + 0.8 * random.uniform(i, 0)) /
                     static_cast<double>(count);
    const Vec3 sun{1.0, 0.2, 0.3}, observer{0.8, 0.6, 0.1};
    const Quaternion back = conj(motion.at(t).q);
    const double flux = 3.0 * light::lommel_seeliger_brightness(b.ellipsoid(), rotate(back, sun),
                                                                rotate(back, observer));
    curve.points.push_back(
        {t, flux * (1.0 + noise * random.normal(i, 4)), flux * noise, sun, observer});
  }
  return curve;
}

inline fit::LightModel at_time(const fit::LightModel& b, double t) {
  const RotorState s = motion_of(b).at(t);
  const Mat3& T = b.spin.inertia_F;
  fit::LightModel found = b;
  found.spin.t0 = t;
  found.spin.q = s.q;
  found.spin.w_F = {s.g.x / T(0, 0), s.g.y / T(1, 1), s.g.z};
  return found;
}

// With the best factor of each session.
inline double chi_square(const fit::LightModel& body, std::span<const light::LightCurve> curves) {
  const std::vector<std::vector<double>> model = fit::model_fluxes(body, curves);
  double sum = 0.0;
  for (std::size_t k = 0; k < curves.size(); ++k)
    for (std::size_t i = 0; i < model[k].size(); ++i) {
      const light::LightPoint& p = curves[k].points[i];
      const double miss = (model[k][i] - p.flux) / p.sigma;
      sum += miss * miss;
    }
  return sum;
}

// A tumbler drawn by its number, seen for one night: long-axis mode where that is even. Two periods
// that the night tells apart, and a wobble of 15 deg at least.
struct DrawnTumbler {
  fit::LightModel body;
  Regime mode;
  double f_phi, f_psi, time_base;
  light::LightCurve curve;

  bool has(const fit::TumblerPeriods& p) const {
    return p.mode == mode && std::abs(1.0 / p.precession_period - f_phi) * time_base < 0.25 &&
           std::abs(1.0 / p.rotation_period - f_psi) * time_base < 0.25;
  }
};

inline DrawnTumbler drawn_tumbler(std::uint64_t number, std::size_t count, double noise,
                                  std::uint64_t seed = 11) {
  const ensemble::CounterRandom random(seed, ensemble::key_of("tumblers"));
  std::uint64_t next = 0;
  const auto uniform = [&] { return random.uniform(number, next++); };
  const Regime wanted = number % 2 == 0 ? Regime::long_axis : Regime::short_axis;
  for (;;) {  // one in three is taken
    const double b = 0.35 + 0.55 * uniform(), c = b * (0.45 + 0.45 * uniform());
    const double z = 2.0 * uniform() - 1.0, around = 2.0 * pi<double>() * uniform();
    const double across = std::sqrt(1.0 - z * z);
    const Vec3 I = light::homogeneous_moments(light::Ellipsoid{1.0, b, c}, 1.0);
    const Vec3 g{across * std::cos(around), across * std::sin(around), z};
    const double u0 = uniform(), u1 = uniform(), u2 = uniform();
    const fit::LightModel body =
        fit::LightModel::homogeneous(0.0, ensemble::UniformAttitude().from_uniform(u0, u1, u2),
                                     {g.x / I.x * I.z, g.y / I.y * I.z, g.z}, {1.0, b, c});
    const FreeRotation motion = motion_of(body);
    const double turns = 8.0 + 6.0 * uniform();
    const double phase = (10.0 + 60.0 * uniform()) * pi<double>() / 180.0;
    if (motion.regime() != wanted) continue;
    const double f_phi = motion.precession_rate_long() / (2.0 * pi<double>());
    const double f_psi = 1.0 / motion.polhode_period(), T = turns / f_phi;
    const double along = wanted == Regime::long_axis ? std::abs(g.x) : std::abs(g.z);
    if (f_psi * T < 2.0 || along > std::cos(0.25)) continue;
    light::LightCurve curve{.name = "night", .is_calibrated = false, .points = {}};
    const Vec3 sun{1.0, 0.0, 0.0}, observer{std::cos(phase), std::sin(phase), 0.0};
    for (std::size_t i = 0; i < count; ++i) {
      const double part = static_cast<double>(i) + 0.8 * random.uniform(number, 1000 + i);
      const double t = T * part / static_cast<double>(count);
      const Quaternion back = conj(motion.at(t).q);
      const double flux = light::lommel_seeliger_brightness(body.ellipsoid(), rotate(back, sun),
                                                            rotate(back, observer));
      curve.points.push_back({t, flux * (1.0 + noise * random.normal(number, 100000 + 4 * i)),
                              flux * noise, sun, observer});
    }
    return {body, wanted, f_phi, f_psi, T, curve};
  }
}

}  // namespace polhode::test
