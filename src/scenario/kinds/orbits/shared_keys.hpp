// SPDX-License-Identifier: MIT
// Keys that several kinds of [orbit.NAME] have.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "polhode/scenario/orbit_kind.hpp"
#include "text/number_text.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

template <auto at, class A = Owner<at>>
consteval auto orbit_gm_key() {
  return quantity_key<at, A>(
             "gm", Dimension::gm,
             "Gravitational parameter: it gives the period of a Kepler orbit, and a perturbation "
             "that names the orbit takes it. With kind ephemeris left out: that of the target.")
      .example("\"398600.4418 km3/s2\"")
      .needed_by("kepler|state");
}

// The number of that key, if the table has it.
inline std::optional<double> positive_gm(const OrbitContext& at, std::optional<double> gm) {
  if (gm && !(*gm > 0.0)) at.refuse("gm", "expected a positive gravitational parameter");
  return gm;
}

template <auto at>
consteval auto orbit_epoch_key() {
  return quantity_key<at>("epoch", Dimension::time,
                          "The time t that these elements, or position and velocity, belong to.")
      .otherwise("0");
}

template <auto at>
consteval auto orbit_axes_key() {
  return word_key<at>("axes", "inertial|ecliptic-J2000|equator-J2000",
                      "The axes of the elements, of position and velocity or of the rows; left "
                      "out, those of `state.axes`.")
      .example("\"equator-J2000\"");
}

// The axes of the key, or those of the state; both must be inertial or both of J2000.
inline std::string orbit_axes(const OrbitContext& at, const std::optional<std::string>& own) {
  const std::string of_state = at.state_axes();
  if (own && (*own == "inertial") != (of_state == "inertial"))
    at.refuse("axes",
              "expected axes that have a known place in those of the state, which are " + of_state);
  return own.value_or(of_state);
}

template <auto at>
consteval auto order_key(std::string_view help) {
  return integer_key<at>("order", help).example("10");
}

// The order for the constructor of an orbit: 0 selects its default; it rejects invalid orders.
inline int order_of(std::optional<std::int64_t> order) {
  return order ? static_cast<int>(std::clamp<std::int64_t>(*order, 1, 99)) : 0;
}

// To two digits, for messages.
inline double rounded(double x) {
  if (!(x > 0.0) || !std::isfinite(x)) return x;
  const double unit = std::pow(10.0, std::floor(std::log10(x)) - 1.0);
  return std::round(x / unit) * unit;
}

template <auto at>
consteval auto allow_coarse_key() {
  return flag_key<at>(
             "allow_coarse",
             "Whether rows may be so far apart that the interpolation errs by more than 0.01 of "
             "the distance, or of the largest eccentricity or inclination. Above 1e-4 (of "
             "elements 1e-3) there is a warning.")
      .otherwise("false")
      .example("true");
}

// The warning of rows whose interpolation error is more than `noticeable` or cannot be estimated
// (NaN); otherwise nothing. Rejects coarse rows that are not allowed.
inline std::vector<std::string> rows_warning(const OrbitContext& at, std::string_view key,
                                             double error, double noticeable, std::string_view of,
                                             bool allow_coarse) {
  constexpr double coarse = 1e-2;
  if (std::isnan(error))
    return {at.noted(key, "the interpolation error cannot be estimated from so few rows")};
  if (!(error > noticeable)) return {};
  const std::string said = fmt::format(
      "rows that are too far apart: between them the interpolation errs by about {:.1g} of {}",
      error, of);
  if (error > coarse && !allow_coarse)
    at.refuse(key, fmt::format("{}; expected at most {}, or allow_coarse = true in its table", said,
                               coarse));
  return {at.noted(key, said)};
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
