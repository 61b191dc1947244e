// SPDX-License-Identifier: MIT
// From the values of a file to what moves the body: frame, terms, method, events.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "math/finite.hpp"
#include "output/obliquity_columns.hpp"
#include "polhode/output/columns.hpp"
#include "polhode/scenario/schema.hpp"
#include "scenario/scenario_parts.hpp"
#include "scenario/value_access.hpp"
#include "scenario/values.hpp"
#include "text/dates.hpp"
#include "text/number_text.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

constexpr double most_steps = 1e15;

// A run of more steps than a double can count would not end.
void check_step(const Rotation& rotation, const Values& values, const std::string& name) {
  if (!rotation.method || !rotation.time) return;
  const std::optional<double> step = method_traits(*rotation.method).step;
  if (!step) return;
  const SaveAt& rows = *rotation.time;
  const double farthest = std::max(std::fabs(rows[0]), std::fabs(rows.end()));
  if (farthest > most_steps * *step)
    refuse(values, has(values, "method.step") ? "method.step" : "method.kind", name,
           "expected a step of which 1e15 at most make the run");
}

// A date needs one of t = 0, in a scale that runs evenly.
void check_dates(const Rotation& rotation, const OutputPlan& output, const Values& values,
                 const std::string& name) {
  if (std::find(output.columns.begin(), output.columns.end(), "date") == output.columns.end())
    return;
  if (rotation.epoch.empty())
    refuse(values, "output.columns", name, "expected epoch in [state] for date");
  if (scale_of_epoch(rotation.epoch) == "UT1")
    refuse(values, "output.columns", name,
           "expected no date with an epoch in UT1, which does not run evenly");
}

// The columns of the pole are called after the axes.
void check_pole(const Rotation& rotation, const Values& values, const std::string& name) {
  const bool equator = rotation.axes == "equator-J2000";
  for (std::size_t i = 0; i < rotation.events.size(); ++i) {
    const std::string& column = rotation.events[i].column;
    const bool of_equator = column == "pole_ra" || column == "pole_dec";
    const bool of_others = column == "pole_lon" || column == "pole_lat";
    if ((of_equator && !equator) || (of_others && equator))
      refuse(values, "event[" + std::to_string(i) + "].column", name,
             std::string("expected ") + (equator ? "pole_ra or pole_dec" : "pole_lon or pole_lat") +
                 " with axes = \"" + rotation.axes + "\"");
  }
}

// The word is known, but to another kind of file.
void check_columns(const OutputPlan& output, const Values& values, const std::string& name) {
  const std::vector<std::string_view> ours = column_group_names(), of_spin = spin_column_groups();
  const auto is_in = [](const std::vector<std::string_view>& words, const std::string& word) {
    return std::find(words.begin(), words.end(), word) != words.end();
  };
  for (const std::string& column : output.columns)
    if (is_in(of_spin, column) && !is_in(ours, column))
      refuse(values, "output.columns", name,
             "expected columns of a rotation: " + column + " is one of kind = \"obliquity\"");
}

bool is_energy_there(const Rotation& rotation) { return rotor_system(rotation).has_energy(); }

std::string without_energy(const Rotation& rotation) {
  for (const AnyPerturbation& term : rotation.terms)
    if (!term.supports_energy())
      return "expected no energy, since a perturbation has none: " + term.name();
  return {};
}

// An integrated run visits its rows in order, and so does one that looks for events.
void check_times(const Rotation& rotation, const Values& values, const std::string& name) {
  const bool in_order = propagation_method(rotation).has_value() || !rotation.events.empty();
  if (!rotation.time || !in_order || !has(values, "time.at")) return;
  const SaveAt& rows = *rotation.time;
  const bool rises = rows[rows.size() - 1] >= rows[0];
  for (std::int64_t k = 1; k < rows.size(); ++k)
    if (rises ? rows[k] < rows[k - 1] : rows[k] > rows[k - 1])
      refuse(values, "time.at", name,
             propagation_method(rotation)
                 ? "expected times in order, rising or falling, since the run is integrated"
                 : "expected times in order, rising or falling, since events are looked for");
}

// Its own state asks for a method that carries it, and the columns of that state for a damper.
void check_damper(const Rotation& rotation, const OutputPlan& output, const Values& values,
                  const std::string& name) {
  if (rotation.damper) {
    if (rotation.method && !moves_any_state(*rotation.method))
      refuse(
          values, "method.kind", name,
          "expected \"adaptive\" or \"collocation\", since a Kane damper has a state of its own");
    return;
  }
  const auto is_its_own = [](std::string_view column) {
    return column == "damper" || column == "s1" || column == "s2" || column == "s3";
  };
  const char* const message = "expected a perturbation of kind \"kane-damper\" for it";
  if (std::any_of(output.columns.begin(), output.columns.end(), is_its_own))
    refuse(values, "output.columns", name, message);
  for (std::size_t i = 0; i < rotation.events.size(); ++i)
    if (is_its_own(rotation.events[i].column))
      refuse(values, "event[" + std::to_string(i) + "].column", name, message);
}

