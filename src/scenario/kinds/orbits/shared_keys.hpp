// SPDX-License-Identifier: MIT
// Keys that several kinds of [orbit.NAME] have.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "polhode/scenario/orbit_kind.hpp"
#include "polhode/scenario/schema.hpp"
#include "text/number_text.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

constexpr Key orbit_gm_key = {
    .path = "gm",
    .type = KeyType::number,
    .dimension = Dimension::gm,
    .example = "\"398600.4418 km3/s2\"",
    .help =
        "Gravitational parameter: it gives the period of a Kepler orbit, and a perturbation "
        "that names the orbit takes it. With kind ephemeris left out: that of the target.",
    .needed_by = "kepler|state"};

constexpr Key orbit_epoch_key = {
    .path = "epoch",
    .type = KeyType::number,
    .dimension = Dimension::time,
    .fallback = "0",
    .example = "0",
    .help = "The time t that these elements, or position and velocity, belong to."};

// To two digits, for messages.
inline double rounded(double x) {
  if (!(x > 0.0) || !std::isfinite(x)) return x;
  const double unit = std::pow(10.0, std::floor(std::log10(x)) - 1.0);
  return std::round(x / unit) * unit;
}

constexpr Key allow_coarse_key = {
    .path = "allow_coarse",
    .type = KeyType::boolean,
    .fallback = "false",
    .example = "true",
    .help =
        "Whether rows may be so far apart that the interpolation errs by more than 0.01 of the "
        "distance, or of the largest eccentricity or inclination. Above 1e-4 (of elements "
        "1e-3) there is a warning."};

// The warning of rows whose interpolation error is more than `noticeable` or cannot be estimated
// (NaN); otherwise nothing. Rejects coarse rows.
inline std::vector<std::string> rows_warning(const OrbitContext& at, std::string_view key,
                                             double error, double noticeable, std::string_view of) {
  constexpr double coarse = 1e-2;
  if (std::isnan(error))
    return {at.noted(key, "the interpolation error cannot be estimated from so few rows")};
  if (!(error > noticeable)) return {};
  const std::string said = fmt::format(
      "rows that are too far apart: between them the interpolation errs by about {:.1g} of {}",
      error, of);
  if (error > coarse && !at.flag("allow_coarse"))
    at.refuse(key, fmt::format("{}; expected at most {}, or allow_coarse = true in its table", said,
                               coarse));
  return {at.noted(key, said)};
}

constexpr Key orbit_axes_key = {
    .path = "axes",
    .type = KeyType::choice,
    .allowed = "inertial|ecliptic-J2000|equator-J2000",
    .example = "\"equator-J2000\"",
    .help =
        "The axes of the elements, of position and velocity or of the rows; left out, those "
        "of `state.axes`."};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
