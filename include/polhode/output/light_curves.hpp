// SPDX-License-Identifier: MIT
// Files of light curves: DAMIT's `lc`, and CSV.
//
// Units       lc: t in seconds of TT from the epoch, vectors in au along the ecliptic of J2000.
//             CSV: as the light curves have them.
// Domain      a file is written as PATH.part and renamed when it is complete; "-" is standard
//             output. What the formats hold: polhode/tables/light_curve_file.hpp.
// Accuracy    CSV: the shortest numbers that read back to the same doubles; lc: the same, but dates
//             to 12 decimals.
// Errors      DomainError for what the format cannot hold and for a path that cannot be had,
//             OutputError when writing fails.
// Cost        a microsecond a point, of lc in TDB 15 us; the text is held.
#pragma once

#include <span>
#include <string>

#include "polhode/ephemeris/date.hpp"
#include "polhode/light/light_curve.hpp"

namespace polhode {
inline namespace v0 {
namespace io {

void write_lc(const std::string& path, std::span<const light::LightCurve> curves,
              const ephemeris::Date& epoch);
void write_light_csv(const std::string& path, std::span<const light::LightCurve> curves,
                     std::span<const std::string> notes = {});

}  // namespace io
}  // namespace v0
}  // namespace polhode
