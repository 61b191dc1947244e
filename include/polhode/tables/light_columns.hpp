// SPDX-License-Identifier: MIT
// Light curves in plain columns: what each column holds is the caller's to say.
//
// Equations   those of magnitudes (polhode/light/magnitudes.hpp).
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
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "polhode/tables/light_curve_file.hpp"

namespace polhode {
inline namespace v0 {

struct LightColumns {
  enum class Times { numbers, julian_dates, dates };
  using Three = std::array<std::string, 3>;

  std::string time = "t";
  Times form = Times::numbers;
  double julian_zero = 0.0;  // 2400000.5 for modified Julian dates
  TimeScale scale = TimeScale::UTC;
  std::optional<Date> epoch = {};

  std::string flux = {};       // this or
  std::string magnitude = {};  // this
  std::string sigma = {};      // of flux or magnitude
  double one_sigma = 0.0;      // without that column: of all points
  Three to_sun = {};           // all three or none
  Three to_observer = {};
  std::string session = {};
  std::vector<std::size_t> leave_out = {};  // lines of the file, from 1

  bool is_calibrated = false;
  std::optional<LightTime> times = {};
  Distances distances = Distances::unknown;
  std::string band = {};
  std::string axes = {};
  std::string length = {};
};

LightCurveFile read_light_columns(const std::string& path, const LightColumns& columns);

// The columns session (from 1), t, flux, sigma and, where any point has a vector, sun_x, sun_y,
// sun_z, observer_x, observer_y, observer_z. Notes stand above them as comments, then one for each
// session with its name and whether it is calibrated, as all are or none is.
std::string light_csv(std::span<const LightCurve> curves, std::span<const std::string> notes = {});
// The same in the columns that such a reader is told: their names, and magnitudes in place of
// fluxes; a column without a name is left out. `time_text` writes times.
std::string light_csv(std::span<const LightCurve> curves, std::span<const std::string> notes,
                      const LightColumns& columns,
                      const std::function<std::string(double t)>& time_text);
// How such a table is read back: whether it is calibrated its columns do not say.
LightColumns light_csv_columns(bool has_vectors, bool is_calibrated = false);

}  // namespace v0
}  // namespace polhode
