// SPDX-License-Identifier: MIT
// From the values of a file to what moves the body: frame, terms, method, events.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "output/obliquity_columns.hpp"
#include "polhode/scenario/schema.hpp"
#include "scenario/scenario_parts.hpp"
#include "scenario/tables/event.hpp"
#include "scenario/tables/head.hpp"
#include "scenario/tables/time.hpp"
#include "scenario/values.hpp"
#include "text/dates.hpp"
#include "text/number_text.hpp"
#include "text/value_access.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

constexpr double most_steps = 1e15;

// A run of more steps than a double can count would not end.
void check_step(const Rotation& rotation, const FileValues& file) {
  if (!rotation.method || !rotation.time) return;
  const std::optional<double> step = method_traits(*rotation.method).step;
  if (!step) return;
  const SaveAt& rows = *rotation.time;
  const double farthest = std::max(std::fabs(rows[0]), std::fabs(rows.end()));
  if (farthest > most_steps * *step)
    refuse(file.values, has(file.values, "method.step") ? "method.step" : "method.kind", file.name,
           "expected a step of which 1e15 at most make the run");
}

// A date needs one of t = 0, in a scale that runs evenly.
void check_dates(const Rotation& rotation, const KindContext& file) {
  if (std::ranges::find(file.output.columns, "date") == file.output.columns.end()) return;
  if (rotation.epoch.empty()) refuse_columns(file, "expected epoch in [state] for date");
  if (scale_of_epoch(rotation.epoch) == "UT1")
    refuse_columns(file, "expected no date with an epoch in UT1, which does not run evenly");
}

// The columns of the pole are called after the axes.
void check_pole(const Rotation& rotation, const FileValues& file) {
  const bool equator = rotation.axes == "equator-J2000";
  for (std::size_t i = 0; i < rotation.events.size(); ++i) {
    const std::string& column = rotation.events[i].column;
    const bool of_equator = column == "pole_ra" || column == "pole_dec";
    const bool of_others = column == "pole_lon" || column == "pole_lat";
    if ((of_equator && !equator) || (of_others && equator))
      refuse_event_column(file, i,
                          std::string("expected ") +
                              (equator ? "pole_ra or pole_dec" : "pole_lon or pole_lat") +
                              " with axes = \"" + rotation.axes + "\"");
  }
}

// The word is known, but to another kind of file.
void check_columns(const KindContext& file) {
  const std::vector<std::string_view> of_spin = spin_column_groups();
  for (const std::string& column : file.output.columns)
    if (file.kinds.columns().group(column) == nullptr &&
        std::ranges::find(of_spin, column) != of_spin.end())
      refuse_columns(
          file, "expected columns of a rotation: " + column + " is one of kind = \"obliquity\"");
}

bool is_energy_there(const Rotation& rotation) { return rotor_system(rotation).has_energy(); }

std::string without_energy(const Rotation& rotation) {
  for (const AnyPerturbation& term : rotation.terms)
    if (!term.supports_energy())
      return "expected no energy, since a perturbation has none: " + term.name();
  return {};
}

// An integrated run visits its rows in order, and so does one that looks for events.
void check_times(const Rotation& rotation, const FileValues& file) {
  const bool in_order = propagation_method(rotation).has_value() || !rotation.events.empty();
  if (!rotation.time || !in_order || !rotation.time->is_list()) return;
  const SaveAt& rows = *rotation.time;
  const bool rises = rows[rows.size() - 1] >= rows[0];
  for (std::int64_t k = 1; k < rows.size(); ++k)
    if (rises ? rows[k] < rows[k - 1] : rows[k] > rows[k - 1])
      time_table(file).refuse<&TimeTable::at>(
          propagation_method(rotation)
              ? "expected times in order, rising or falling, since the run is integrated"
              : "expected times in order, rising or falling, since events are looked for");
}

// Its own state asks for a method that carries it, and the columns of that state for a damper.
void check_damper(const Rotation& rotation, const KindContext& file) {
  if (rotation.damper) {
    if (rotation.method && !moves_any_state(*rotation.method))
      refuse_method(
          file,
          "expected \"adaptive\" or \"collocation\", since a Kane damper has a state of its own");
    return;
  }
  const auto is_its_own = [&](std::string_view column) {
    return file.kinds.columns().needs_damper(column);
  };
  const char* const message = "expected a perturbation of kind \"kane-damper\" for it";
  if (std::ranges::any_of(file.output.columns, is_its_own)) refuse_columns(file, message);
  for (std::size_t i = 0; i < rotation.events.size(); ++i)
    if (is_its_own(rotation.events[i].column)) refuse_event_column(file, i, message);
}

}  // namespace

void refuse_method(const FileValues& file, std::string_view message) {
  refuse(file.values, "method.kind", file.name, message);
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
void check_frame(const Rotation& rotation, const FileValues& file) {
  if (!rotation.time || rotation.frame.is_inertial()) return;
  const SaveAt& rows = *rotation.time;
  for (const double t : {0.0, rows[0], rows[rows.size() - 1], rows.end()}) {
    if (!std::isnan(rotation.frame.at(t).q_IS.w)) continue;
    std::string path = "frame";
    for (const char* key : {"frame.precessing.times", "frame.precessing.file"})
      if (has(file.values, key)) path = key;
    refuse(file.values, path, file.name,
           "expected a frame that is known for all of the run and at t = 0; nothing is known of it "
           "at t = " +
               polhode::detail::number_text(t));
  }
}

}  // namespace

void check_motion(const Rotation& rotation, const KindContext& file) {
  check_times(rotation, file);
  check_frame(rotation, file);
  check_step(rotation, file);
  check_damper(rotation, file);
  check_columns(file);
  check_dates(rotation, file);
  check_pole(rotation, file);
  if (rotation.method && method_traits(*rotation.method).needs_flows)
    for (const AnyPerturbation& term : rotation.terms)
      if (!term.supports_flow())
        refuse_method(
            file,
            "expected \"adaptive\" or \"variation-of-constants\", since a perturbation has no "
            "exact flow: " +
                term.name());
  if (is_energy_there(rotation)) return;
  const auto needs_energy = [&](std::string_view column) {
    return file.kinds.columns().needs_energy(column);
  };
  if (std::ranges::any_of(file.output.columns, needs_energy))
    refuse_columns(file, without_energy(rotation));
  for (std::size_t i = 0; i < rotation.events.size(); ++i)
    if (needs_energy(rotation.events[i].column))
      refuse_event_column(file, i, without_energy(rotation));
}

}  // namespace detail

const ScenarioOrbit& FrameContext::orbit(std::string_view key) const {
  return detail::orbit_named(orbits_, values(), key_path(key), file());
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
