// SPDX-License-Identifier: MIT
// Light curves in ALCDEF, the Asteroid Lightcurve Data Exchange Format (Stephens et al.
// 2010; versions 1 and 2).
//
// Equations   those of magnitudes (polhode/light/magnitudes.hpp).
// Units       in the file Julian dates of UTC and magnitudes.
// Domain      text of at most 256 MiB. Each session is a block of KEYWORD=VALUE from STARTMETADATA
//             to ENDMETADATA, then lines DATA=JD|MAG|MAGERR|AIRMASS of which error and airmass may
//             be missing, up to ENDDATA, the next session or the end. DELIMITER is PIPE or TAB. All
//             sessions are of one object, by OBJECTNUMBER, OBJECTNAME or MPCDESIG: the first of
//             them that a session and one before it have. What is taken from the keywords:
//               DIFFERMAGS=FALSE with a STANDARD other than NONE and INTERNAL: calibrated, with
//               zero magnitude 0; else relative, with the mean flux 1.
//               LTCAPP: NONE, times at the observer; AVERAGE or POINT, at the body; all else is not
//               declared. LTCDAYS, the correction that was or would be added: minus the light time,
//               0 or less.
//               REDUCEDMAGS: NONE, distances of the time; AVERAGE or POINT, unit distances.
//             There are no vectors in it: they stay 0, for an orbit to give them (with_vectors).
//             Written keywords are OBJECTNAME, SESSIONDATE, SESSIONTIME, DELIMITER and those above
//             but LTCDAYS; a file sent to the database needs those of the observer as well.
// Accuracy    the nearest double; of dates to 1e-11 s from the epoch, which is midnight before the
//             first point unless it is given.
// Errors      DomainError "FILE:LINE: ..." for the first thing wrong; alcdef_text for a point whose
//             flux has no magnitude, a light curve without points, or none.
// Cost        some 0.5 us a point.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "polhode/tables/light_curve_file.hpp"

namespace polhode {
inline namespace v0 {

// `name` stands for the file in messages; `leave_out` has lines of points, from 1.
LightCurveFile alcdef_from_text(std::string_view text, const std::string& name,
                                const std::optional<Date>& epoch = std::nullopt,
                                std::span<const std::size_t> leave_out = {});
LightCurveFile read_alcdef(const std::string& path, const std::optional<Date>& epoch = std::nullopt,
                           std::span<const std::size_t> leave_out = {});

struct AlcdefHead {
  std::string object;
  LightTime times = LightTime::at_body;
  bool is_of_the_time = false;  // or reduced to unit distances
  std::vector<std::string> notes = {};
};
// Magnitudes of light curves with t in seconds of TT from an epoch, without their vectors.
std::string alcdef_text(std::span<const LightCurve> curves, const Date& epoch,
                        const AlcdefHead& head);

}  // namespace v0
}  // namespace polhode
