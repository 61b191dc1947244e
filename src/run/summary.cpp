// SPDX-License-Identifier: MIT
// Summaries of scenarios and of their runs, line by line.
#include "polhode/run/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <variant>

#include "polhode/free/rounding_sensitivity.hpp"
#include "polhode/free/tumbler.hpp"
#include "polhode/scenario/scenario.hpp"
#include "polhode/text/units.hpp"
#include "run/detail/experiments.hpp"
#include "run/detail/summary_lines.hpp"
#include "text/json.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

namespace {

constexpr double turn = 2.0 * std::numbers::pi;

struct Pole {
  double longitude;
  double latitude;
};

// Of a state in inertial axes; |G| > 0.
Pole pole_of(const RotorState& state) {
  const Vec3 k = inertial_momentum(state);
  const double longitude = std::atan2(k.y, k.x);
  return {longitude < 0.0 ? longitude + turn : longitude, std::atan2(k.z, std::hypot(k.x, k.y))};
}

// What the two angles of a pole are called.
std::string pole_label(const Rotation& rotation) {
  if (rotation.axes == "equator-J2000") return "pole (RA, Dec)";
  return rotation.axes == "ecliptic-J2000" ? "pole (ecliptic longitude, latitude)"
                                           : "pole (longitude, latitude)";
}

std::string short_mode(Regime regime) {
  switch (regime) {
    case Regime::rest:
      return "at rest";
    case Regime::steady:
      return "steady spin";
    case Regime::short_axis:
      return "SAM";
    case Regime::long_axis:
      return "LAM";
    case Regime::separatrix:
      return "separatrix";
  }
  return {};
}

std::string mode_text(Regime regime) {
  switch (regime) {
    case Regime::rest:
      return "rest";
    case Regime::steady:
      return "steady spin about a principal axis";
    case Regime::short_axis:
      return "short-axis mode (SAM)";
    case Regime::long_axis:
      return "long-axis mode (LAM)";
    case Regime::separatrix:
      return "separatrix: about the intermediate axis, without a period";
  }
  return {};
}

bool tumbles(const FreeRotation& motion) {
  return motion.regime() == Regime::short_axis || motion.regime() == Regime::long_axis;
}

}  // namespace

void add_mode(Lines& lines, const Rotation& rotation, const FreeRotation& motion) {
  const bool is_free = rotation.terms.empty() && !rotation.damper;
  lines.text("mode", is_free ? "mode" : "mode (if free from t = 0 on)", mode_text(motion.regime()));
}

void add_periods(Lines& lines, const FreeRotation& motion) {
  lines.number("precession_period", "precession period P_phi (long axis)",
               turn / motion.precession_rate_long(), Dimension::time);
  if (tumbles(motion))
    lines.number("rotation_period", "rotation period P_psi", motion.polhode_period(),
                 Dimension::time);
  lines.number("short_axis_period", "precession period of the short axis",
               turn / motion.precession_rate_short(), Dimension::time);
}

void add_pole(Lines& lines, const Rotation& rotation, const RotorState& inertial) {
  const Pole pole = pole_of(inertial);
  lines.numbers("pole", pole_label(rotation), {pole.longitude, pole.latitude}, Dimension::angle);
}

