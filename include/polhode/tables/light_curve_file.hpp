// SPDX-License-Identifier: MIT
// LightCurveFile: the light curves of a file, with what the file or its reader declares of them.
// Readers: lc.hpp, alcdef.hpp, light_columns.hpp.
//
// Units       t in seconds of TT from `epoch`, so that leap seconds are counted; where there is
//             none, as the file has it. Fluxes of magnitudes: those of a source of `zero_magnitude`
//             are 1.
// Domain      what is not declared is not known: no light time, no axes and no errors are guessed.
// Accuracy    a Julian date keeps all of its digits until the epoch is taken from it.
// Errors      require_sound: DomainError "FILE:LINE: ..." for the first flaw (polhode/light/
//             light_curve_checks.hpp), and for calibrated sessions that have no common scale.
// Cost        plain values.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "polhode/ephemeris/date.hpp"
#include "polhode/light/light_curve.hpp"
#include "polhode/light/light_time.hpp"

namespace polhode {
inline namespace v0 {
namespace io {

// From which distances fluxes are: those of the time, or one au from Sun and observer.
enum class Distances { unknown, of_the_time, unit };

struct LightSession {
  light::LightCurve curve;
  std::optional<light::LightTime> times;  // none: not declared
  std::optional<double> light_time;       // s, from the body to the observer, as the file says
  Distances distances = Distances::unknown;
  std::string band;                      // as the file calls it; may be empty
  std::optional<double> zero_magnitude;  // none: the file has fluxes
  std::size_t line = 0;                  // of the file, from 1: where the session begins
  std::vector<std::size_t> lines = {};   // where each of its points stands
  // Lines of points that were left out, as the reader was told. They are not parsed; a session may
  // have no other points.
  std::vector<std::size_t> left_out = {};
  std::vector<std::pair<std::string, std::string>> notes = {};  // all that the file says of it
};

struct LightCurveFile {
  std::string file;                      // as messages show it
  std::string object;                    // what was observed; may be empty
  std::optional<ephemeris::Date> epoch;  // of t = 0, in the time scale of the file
  std::string axes;                      // of the vectors: "ecliptic-J2000"; empty: not declared
  std::string length;                    // their unit: "au"; empty: not declared
  std::vector<LightSession> sessions;
};

std::vector<light::LightCurve> light_curves(const LightCurveFile& file);
void require_sound(const LightCurveFile& file, const light::LightCurveNeeds& needs = {});

// Light curves in ALCDEF, the Asteroid Lightcurve Data Exchange Format (Stephens et al.
// 2010; versions 1 and 2).
//
// Equations   those of magnitudes (polhode/light/light_curve.hpp).
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

// `name` stands for the file in messages; `leave_out` has lines of points, from 1.
LightCurveFile alcdef_from_text(std::string_view text, const std::string& name,
                                const std::optional<ephemeris::Date>& epoch = std::nullopt,
                                std::span<const std::size_t> leave_out = {});
LightCurveFile read_alcdef(const std::string& path,
                           const std::optional<ephemeris::Date>& epoch = std::nullopt,
                           std::span<const std::size_t> leave_out = {});

struct AlcdefHead {
  std::string object;
  light::LightTime times = light::LightTime::at_body;
  bool is_of_the_time = false;  // or reduced to unit distances
  std::vector<std::string> notes = {};
};
// Magnitudes of light curves with t in seconds of TT from an epoch, without their vectors.
std::string alcdef_text(std::span<const light::LightCurve> curves, const ephemeris::Date& epoch,
                        const AlcdefHead& head);

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

// `name` stands for the file in messages; `leave_out` has lines of points, from 1.
LightCurveFile lc_from_text(std::string_view text, const std::string& name,
                            ephemeris::TimeScale scale,
                            const std::optional<ephemeris::Date>& epoch = std::nullopt,
                            std::span<const std::size_t> leave_out = {});
LightCurveFile read_lc(const std::string& path, ephemeris::TimeScale scale,
                       const std::optional<ephemeris::Date>& epoch = std::nullopt,
                       std::span<const std::size_t> leave_out = {});

// Of light curves with t in seconds of TT from an epoch, at the body, and vectors in au along the
// ecliptic of J2000; dates in the scale of the epoch.
std::string lc_text(std::span<const light::LightCurve> curves, const ephemeris::Date& epoch);

// Light curves in plain columns: what each column holds is the caller's to say.
//
// Equations   those of magnitudes (polhode/light/light_curve.hpp).
// Units       those of the file; with dates t is in seconds of TT from an epoch.
// Domain      a table as polhode/tables/number_table.hpp reads it: CSV or blanks, columns by name
//             or number, comments, .gz. Rows of one number in the column `session` are one session,
//             wherever they stand; without that column all rows are. Magnitudes become fluxes:
//             relative ones with the mean 1, calibrated ones with the zero magnitude 0.
// Accuracy    the nearest double; of dates to 1e-11 s from the epoch, which is midnight before the
//             first row unless it is given.
// Errors      DomainError "FILE:LINE: ..." for the first thing wrong in the file, "FILE: ..." for
//             columns that do not go together. light_csv: DomainError for calibrated and relative
//             sessions in one table, a number that is not finite, a session without points, or no
//             session.
// Cost        that of the table; dates 0.5 us more a row, in TDB 8 us.

struct LightColumns {
  enum class Times { numbers, julian_dates, dates };
  using Three = std::array<std::string, 3>;

  std::string time = "t";
  Times form = Times::numbers;
  double julian_zero = 0.0;  // 2400000.5 for modified Julian dates
  ephemeris::TimeScale scale = ephemeris::TimeScale::UTC;
  std::optional<ephemeris::Date> epoch = {};

  std::string flux = {};       // this or
  std::string magnitude = {};  // this
  std::string sigma = {};      // of flux or magnitude
  double one_sigma = 0.0;      // without that column: of all points
  Three to_sun = {};           // all three or none
  Three to_observer = {};
  std::string session = {};
  std::vector<std::size_t> leave_out = {};  // lines of the file, from 1

  bool is_calibrated = false;
  std::optional<light::LightTime> times = {};
  Distances distances = Distances::unknown;
  std::string band = {};
  std::string axes = {};
  std::string length = {};
};

LightCurveFile read_light_columns(const std::string& path, const LightColumns& columns);

// The columns session (from 1), t, flux, sigma and, where any point has a vector, sun_x, sun_y,
// sun_z, observer_x, observer_y, observer_z. Notes stand above them as comments, then one for each
// session with its name and whether it is calibrated, as all are or none is.
std::string light_csv(std::span<const light::LightCurve> curves,
                      std::span<const std::string> notes = {});
// The same in the columns that such a reader is told: their names, and magnitudes in place of
// fluxes; a column without a name is left out. `time_text` writes times.
std::string light_csv(std::span<const light::LightCurve> curves, std::span<const std::string> notes,
                      const LightColumns& columns,
                      const std::function<std::string(double t)>& time_text);
// How such a table is read back: whether it is calibrated its columns do not say.
LightColumns light_csv_columns(bool has_vectors, bool is_calibrated = false);

}  // namespace io
}  // namespace v0
}  // namespace polhode
