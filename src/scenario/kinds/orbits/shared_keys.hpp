// SPDX-License-Identifier: MIT
// Keys that several kinds of [orbit.NAME] have.
#pragma once

#include "polhode/scenario/schema.hpp"

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