namespace {

// "SAM, P_phi 30.56 h, P_psi 263 h, pole 250, -75 deg"
std::string spin_text(const System& system, const Units& units, double t, const RotorState& s) {
  const FreeRotation motion(system.body(), s, t);
  std::string text = short_mode(motion.regime());
  if (motion.regime() == Regime::rest) return text;
  const auto period = [&](double core) {
    return fmt::format("{:.8g} {}", units.from_core(core, Dimension::time), units.time());
  };
  text +=
      (tumbles(motion) ? ", P_phi " : ", period ") + period(turn / motion.precession_rate_long());
  if (tumbles(motion)) text += ", P_psi " + period(motion.polhode_period());
  const Pole pole = pole_of(inertial_state(system, t, s));
  return text + fmt::format(", pole {:.7g}, {:.7g} {}",
                            units.from_core(pole.longitude, Dimension::angle),
                            units.from_core(pole.latitude, Dimension::angle), units.angle());
}

// Radius and GM of the Sun, the planets and the Moon: report of the IAU working group on
// cartographic coordinates (Archinal et al. 2018), DE440.
struct KnownBody {
  const char* name;
  double gm;      // km3/s2
  double radius;  // km, mean
};
constexpr KnownBody known_bodies[] = {
    {"the Sun", 132712440041.3, 695700.0}, {"Mercury", 22031.87, 2439.4},
    {"Venus", 324858.59, 6051.8},          {"the Earth", 398600.44, 6371.0084},
    {"the Moon", 4902.8, 1737.4},          {"Mars", 42828.37, 3389.5},
    {"Jupiter", 126686531.9, 69911.0},     {"Saturn", 37931206.2, 58232.0},
    {"Uranus", 5793951.3, 25362.0},        {"Neptune", 6835099.97, 24622.0},
};
constexpr double same_gm = 1e-3;  // relative

// The least in a run, which begins at t = 0; the eccentricity changes evenly.
double least_pericentre(const ScenarioOrbit& orbit, const std::optional<SaveAt>& rows) {
  const KeplerElements& elements = *kepler_elements(orbit);
  const auto* const moving = std::get_if<PrecessingKeplerOrbit>(&orbit.motion);
  double least = elements.pericentre;
  if (moving == nullptr || moving->rates().eccentricity == 0.0 || !rows) return least;
  const double axis = elements.pericentre / (1.0 - elements.eccentricity);
  for (const double t : {0.0, (*rows)[0], (*rows)[rows->size() - 1]})
    least = std::min(least, axis * (1.0 - moving->eccentricity(t)));
  return least;
}

void add_low_orbit(Lines& lines, const ScenarioOrbit& orbit, const std::optional<SaveAt>& rows,
                   const Units& units) {
  const KeplerElements* const elements = kepler_elements(orbit);
  if (elements == nullptr || units.length() == "1") return;
  const Units of_bodies("s", "rad", "1", "km");
  const double km = units.from_core(least_pericentre(orbit, rows), Dimension::length) *
                    of_bodies.to_core(1.0, units.length(), Dimension::length);
  const double gm = units.from_core(elements->gm, Dimension::gm) *
                    of_bodies.to_core(1.0, units.label(Dimension::gm), Dimension::gm);
  for (const KnownBody& body : known_bodies) {
    if (!(std::fabs(gm - body.gm) < same_gm * body.gm) || !(km < body.radius)) continue;
    lines.text("orbit_" + orbit.name + "_note", "of the orbit " + orbit.name,
               fmt::format("its pericentre, {:.6g} km from the centre, is inside {} ({:.0f} km): "
                           "semi_major_axis is no altitude",
                           km, body.name, body.radius));
  }
}

// At t = 0. The motion is the free one in the axes of the reference frame.
void add_spin(Lines& lines, const Rotation& rotation, const FreeRotation& motion) {
  if (motion.regime() == Regime::rest) return;
  const Vec3& I = motion.body().moments();
  const double G = motion.momentum();
  // T/G twice: G^2 may be out of range
  lines.number("energy_ratio", "E/E0 (1: least energy for this G)",
               2.0 * (motion.energy() / G) * (std::max({I.x, I.y, I.z}) / G), Dimension::number);
  const TumblingAngles angles = tumbling_angles(motion);
  if (std::isfinite(angles.long_least)) {
    lines.numbers("long_axis_angles", "long axis from momentum, least, most",
                  {angles.long_least, angles.long_most}, Dimension::angle);
    lines.numbers("short_axis_angles", "short axis from momentum, least, most",
                  {angles.short_least, angles.short_most}, Dimension::angle);
  }
  if (motion.regime() == Regime::steady)
    lines.number("wobble_period", "period of a small wobble (limit)", motion.polhode_period(),
                 Dimension::time);
  add_pole(lines, rotation, inertial_state(rotor_system(rotation), 0.0, initial_state(rotation)));
}

// Mode, periods and pole at t = 0 and at the end of a run.
void add_change(Lines& lines, const Rotation& rotation, const Units& units, const Sample& end) {
  const System& system = rotor_system(rotation);
  lines.text("before", "at t = 0", spin_text(system, units, 0.0, initial_state(rotation)));
  lines.text(
      "after",
      fmt::format("at t = {:.10g} {}", units.from_core(end.t, Dimension::time), units.time()),
      spin_text(system, units, end.t, end.s));
}

// Notes on probable mistakes: a quaternion that looks scalar-last, an orbit inside its central
// body.
void add_doubts(Lines& lines, const Rotation& rotation, const Scenario& scenario) {
  constexpr double nearly_all = 0.99;
  const auto* const given = std::get_if<AttitudeRate>(&rotation.state);
  if (given != nullptr && std::fabs(given->q.z) > nearly_all)
    lines.text("quaternion_note", "of the quaternion",
               "a turn of nearly 180 deg about axis 3, or one that has its scalar last: it is "
               "[w, x, y, z] here");
  const std::vector<std::string>& columns = scenario.output.columns;
  if (rotation.frame.is_inertial() &&
      std::find(columns.begin(), columns.end(), "roll_pitch_yaw") != columns.end())
    lines.text("roll_pitch_yaw_note", "of roll, pitch and yaw",
               "they count from the inertial axes; [frame.local-vertical] makes them those of an "
               "orbit");
  for (const ScenarioOrbit& orbit : rotation.orbits)
    add_low_orbit(lines, orbit, rotation.time, scenario.units());
}

}  // namespace
}  // namespace detail