// Refuses forward steps from a start that the file has put behind stop.
void require_way(const Values& values, double start, double stop, const std::string& name) {
  if (is_explicit(values, "time.start") && start > stop && number(values, "time.step") > 0.0)
    refuse(values, "time.start", name, "expected a time before stop, since step is positive");
}

}  // namespace

Crossing crossing_of(const std::string& word) {
  if (word == "both") return Crossing::both;
  return word == "rising" ? Crossing::rising : Crossing::falling;
}

std::optional<Method> method_of(const KindContext& at) {
  const std::string path = "method";
  if (!has(at.values, path)) return std::nullopt;
  const std::string& name = word(at.values, "method.kind");
  const MethodKind* const kind = at.kinds.method(name);
  if (kind == nullptr)
    throw std::logic_error("method: the schema allows a kind without a description: " + name);
  const KeyValues table(at.values, at.units, path, at.name);
  return table.built("kind", [&] {
    Method made = kind->made(table);
    if (const MethodTraits traits = method_traits(made); traits.kind != name)
      throw DomainError("expected a kind whose methods have its name, not " + traits.kind);
    return made;
  });
}

bool has_automatic_rows(const Values& values) {
  return has(values, "time.step") && !value_at(values, "time.step").words.empty();
}

std::optional<SaveAt> span_of(const Values& values, const std::string& name) {
  return built(values, "time.stop", name, [&]() -> std::optional<SaveAt> {
    return SaveAt::count(number(values, "time.start"), number(values, "time.stop"), 2);
  });
}

// The attitude in the middle of two rows, a time h apart, is h^2/8 times the angular acceleration
// away from a rotation about a fixed axis. The largest one is looked for along the free rotation,
// with the torques there. Rows are at most a radian of rotation apart: a polynomial through 8 of
// them is off by less than 0.01 degrees, and none hides a whole turn.
std::optional<SaveAt> automatic_times(const Rotation& rotation, const Values& values,
                                      const std::string& name) {
  constexpr double usual = 0.01 * std::numbers::pi / 180.0;
  constexpr double margin = 0.9, largest_turn = 1.0, most_rows = 1e8;
  constexpr int looks = 128;
  const double start = number(values, "time.start"), stop = number(values, "time.stop");
  if (has(values, "time.error")) require_range(values, "time.error", name);
  const double error = has(values, "time.error") ? number(values, "time.error") : usual;
  const DampedProblem problem = rotor_problem(rotation);
  const System& system = problem.system;
  const FreeRotation motion(rotation.body, inertial_state(system, 0.0, problem.initial.rotor));
  const double span = stop - start, period = std::fabs(motion.polhode_period());
  double acceleration = 0.0, rate = 0.0;
  const auto look = [&](double t) {
    const RotorState s = reference_state(system, t, motion.at(t));
    const Vec3 w = angular_velocity(system, t, s).inertial;
    const Effect e = terms_effect(system, Setting{system.body(), t, s, system.frame().at(t).q_IS});
    const Vec3 moment = cross(s.g, w) + e.u;
    const Vec3& I = system.body().moments();
    acceleration = larger(acceleration, norm(Vec3{moment.x / I.x, moment.y / I.y, moment.z / I.z}));
    rate = larger(rate, norm(w));
  };
  for (int k = 0; k < looks; ++k) {
    const double part = static_cast<double>(k) / looks;
    look(start + part * span);
    if (period < std::fabs(span)) look(start + std::copysign(part * period, span));
  }
  const double step = std::min(margin * std::sqrt(8.0 * error / acceleration), largest_turn / rate);
  if (std::isnan(acceleration))
    refuse(values, "time.step", name, "expected torques that are numbers along the free rotation");
  const double steps = std::isnan(step) ? 1.0 : std::max(std::ceil(std::fabs(span) / step), 1.0);
  if (!(steps < most_rows))
    refuse(values, "time.step", name,
           "it takes " + number_text(steps) + " rows; expected an error that 1e8 rows can keep");
  return built(values, "time.step", name, [&]() -> std::optional<SaveAt> {
    return SaveAt::count(start, stop, static_cast<std::int64_t>(steps) + 1);
  });
}

std::optional<SaveAt> times_of(const Values& values, const std::string& name, bool any_sign) {
  if (!has(values, "time")) return std::nullopt;
  const double start = number(values, "time.start");
  if (has_automatic_rows(values))
    refuse(values, "time.step", name, "expected a number: automatic rows are those of a rotation");
  if (is_explicit(values, "time.error"))
    refuse(values, "time.error", name, "expected step = \"auto\" together with it");
  if (has(values, "time.at")) {
    if (is_explicit(values, "time.start"))
      return built(values, "time.start", name, []() -> std::optional<SaveAt> {
        throw DomainError("expected no start together with at, which lists every time");
      });
    return SaveAt::times(value_at(values, "time.at").numbers);
  }
  const double stop = number(values, "time.stop");
  if (!any_sign && has(values, "time.step")) require_way(values, start, stop, name);
  if (has(values, "time.step"))
    return built(values, "time.step", name, [&]() -> std::optional<SaveAt> {
      const double step = number(values, "time.step");
      return SaveAt::steps(start, stop, any_sign ? std::copysign(step, stop - start) : step);
    });
  return built(values, "time.count", name, [&]() -> std::optional<SaveAt> {
    return SaveAt::count(start, stop, value_at(values, "time.count").whole);
  });
}

