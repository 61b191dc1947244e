// SPDX-License-Identifier: MIT
// In this header: observation, observation_kind.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "polhode/ephemeris/date.hpp"
#include "polhode/fit/snapshots.hpp"
#include "polhode/light/light_curve.hpp"
#include "polhode/light/light_time.hpp"
#include "polhode/math/quaternion.hpp"
#include "polhode/math/vector.hpp"
#include "polhode/scenario/perturbation_kind.hpp"
#include "polhode/scenario/schema.hpp"
#include "polhode/text/citation.hpp"
#include "polhode/text/key_values.hpp"
#include "polhode/text/kind_key.hpp"

namespace polhode {
inline namespace v0 {
namespace io {

// Observation: what one table [[observation]] of a scenario of kind "fit" says: a file of rows that
// were seen, its columns, their units, clock and errors; and the rows themselves, once they are
// read.
//
// Equations   t of a row is that at the body: of times at the observer, less the light time. An
//             attitude along other axes of the sky is turned to those of the state.
// Units       core units (polhode/text/units.hpp).
// Domain      rows in order of time within a table; equal times are other observers. Files are read
//             by read_observations, not with the scenario. Attitudes, directions and rates refer to
//             the body axes that the file gives vectors in.
// Accuracy    a date to 1e-11 s from the epoch; a unit costs at most two roundings.
// Errors      read_observations: DomainError "FILE:LINE: ..." for a row that is out of order or
//             comes twice, an error that is not above 0, no attitude, a direction of length 0;
//             ScenarioError at the place of a key that does not fit the file.
// Cost        a microsecond a row; dates 0.5 us more, in TDB 8 us.
struct Scenario;

// The motion at one time, as a simulation observes it.
struct BodyMotion {
  double t;
  Quaternion q;  // body axes of the file to inertial ones
  Vec3 w_F;      // along these body axes
};
// A row of a file: its time and errors in core units, the numbers between them as they stand there.
struct FileRow {
  double t;
  std::vector<double> numbers;
  std::vector<double> sigmas = {};
};
// Standard normal numbers of a row, by their places.
using RowNoise = std::function<double(std::size_t)>;

// What the rows of a table are, as its kind has made it of its keys (observation_kind.hpp). The
// functions may be called from any thread.
struct ObservedRows {
  std::vector<std::string> columns;               // time first
  std::vector<std::string> sigma_columns;         // one, or one for each error
  std::vector<double> sigmas;                     // core units; empty: in columns
  std::size_t numbers = 0;                        // behind the time
  std::vector<double> error_units;                // core units of each error in a column
  std::vector<std::size_t> turning_degrees = {};  // numbers in degrees that run through a turn
  // Adds what was read; a DomainError gets the line of the file.
  std::function<void(const FileRow&, fit::Snapshots&)> read;
  // Adds what is seen of a motion, with noise of these errors.
  std::function<void(const BodyMotion&, const RowNoise&, const std::vector<double>& sigmas,
                     fit::Snapshots&)>
      simulate;
  // The rows of a file.
  std::function<std::vector<FileRow>(const fit::Snapshots&)> written;
};

enum class ObservedAxes { inertial, ecliptic, equator };

// Light curves. Errors without a column are parts of the mean flux, or magnitudes.
struct LightObservation {
  enum class Format { columns, lc, alcdef };
  enum class Brightness { flux, magnitude };

  std::optional<ObservedAxes> axes = std::nullopt;
  Format format = Format::columns;
  Brightness brightness = Brightness::flux;
  std::vector<std::string> columns;  // time first; never empty
  std::optional<double> sigma = std::nullopt;
  std::vector<std::string> sigma_columns;
  std::vector<std::string> session_column, sun_columns, observer_columns;  // 1, 3 and 3, or none
  std::vector<std::string> sessions;   // whole numbers from 1: those that are taken; empty: all
  std::vector<std::string> leave_out;  // whole numbers from 1: lines without their points
  std::optional<Vec3> to_sun = std::nullopt;  // of all points, where no columns have them
  std::optional<Vec3> to_observer = std::nullopt;
  std::string orbit;  // of the body about the Sun, from which vectors and light time follow
  std::string observer_orbit;
  bool is_calibrated = false;
  bool sorts = false;           // points by time, as they are read
  bool is_of_the_time = false;  // fluxes from the distances of the vectors, not from unit ones
};

struct Observation {
  enum class TimeFormat { number, julian, modified_julian, date };

  std::string kind;  // "attitude"
  Place place = {};  // of the kind
  std::string name;  // of the table; may be empty
  std::string file;  // as the scenario names it
  TimeFormat time_format = TimeFormat::number;
  std::optional<ephemeris::TimeScale> time_scale = std::nullopt;  // of dates
  std::string time_unit;  // of numbers; empty: that of the file
  light::LightTime times = light::LightTime::at_body;
  // For times at the observer. Points of light curves without it use their own distance.
  std::optional<double> light_time = std::nullopt;
  // One of the two.
  ObservedRows rows = {};
  std::optional<LightObservation> light = std::nullopt;

  // For messages: its name, or else its file.
  const std::string& shown() const { return name.empty() ? file : name; }
};

// Where a row was read.
struct ObservedRow {
  std::size_t table = 0;   // among the observations, from 0
  std::uint32_t line = 0;  // of the file, from 1
};
struct ReadObservations {
  fit::Snapshots seen;
  // As those of `seen`.
  std::vector<ObservedRow> attitudes, directions, rates, measurements;
  std::vector<light::LightCurve> curves;  // times at the body, vectors along the axes of the state
  std::vector<std::vector<ObservedRow>> curve_rows;  // of their points
  std::vector<std::string> notes = {};               // on numbers that may not be what they seem
};

// Of a scenario of kind "fit", whose document it still holds.
ReadObservations read_observations(const Scenario& scenario);

// The text of a file of the observation `table`, with these rows in its columns, that
// read_observations reads back. DomainError for columns that have no names, and for errors that are
// columns.
std::string observation_text(const Scenario& scenario, std::size_t table,
                             const fit::Snapshots& rows, std::span<const std::string> notes = {});
// The same of light curves; ScenarioError for what their format cannot hold.
std::string light_curve_text(const Scenario& scenario, std::size_t table,
                             std::span<const light::LightCurve> curves,
                             std::span<const std::string> notes = {});
// Points at times of the body with the vectors that the keys of the table give; ScenarioError where
// none do.
light::LightCurve with_vectors_of(const Scenario& scenario, std::size_t table,
                                  light::LightCurve curve);

// ObservationKind: all that there is to say of one kind of [[observation]]: its keys, and what the
// rows of its files are. Readers, schema, pages, templates, fits and simulations come from it;
// docs/extending/observation.md adds one.
//
// Equations   none of its own.
// Units       core units (polhode/text/units.hpp).
// Domain      each table also has the keys of all kinds: name, file and those of the times. q and w
//             of a motion refer to the body axes of the file and to inertial axes.
// Accuracy    derivatives of a MeasuredRows are central differences, to about 1e-10.
// Errors      a builder throws a DomainError, or says by TermContext::refuse what it expected: both
//             become a ScenarioError at the place in the file. It may be called from any thread.

// Texts are constant data: they outlive every kind.
struct ObservationKind {
  std::string_view name;       // "attitude"
  std::string_view help;       // what its rows are
  std::vector<Key> keys;       // paths are their own names
  std::string_view sets = {};  // exactly one of "sigma|sigma_columns" is there; empty: none such
  // Fills in `rows`, or `light`; the keys of all kinds are there.
  std::function<void(Observation&, const TermContext&)> made = {};
  std::vector<Citation> citations = {};
};

// A kind whose arguments are a plain struct A, filled by its keys.
template <class A>
ObservationKind observation_kind(std::string_view name, std::string_view help,
                                 std::span<const KindKey<A>> keys,
                                 ObservedRows (*made)(const A&, const TermContext&)) {
  return {.name = name,
          .help = help,
          .keys = keys_of(keys),
          .made = [all = std::vector<KindKey<A>>(keys.begin(), keys.end()), made](
                      Observation& of, const TermContext& at) {
            of.rows = made(arguments<A>(all, at), at);
          }};
}

// Numbers that are a function of the motion.
struct MeasuredColumn {
  std::string name;
  Dimension dimension;
};
struct MeasuredRows {
  std::vector<MeasuredColumn> columns;  // behind the time; angles are compared modulo a turn
  std::vector<double> sigmas;           // the standard error of each
  fit::MotionFunction numbers;          // of each
};
// The rows of such a table: the columns have their own names, in the units of the file.
ObservedRows observed_rows(MeasuredRows measured, const TermContext& at);

}  // namespace io
}  // namespace v0
}  // namespace polhode