namespace {

using detail::Lines;

constexpr std::size_t most_events = 20;  // that a summary lists

double largest_moment(const Vec3& I) { return std::max({I.x, I.y, I.z}); }

std::string crossing_text(Crossing crossing) {
  if (crossing == Crossing::both) return "";
  return crossing == Crossing::rising ? ", rising" : ", falling";
}

// "table moon.csv, 1441 rows, t = 0 to 86400 s"
std::string orbit_text(const Units& units, const ScenarioOrbit& orbit) {
  const auto* table = std::get_if<TableOrbit>(&orbit.motion);
  if (table == nullptr) return any_orbit(orbit).name();
  return fmt::format("{}, {} rows, t = {:.10g} to {:.10g} {}",
                     orbit.text.empty() ? orbit.kind : orbit.text, table->table().times.size(),
                     units.from_core(table->first_time(), Dimension::time),
                     units.from_core(table->last_time(), Dimension::time), units.time());
}

// The error between the rows of a file.
void add_interpolation(Lines& lines, const ScenarioOrbit& orbit) {
  if (!orbit.interpolation_error) return;
  const double error = *orbit.interpolation_error;
  lines.text("orbit_" + orbit.name + "_error", "orbit " + orbit.name + ": interpolation error",
             std::isnan(error)
                 ? "unknown: too few rows to estimate it"
                 : fmt::format("about {:.0e} of the distance{}", error,
                               orbit.warnings.empty() ? "" : ": rows are too far apart"));
}

// What the doubles of the input leave open at the end of a free rotation.
void add_sensitivity(Lines& lines, const Rotation& rotation, const Units& units,
                     const FreeRotation& motion) {
  if (propagation_method(rotation) || !rotation.time || motion.regime() == Regime::rest) return;
  const SaveAt& time = *rotation.time;
  if (time.size() == 0) return;
  const double moved =
      units.from_core(free::rounding_sensitivity(motion, time[time.size() - 1]), Dimension::angle);
  // Of an order of magnitude one digit is known.
  lines.number("rounding_sensitivity", "an input rounding moves the end by",
               units.to_core(std::stod(fmt::format("{:.0e}", moved)), Dimension::angle),
               Dimension::angle);
}

// " m2"; empty of a number.
std::string after_number(const std::string& unit) { return unit == "1" ? "" : " " + unit; }

// "3 x 2 x 1 m, area 22 m2, 12 facets"
std::string size_text(const shape::FacetShape& mesh, const Units& units) {
  Vec3 least = mesh.vertices().front(), most = least;
  for (const Vec3& x : mesh.vertices())
    for (int i = 0; i < 3; ++i) {
      least[i] = std::fmin(least[i], x[i]);
      most[i] = std::fmax(most[i], x[i]);
    }
  const auto length = [&](int i) { return units.from_core(most[i] - least[i], Dimension::length); };
  return fmt::format("{:.4g} x {:.4g} x {:.4g}{}, area {:.4g}{}, {} facets", length(0), length(1),
                     length(2), after_number(units.label(Dimension::length)),
                     units.from_core(mesh.area(), Dimension::area),
                     after_number(units.label(Dimension::area)), mesh.triangles().size());
}
void add_meshes(Lines& lines, const Rotation& rotation, const Units& units) {
  if (rotation.shape)
    lines.text("shape", "shape " + rotation.shape->file, size_text(rotation.shape->mesh, units));
  for (std::size_t i = 0; i < rotation.surface_meshes.size(); ++i) {
    const NamedMesh& one = rotation.surface_meshes[i];
    lines.text("surface_" + std::to_string(i + 1), "surface " + one.file,
               size_text(one.mesh, units));
  }
}

// What moves the body, apart from its own spin.
void add_motion(Lines& lines, const Rotation& rotation, const Units& units,
                const ColumnKinds& columns) {
  if (!rotation.frame.is_inertial()) lines.text("frame", "reference frame", rotation.frame_text);
  for (const ScenarioOrbit& orbit : rotation.orbits) {
    const std::string key = "orbit_" + orbit.name, label = "orbit " + orbit.name;
    const KeplerElements* elements = kepler_elements(orbit);
    if (elements == nullptr)
      lines.text(key, label, orbit_text(units, orbit));
    else if (elements->eccentricity < 1.0)
      lines.number(key, label + ": period", 2.0 * std::numbers::pi / mean_motion(*elements),
                   Dimension::time);
    else
      lines.text(key, label, "hyperbola");
  }
  for (const ScenarioOrbit& orbit : rotation.orbits) add_interpolation(lines, orbit);
  for (std::size_t i = 0; i < rotation.terms.size(); ++i)
    lines.text("perturbation_" + std::to_string(i + 1), "perturbation", rotation.terms[i].name());
  if (rotation.damper)
    lines.text("perturbation_" + std::to_string(rotation.terms.size() + 1), "perturbation",
               "Kane damper");
  lines.text("method", "method", detail::propagation_text(rotation, units));
  for (std::size_t i = 0; i < rotation.events.size(); ++i) {
    const ScenarioEvent& event = rotation.events[i];
    const Dimension dimension = column_dimension(event.column, columns);
    lines.text("event_" + std::to_string(i + 1), "event " + event.name,
               event.column + " = " +
                   fmt::format("{:.10g}", units.from_core(event.value, dimension)) +
                   after_number(units.label(dimension)) + crossing_text(event.crossing) +
                   (event.stops ? ", stops the run" : ""));
  }
}

std::string direction_text(int direction) {
  if (direction == 0) return "touching";
  return direction > 0 ? "rising" : "falling";
}

void add_cost(Lines& lines, const Statistics& statistics, const std::string& of) {
  lines.number("steps", "steps", static_cast<double>(statistics.steps), Dimension::number);
  lines.number("rejected", "steps repeated", static_cast<double>(statistics.rejected),
               Dimension::number);
  lines.number("evaluations", "evaluations of the " + of,
               static_cast<double>(statistics.evaluations), Dimension::number);
}

std::string outcome_text(const Outcome& outcome) {
  switch (outcome.status) {
    case Outcome::Status::completed:
      return "completed";
    case Outcome::Status::stopped_by_event:
      return "stopped by an event";
    case Outcome::Status::failed:
      return "failed: " + outcome.advice;
  }
  return {};
}

}  // namespace

