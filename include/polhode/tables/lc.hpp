// SPDX-License-Identifier: MIT
// Light curves in the format `lc` of DAMIT and of convexinv.
//
// Units       in the file Julian dates, vectors in au along the axes of ecliptic and equinox of
//             J2000, fluxes in any unit.
// Domain      text of at most 256 MiB: how many light curves there are; for each how many points
//             and 0 (relative) or 1 (calibrated); for each point the Julian date, the flux, the
//             vector from the body to the Sun and the one to the Earth, all in one line. By the
//             convention of the format dates are corrected for light time, and calibrated fluxes
//             are those of unit distances. There are no errors in it: sigma is 0
//             (with_relative_sigma). The time scale is nowhere said, so that the caller says it.
//             Blank lines are skipped.
// Accuracy    the nearest double; of dates to 1e-11 s from the epoch, which is midnight before the
//             first point unless it is given. Written dates have 12 decimals, 0.1 us.
// Errors      DomainError "FILE:LINE: ..." for the first thing wrong; lc_text for a point without
//             vectors or with a number that is not finite, a light curve without points, or none.
// Cost        a microsecond a point to read and to write; in TDB 8 us to read, 15 us to write.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "polhode/tables/light_curve_file.hpp"

namespace polhode {
inline namespace v0 {

// `name` stands for the file in messages; `leave_out` has lines of points, from 1.
LightCurveFile lc_from_text(std::string_view text, const std::string& name, TimeScale scale,
                            const std::optional<Date>& epoch = std::nullopt,
                            std::span<const std::size_t> leave_out = {});
LightCurveFile read_lc(const std::string& path, TimeScale scale,
                       const std::optional<Date>& epoch = std::nullopt,
                       std::span<const std::size_t> leave_out = {});

// Of light curves with t in seconds of TT from an epoch, at the body, and vectors in au along the
// ecliptic of J2000; dates in the scale of the epoch.
std::string lc_text(std::span<const LightCurve> curves, const Date& epoch);

}  // namespace v0
}  // namespace polhode