std::vector<std::string> array_paths(const Values& values, const std::string& array) {
  std::vector<std::string> paths;
  for (;;) {
    const std::string path = array + "[" + std::to_string(paths.size()) + "]";
    const auto first = values.lower_bound(path + ".");
    if (first == values.end() || !first->first.starts_with(path + ".")) return paths;
    paths.push_back(path);
  }
}

std::vector<ScenarioEvent> events_of(const KindContext& at) {
  const Values& values = at.values;
  const std::string& name = at.name;
  const std::span<const ChartKind> charts = at.kinds.charts();
  std::vector<ScenarioEvent> events;
  const std::vector<std::string_view> known = column_names(charts);
  for (const std::string& path : array_paths(values, "event")) {
    const std::string& column = word(values, path + ".column");
    if (std::find(known.begin(), known.end(), column) == known.end())
      refuse(values, path + ".column", name,
             "expected a column such as \"theta\", \"L\" or \"w3\" (docs/reference/files.md)" +
                 did_you_mean(column, known));
    const std::string own = has(values, path + ".name") ? word(values, path + ".name") : column;
    for (const ScenarioEvent& other : events)
      if (other.name == own)
        refuse(values, path + (has(values, path + ".name") ? ".name" : ".column"), name,
               "expected a name of its own, since an event before it is called " + own);
    const double value = number(values, path + ".value");
    const std::string interval = path + ".interval";
    if (has(values, interval)) require_range(values, interval, name);
    events.push_back({own, column, at.units.to_core(value, column_dimension(column, charts)),
                      crossing_of(word(values, path + ".crossing")),
                      value_at(values, path + ".stops").whole == 1,
                      has(values, interval) ? number(values, interval) : 0.0});
  }
  return events;
}

void add_frame(Rotation& rotation, const KindContext& at) {
  rotation.frame_text = "inertial";
  for (const FrameKind& kind : at.kinds.frames()) {
    const std::string path = "frame." + std::string(kind.name);
    if (!has(at.values, path)) continue;
    const KeyValues table(at.values, at.units, path, at.name);
    MadeFrame made = built(at.values, path, at.name,
                           [&] { return kind.made(FrameContext(table, rotation.orbits)); });
    rotation.frame = std::move(made.frame);
    rotation.frame_text = std::move(made.text);
    rotation.precession = made.precession;
  }
}

namespace {

// A table of rates may end before the run does.
void check_frame(const Rotation& rotation, const Values& values, const std::string& name) {
  if (!rotation.time || rotation.frame.is_inertial()) return;
  const SaveAt& rows = *rotation.time;
  for (const double t : {0.0, rows[0], rows[rows.size() - 1], rows.end()}) {
    if (!std::isnan(rotation.frame.at(t).q_IS.w)) continue;
    std::string path = "frame";
    for (const char* key : {"frame.precessing.times", "frame.precessing.file"})
      if (has(values, key)) path = key;
    refuse(values, path, name,
           "expected a frame that is known for all of the run and at t = 0; nothing is known of it "
           "at t = " +
               number_text(t));
  }
}

}  // namespace

void check_motion(const Rotation& rotation, const OutputPlan& output, const Values& values,
                  const std::string& name) {
  check_times(rotation, values, name);
  check_frame(rotation, values, name);
  check_step(rotation, values, name);
  check_damper(rotation, output, values, name);
  check_columns(output, values, name);
  check_dates(rotation, output, values, name);
  check_pole(rotation, values, name);
  if (rotation.method && method_traits(*rotation.method).needs_flows)
    for (const AnyPerturbation& term : rotation.terms)
      if (!term.supports_flow())
        refuse(values, "method.kind", name,
               "expected \"adaptive\" or \"variation-of-constants\", since a perturbation has no "
               "exact flow: " +
                   term.name());
  if (is_energy_there(rotation)) return;
  if (std::any_of(output.columns.begin(), output.columns.end(), needs_energy))
    refuse(values, "output.columns", name, without_energy(rotation));
  for (std::size_t i = 0; i < rotation.events.size(); ++i)
    if (needs_energy(rotation.events[i].column))
      refuse(values, "event[" + std::to_string(i) + "].column", name, without_energy(rotation));
}

}  // namespace detail

const ScenarioOrbit& FrameContext::orbit(std::string_view key) const {
  return detail::orbit_named(orbits_, values(), key_path(key), file());
}

}  // namespace v0
}  // namespace polhode