std::vector<SummaryLine> detail::summary(const Rotation& rotation, const Scenario& scenario) {
  const FreeRotation& motion = free_rotation(rotation);
  Lines lines(scenario.units());
  const Vec3& I = motion.body().moments();
  const double I3 = largest_moment(I);
  lines.text("title", "title", scenario.document.title);
  add_mode(lines, rotation, motion);
  lines.numbers("moments", "moments I1, I2, I3", {I.x, I.y, I.z}, Dimension::moment);
  lines.numbers("moment_ratios", "their ratios to the largest", {I.x / I3, I.y / I3, I.z / I3},
                Dimension::number);
  add_periods(lines, motion);
  if (motion.regime() == Regime::short_axis)
    lines.number("psi_max", "psi_max", psi_max(motion), Dimension::angle);
  lines.number("momentum", "angular momentum G", motion.momentum(), Dimension::momentum);
  lines.number("energy", "kinetic energy T", motion.energy(), Dimension::energy);
  add_spin(lines, rotation, motion);
  lines.number("modulus", "elliptic parameter m", motion.modulus().m(), Dimension::number);
  lines.number("complement", "its complement 1 - m", motion.modulus().m1(), Dimension::number);
  add_sensitivity(lines, rotation, scenario.units(), motion);
  lines.text("epoch", "epoch (t = 0)", rotation.epoch);
  if (!rotation.epoch.empty() && ephemeris::is_dubious(epoch_date(rotation.epoch)))
    lines.text("epoch_note", "of the epoch",
               "leap seconds of UTC are not known for this year; give the epoch in TT or TDB to be "
               "free of them");
  lines.text("axes", "inertial axes", rotation.axes);
  const Quaternion& q = motion.body().q_FB();
  if (!(q == Quaternion{}))
    lines.numbers("principal_axes", "principal axes in those of the tensor (quaternion)",
                  {q.w, q.x, q.y, q.z}, Dimension::number);
  add_motion(lines, rotation, scenario.units(), scenario.document.kinds->columns());
  add_meshes(lines, rotation, scenario.units());
  add_table_values(lines, scenario);
  add_doubts(lines, rotation, scenario);
  return lines.take();
}

