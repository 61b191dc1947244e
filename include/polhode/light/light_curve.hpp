// SPDX-License-Identifier: MIT
// LightCurve: how bright a body was, seen from one place during one session of observation.
//
// Units       t in any unit of time from any epoch; flux in any unit, the same throughout a session
//             and, where sessions are calibrated, in all of them; to_sun and to_observer in any
//             unit of length, along the inertial axes I.
// Domain      flux > 0, or noise about it; sigma > 0, its standard deviation. Magnitudes become
//             fluxes when they are read (polhode/light/light_curve.hpp). The vectors go from the
//             body to the Sun and to the observer at time t, 0 where they are unknown. A relative
//             session has a factor of its own, which nothing but its points determines.
// Accuracy    plain values.
// Errors      none; polhode/light/light_curve.hpp says what is wrong with one.
// Cost        72 bytes a point.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {
namespace light {

struct LightPoint {
  double t = 0.0;
  double flux = 0.0;
  double sigma = 0.0;  // of the flux
  Vec3 to_sun = {};    // from the body, along I
  Vec3 to_observer = {};

  bool operator==(const LightPoint&) const = default;
};

struct LightCurve {
  std::string name;
  bool is_calibrated = false;
  std::vector<LightPoint> points;

  bool operator==(const LightCurve&) const = default;
};

// What keeps light curves from being used: the first flaw, as a sentence, before a fit sees it.
//
// Units       those of the light curves.
// Domain      any sessions. A flaw is: no points; a number that is not finite; sigma that is not
//             above 0; times that fall in a session; an observation that stands twice (others at
//             one time are of two telescopes); a relative session of one point, or of a mean flux
//             that is not above 0; and where vectors are needed, one that is missing. Nothing is
//             mended here: times out of order are most often a typing error, or two nights in one
//             session; who knows better asks for in_order_of_time.
// Accuracy    times are compared as they are, without a tolerance.
// Errors      require_sound throws a DomainError with the name of the session and the point, from
//             1.
// Cost        one pass, and a sort of all points for those that two sessions share.

struct LightCurveNeeds {
  bool vectors = false;  // to the Sun and to the observer, of each point
};

struct LightCurveFlaw {
  std::size_t curve = 0;             // its place among the sessions, from 0
  std::optional<std::size_t> point;  // its place in the session, from 0; none: the session as such
  std::string text;                  // what is wrong, and what was expected
  enum class Kind { other, order, twice, error };
  Kind kind = Kind::other;  // what would mend it: sorting, leaving the point out, an error
};

// The first in the order of sessions and points; those between sessions come last.
std::optional<LightCurveFlaw> first_flaw(std::span<const LightCurve> curves,
                                         const LightCurveNeeds& needs = {});
// "light curve 2 (NAME): point 3: error 0; expected one above 0"
void require_sound(std::span<const LightCurve> curves, const LightCurveNeeds& needs = {});

// By time; points of one time stay in their order.
LightCurve in_order_of_time(LightCurve curve);

// Magnitudes and fluxes, and fluxes as parts of their mean.
//
// Equations   flux = 10^(-0.4 (m - zero)), sigma_flux = 0.4 ln(10) flux sigma_m, and back m = zero
//             - 2.5 log10(flux); normalised: every flux and sigma over the mean flux.
// Units       magnitudes; the flux is in units of that of a source of the magnitude `zero`.
// Domain      any magnitudes; a flux that is not above 0 has none (NaN). Errors are taken to first
//             order, as those of light curves are: at 0.1 mag the flux is skewed by 5 % of its
//             error.
// Accuracy    a few roundings of the power or logarithm.
// Errors      normalised and with_relative_sigma: DomainError where the mean flux or the fraction
//             is not above 0.
// Cost        a power or a logarithm.

struct Magnitude {
  double value = 0.0;
  double sigma = 0.0;

  bool operator==(const Magnitude&) const = default;
};
struct Flux {
  double value = 0.0;
  double sigma = 0.0;

  bool operator==(const Flux&) const = default;
};

// d flux / d m = -magnitude_slope flux
inline constexpr double magnitude_slope = 0.4 * std::numbers::ln10;

inline Flux flux_of(const Magnitude& m, double zero = 0.0) {
  const double flux = std::pow(10.0, -0.4 * (m.value - zero));
  return {flux, magnitude_slope * flux * m.sigma};
}
inline Magnitude magnitude_of(const Flux& flux, double zero = 0.0) {
  if (!(flux.value > 0.0)) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    return {none, none};
  }
  return {zero - 2.5 * std::log10(flux.value), flux.sigma / (magnitude_slope * flux.value)};
}

// Plain mean over the points; NaN without any.
double mean_flux(const LightCurve& curve);
// Of a session whose unit of flux says nothing: with the mean 1.
LightCurve normalised(LightCurve curve);
// With one error for all points, a fraction of the mean flux: for files that have none.
LightCurve with_relative_sigma(LightCurve curve, double fraction);

}  // namespace light
}  // namespace v0
}  // namespace polhode
