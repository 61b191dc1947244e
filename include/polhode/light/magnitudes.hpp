// SPDX-License-Identifier: MIT
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
#pragma once

#include <cmath>
#include <limits>
#include <numbers>

#include "polhode/light/light_curve.hpp"

namespace polhode {
inline namespace v0 {

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

}  // namespace v0
}  // namespace polhode
