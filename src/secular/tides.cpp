// SPDX-License-Identifier: MIT
// Tides: their rates, and the change of spin, obliquity and distance that they make.
#include "polhode/secular/tides.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/secular/detail/tidal_change.hpp"

namespace polhode {
inline namespace v0 {
namespace secular {

namespace {

[[noreturn]] void refuse(const char* what, double got, const char* expected) {
  throw DomainError(std::string("TidalRates: ") + what + " " + polhode::detail::number_text(got) +
                    " must be " + expected);
}

}  // namespace

double tidal_rate(double k2, double lag, double gm, double mass_ratio, double radius,
                  double inertia_factor, double semi_major_axis) {
  for (const auto& [name, x] :
       {std::pair("gm", gm), std::pair("mass_ratio", mass_ratio), std::pair("radius", radius),
        std::pair("inertia_factor", inertia_factor), std::pair("semi_major_axis", semi_major_axis)})
    if (!(x > 0.0) || !std::isfinite(x))
      throw DomainError(std::string("tidal_rate: ") + name + " " + polhode::detail::number_text(x) +
                        " must be positive");
  for (const auto& [name, x] : {std::pair("k2", k2), std::pair("lag", lag)})
    if (!(x >= 0.0) || !std::isfinite(x))
      throw DomainError(std::string("tidal_rate: ") + name + " " + polhode::detail::number_text(x) +
                        " must not be negative");
  const double a = semi_major_axis, ratio = radius / a;
  return 3.0 * k2 * lag * (gm / (a * a * a)) * mass_ratio * (ratio * ratio * ratio) /
         inertia_factor;
}

void require_valid(const TidalRates& of) {
  if (!(of.spin > 0.0) || !std::isfinite(of.spin)) refuse("spin", of.spin, "positive");
  if (!(of.orbit > 0.0) || !std::isfinite(of.orbit)) refuse("orbit", of.orbit, "positive");
  for (const auto& [name, x] : {std::pair("star", of.star), std::pair("satellite", of.satellite),
                                std::pair("satellite_orbit", of.satellite_orbit),
                                std::pair("satellite_momentum", of.satellite_momentum)})
    if (!(x >= 0.0) || !std::isfinite(x)) refuse(name, x, "0 or positive");
  if (of.satellite > 0.0 && !(of.satellite_orbit > 0.0))
    refuse("satellite_orbit", of.satellite_orbit, "positive where there is a satellite");
  if (of.satellite > 0.0 && !(of.satellite_momentum > 0.0))
    refuse("satellite_momentum", of.satellite_momentum, "positive where there is a satellite");
}

namespace detail {

TidalSpin tidal_change(const TidalRates& tides, double e2, const Vec3& n, const TidalSpin& at) {
  const double c = dot(at.s, n), w = tides.spin * at.spin;
  const double r = 1.0 / (1.0 - e2), r2 = r * r, r4 = r2 * r2;
  const double f = (1.0 + e2 * (3.0 + 0.375 * e2)) * r4 * std::sqrt(r);
  const double N = (1.0 + e2 * (7.5 + e2 * (5.625 + 0.3125 * e2))) * r4 * r2;
  const double root = std::sqrt(at.distance), d3 = at.distance * at.distance * at.distance;
  const double moon = tides.satellite / (d3 * d3);
  const double month = tides.satellite_orbit / (at.distance * root);
  // sums over star and satellite of K f and K N m
  const double drag = tides.star * f + moon, drive = tides.star * N * tides.orbit + moon * month;
  TidalSpin change{(drive / w - 0.5 * drag * c) * (n - c * at.s),
                   (drive * c - 0.5 * drag * w * (1.0 + c * c)) / tides.spin, 0.0};
  if (moon > 0.0) change.distance = 2.0 * root * moon * (w * c - month) / tides.satellite_momentum;
  return change;
}

}  // namespace detail
}  // namespace secular
}  // namespace v0
}  // namespace polhode
