// SPDX-License-Identifier: MIT
#include "polhode/secular/spin_precession.hpp"

#include <string>

#include "math/number_text.hpp"
#include "math/pack_functions.hpp"
#include "polhode/error.hpp"
#include "secular/detail/spin_axes.hpp"

namespace polhode {
inline namespace v0 {
namespace secular {
namespace {

void require_positive(const char* what, double x) {
  if (!(x > 0.0) || !std::isfinite(x))
    throw DomainError(std::string(what) + " " + polhode::detail::number_text(x) +
                      " must be positive");
}

void require_spin(const char* of, double ellipticity, double spin_rate) {
  if (spin_rate == 0.0 || !std::isfinite(spin_rate) || !std::isfinite(ellipticity))
    throw DomainError(std::string(of) + ": got ellipticity " +
                      polhode::detail::number_text(ellipticity) + " and spin_rate " +
                      polhode::detail::number_text(spin_rate) +
                      "; expected finite numbers, the rate other than 0");
}

double precession_on_a_circle(double ellipticity, double spin_rate, double gm, double a) {
  return 1.5 * gm / (a * a * a) * ellipticity / spin_rate;
}

}  // namespace

PrecessionRates rates_of_precession(double rate, double X, double e2, double share) {
  if (std::fabs(X) < 1e-6)
    throw DomainError(
        "expected a precession constant, since at an obliquity of 90 deg no rate tells the "
        "constant");
  if (!std::isfinite(rate) || !(std::fabs(X) <= 1.0 + 1e-15) || !(e2 >= 0.0 && e2 < 1.0) ||
      !(share >= 0.0) || !std::isfinite(share))
    throw DomainError(
        "precession rate: got " + polhode::detail::number_text(rate) + " at X " +
        polhode::detail::number_text(X) + " and e^2 " + polhode::detail::number_text(e2) +
        ", satellites " + polhode::detail::number_text(share) +
        "; expected finite numbers, X from -1 to 1, e^2 from 0 to below 1, satellites "
        "0 or more");
  const double star =
      rate / (X * PrecessionRates{.star = 1.0, .satellites = share}.torque(0.0, e2));
  return {.star = star, .satellites = share * star};
}

void require_drift(const PrecessionRates& rates, double first, double last) {
  for (const double t : {first, last})
    if (!(1.0 + rates.drift * t > 0.0))
      throw DomainError("a drift of " + polhode::detail::number_text(rates.drift) +
                        " turns the torques round before t = " + polhode::detail::number_text(t) +
                        "; expected a smaller one");
}

double star_precession(double ellipticity, double spin_rate, double gm, double semi_major_axis) {
  require_positive("star_precession: gm", gm);
  require_positive("star_precession: semi_major_axis", semi_major_axis);
  require_spin("star_precession", ellipticity, spin_rate);
  return precession_on_a_circle(ellipticity, spin_rate, gm, semi_major_axis);
}

double satellite_precession(double ellipticity, double spin_rate, double gm, double semi_major_axis,
                            double eccentricity, double inclination) {
  require_positive("satellite_precession: gm", gm);
  require_positive("satellite_precession: semi_major_axis", semi_major_axis);
  require_spin("satellite_precession", ellipticity, spin_rate);
  if (!(eccentricity >= 0.0 && eccentricity < 1.0))
    throw DomainError("satellite_precession: got eccentricity " +
                      polhode::detail::number_text(eccentricity) + "; expected 0 to below 1");
  const double r = 1.0 / (1.0 - eccentricity * eccentricity), s = std::sin(inclination);
  return precession_on_a_circle(ellipticity, spin_rate, gm, semi_major_axis) * r * std::sqrt(r) *
         (1.0 - 1.5 * s * s);
}

double geodetic_precession(double gm, double semi_major_axis, double light_speed) {
  require_positive("geodetic_precession: gm", gm);
  require_positive("geodetic_precession: semi_major_axis", semi_major_axis);
  require_positive("geodetic_precession: light_speed", light_speed);
  const double v2 = gm / semi_major_axis;
  return 1.5 * v2 * std::sqrt(v2) / (semi_major_axis * light_speed * light_speed);
}

double andoyer_factor(double J) {
  const double s = std::sin(J);
  return 1.0 - 1.5 * s * s;
}

double inner_satellites_factor(double J2, double inertia_factor,
                               std::span<const InnerSatellite> satellites) {
  require_positive("inner_satellites_factor: J2", J2);
  require_positive("inner_satellites_factor: inertia_factor", inertia_factor);
  double q = 0.0, l = 0.0;
  for (const InnerSatellite& one : satellites) {
    require_positive("inner_satellites_factor: mass", one.mass);
    require_positive("inner_satellites_factor: distance", one.distance);
    require_positive("inner_satellites_factor: mean_motion", one.mean_motion);
    const double moment = one.mass * one.distance * one.distance;
    q += 0.5 * moment;
    l += moment * one.mean_motion;
  }
  return (1.0 + q / J2) / (1.0 + l / inertia_factor);
}

SpinAxis spin_axis(const Vec3& direction) {
  const double length = norm(direction);
  if (!(length > 0.0))
    throw DomainError("spin_axis: got a direction of length " +
                      polhode::detail::number_text(length) + "; expected one that has a length");
  return {(1.0 / length) * direction};
}

namespace detail {

SpinAxis turned(const SpinAxis& axis, const Vec3& n, double angle) {
  const SinCos<Pack<InstructionSet::baseline>> half =
      sincos_of_small(Pack<InstructionSet::baseline>(0.5 * angle));
  return {turned_axis(axis.s, n, SinCos<double>{half.sin.lanes[0], half.cos.lanes[0]})};
}

}  // namespace detail

SpinAngles spin_angles(const SpinAxis& axis, const OrbitElements& orbit) {
  const Vec3 s = rotate(conj(equinoctial_attitude(orbit)), axis.s);
  const double tilt = std::hypot(s.x, s.y);
  // s x n is along (s_y, -s_x): the ascending node of the orbit on the equator
  const double equinox = tilt > 0.0 ? std::atan2(-s.x, s.y) : std::nan("");
  const double varpi = std::atan2(orbit.h, orbit.k);
  const double pericentre = std::remainder(varpi - equinox, 2.0 * pi<double>());
  return {std::atan2(tilt, s.z), -equinox, pericentre, eccentricity(orbit) * std::sin(pericentre)};
}

}  // namespace secular
}  // namespace v0
}  // namespace polhode