void detail::add_table_values(Lines& lines, const Scenario& scenario) {
  for (const TableValues& of : model_values(scenario)) {
    std::string key = of.table;
    std::replace_if(
        key.begin(), key.end(), [](char c) { return c == '.' || c == '[' || c == '-'; }, '_');
    std::erase(key, ']');
    if (of.table.starts_with("perturbation")) lines.text(key + "_values", of.table, of.given);
    lines.text(key + "_defaults", of.table + ", not in the file", of.defaults);
  }
}

std::vector<SummaryLine> detail::report_lines(const Rotation& rotation, const Scenario& scenario,
                                              const RunReport& report, const std::string& events) {
  Lines lines(scenario.units());
  const bool is_exact = !propagation_method(rotation);
  if (!is_exact || has_events(rotation))
    add_report(lines, report, is_exact ? "" : "perturbations", events);
  if (report.end) add_change(lines, rotation, scenario.units(), *report.end);
  return lines.take();
}

void detail::add_report(Lines& lines, const RunReport& report, const std::string& evaluated,
                        const std::string& events) {
  lines.text("outcome", "outcome", outcome_text(report.outcome));
  lines.number("end", "the run ended at t", report.outcome.t, Dimension::time);
  if (!evaluated.empty()) add_cost(lines, report.statistics, evaluated);
  if (report.energy_change)
    lines.number("energy_change", "change of energy E - E(0)", *report.energy_change,
                 Dimension::energy);
  const std::size_t shown = std::min(report.events.size(), most_events);
  for (std::size_t i = 0; i < shown; ++i) {
    const RunEvent& event = report.events[i];
    lines.number("event_time_" + std::to_string(i + 1),
                 event.name + ", " + direction_text(event.direction) + ", at t", event.t,
                 Dimension::time);
  }
  const auto more = std::max(report.events_met, static_cast<std::int64_t>(report.events.size())) -
                    static_cast<std::int64_t>(shown);
  if (more > 0) lines.text("more_events", "and", std::to_string(more) + " events more: " + events);
}

std::string shown_number(const std::string& key, double number) {
  std::string nearest = fmt::format("{:.10g}", number);
  if (key != "psi_max" || !(number > 0.0) || !(std::stod(nearest) > number)) return nearest;
  const double unit = std::pow(10.0, std::floor(std::log10(number)) - 9.0);
  return fmt::format("{:.10g}", std::stod(nearest) - unit);
}

std::string summary_table(const std::vector<SummaryLine>& lines) {
  std::size_t width = 0;
  for (const SummaryLine& line : lines) width = std::max(width, line.label.size());
  std::string table;
  for (const SummaryLine& line : lines) {
    std::string value = line.text;
    for (const double number : line.numbers)
      value += (value.empty() ? "" : ", ") + shown_number(line.key, number);
    table += fmt::format("{:<{}}  {}{}{}\n", line.label, width, value, line.unit.empty() ? "" : " ",
                         line.unit);
  }
  return table;
}

std::string summary_json(const std::vector<SummaryLine>& lines) {
  detail::JsonWriter json;
  json.begin_object();
  for (const SummaryLine& line : lines) {
    json.key(line.key);
    if (line.numbers.empty()) {
      json.value(line.text);
      continue;
    }
    json.begin_object().key("value");
    if (line.numbers.size() > 1) json.begin_array();
    for (const double number : line.numbers) json.value(number);
    if (line.numbers.size() > 1) json.end_array();
    json.key("unit").value(line.unit.empty() ? "1" : line.unit).end_object();
  }
  json.end_object();
  return json.text();
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
