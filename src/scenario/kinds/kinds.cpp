// SPDX-License-Identifier: MIT
// The kinds that a scenario may name, checked before a file is read with them.
#include "polhode/scenario/kinds.hpp"

#include <algorithm>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "output/obliquity_columns.hpp"
#include "polhode/error.hpp"
#include "polhode/scenario/schema.hpp"
#include "scenario/detail/built_in_kinds.hpp"
#include "scenario/detail/experiment_kinds.hpp"
#include "scenario/detail/history_keys.hpp"
#include "scenario/detail/kind_rows.hpp"
#include "scenario/detail/schema_table.hpp"
#include "scenario/fit/observation_keys.hpp"
#include "scenario/tables/state.hpp"
#include "scenario/values.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

namespace {

// The parts of a kind of any sort that are checked.
struct KindParts {
  std::string_view sort;  // "perturbation"
  std::string_view name;
  std::string_view help;
  std::span<const Key> keys;
  std::string_view sets;
  bool is_made;  // whether it has a function that makes it
};

std::string quoted(std::string_view text) { return '"' + printable(text) + '"'; }

bool is_plain(std::string_view name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-';
  });
}

bool has_key(const KindParts& kind, std::string_view name) {
  return std::any_of(kind.keys.begin(), kind.keys.end(),
                     [&](const Key& key) { return key.path == name; });
}

void require_value(const std::string& where, const Key& key, const char* what,
                   std::string_view toml) {
  if (toml.empty()) return;
  if (const std::optional<std::string> wrong = why_not(key, toml))
    throw DomainError(where + ": " + what + " " + printable(toml) + ": " + *wrong);
}

void require_key(const std::string& where, const Key& key) {
  if (!is_name(key.path) || key.path == "kind")
    throw DomainError(where + "; expected letters, digits, - and _, and not \"kind\"");
  if (key.help.empty()) throw DomainError(where + ": got no text; expected one sentence");
  require_value(where, key, "what stands for it,", key.fallback);
  require_value(where, key, "its example", key.example);
}

// "Kinds: perturbation "push"", for messages.
std::string shown_kind(std::string_view sort, std::string_view name) {
  return "Kinds: " + std::string(sort) + " " + quoted(name);
}

// DomainError unless the keys have plain names of their own and texts; `shown` is what has them.
void require_keys(const std::string& shown, std::span<const Key> keys) {
  for (auto key = keys.begin(); key != keys.end(); ++key) {
    const std::string where = shown + ", key " + quoted(key->path);
    require_key(where, *key);
    if (std::any_of(keys.begin(), key, [&](const Key& other) { return other.path == key->path; }))
      throw DomainError(where + " is there twice; expected another name");
  }
}

// DomainError "Kinds: perturbation "push", key "radius": ..." unless its name is of letters, digits
// and -, its keys have plain names of their own and texts, its sets are of them, and their defaults
// and examples are TOML that they take.
void require_sound(const KindParts& kind) {
  const std::string shown = shown_kind(kind.sort, kind.name);
  if (!is_plain(kind.name)) throw DomainError(shown + "; expected letters, digits and -");
  if (kind.help.empty()) throw DomainError(shown + ": got no text; expected one sentence");
  if (!kind.is_made) throw DomainError(shown + ": got no function that makes it; expected one");
  require_keys(shown, kind.keys);
  for (const std::string_view set : separated(kind.sets, '|'))
    for (const std::string_view name : separated(set, '+'))
      if (!has_key(kind, name))
        throw DomainError(shown + ": got " + quoted(name) +
                          " in its sets; expected one of its keys");
}

}  // namespace
}  // namespace detail

namespace {

using enum KeyType;
using enum Presence;

constexpr Key perturbation_table = {
    .path = "perturbation[]",
    .help = "What acts on the body; any number of tables, each of one kind."};
constexpr Key perturbation_kind_key = {.path = "perturbation[].kind",
                                       .type = choice,
                                       .presence = required,
                                       .example = "\"gravity-gradient\"",
                                       .help = "What it is."};

constexpr Key orbits_table = {.path = "orbit", .help = "Orbits, by names that the file chooses."};
constexpr Key orbit_table = {
    .path = "orbit.*",
    .help =
        "The path of the attracting body as seen from the rotating one, or the other way "
        "round, in inertial axes."};
constexpr Key orbit_kind_key = {
    .path = "orbit.*.kind",
    .type = choice,
    .fallback = "\"kepler\"",
    .example = "\"kepler\"",
    .help =
        "Elements, which may precess; a position and a velocity; a table in a file; or Sun, "
        "Moon and planets as they move (docs/guide/orbits.md)."};

constexpr Key frame_table = {
    .path = "frame",
    .help =
        "The reference frame S that attitudes refer to; left out, it is the inertial one. The "
        "state is then that in S at t = 0; omega is always relative to inertial axes."};
constexpr Key method_table = {
    .path = "method",
    .help =
        "How the rotation is integrated. Left out: not at all where no perturbation acts, since "
        "the free rotation is exact; otherwise collocation with its defaults, and adaptive for "
        "kinds other than rotation."};
constexpr Key method_kind_key = {.path = "method.kind",
                                 .type = choice,
                                 .presence = required,
                                 .example = "\"collocation\"",
                                 .help = "Which method (docs/guide/which-propagator.md)."};

// What a kind of each sort says of its rows in the table of keys, and to checks.
detail::KindOfTable row_of(const PerturbationKind& kind) {
  return {{{}, kind.name, kind.help, kind.on_surface}, kind.keys, kind.sets};
}
detail::KindOfTable row_of(const MethodKind& kind) {
  return {{{}, kind.name, kind.help}, kind.keys, {}};
}
detail::KindOfTable row_of(const OrbitKind& kind) {
  return {{.table = {},
           .kind = kind.name,
           .text = kind.help,
           .over_ages = static_cast<bool>(kind.history),
           .is_dated = kind.is_dated},
          kind.keys,
          kind.sets};
}
constexpr std::string_view sort_of(const OrbitKind&) { return "orbit"; }
detail::KindOfTable row_of(const ObservationKind& kind) {
  return {{{}, kind.name, kind.help}, kind.keys, kind.sets};
}
constexpr std::string_view sort_of(const ObservationKind&) { return "observation"; }
detail::KindOfTable row_of(const FrameKind& kind) {
  return {{{}, kind.name, kind.help}, kind.keys, kind.sets};
}
constexpr std::string_view sort_of(const FrameKind&) { return "frame"; }
constexpr std::string_view sort_of(const PerturbationKind&) { return "perturbation"; }
constexpr std::string_view sort_of(const MethodKind&) { return "method"; }
detail::KindOfTable row_of(const ExperimentKind& kind) {
  return {{{}, kind.name, kind.help}, kind.keys, {}};
}
constexpr std::string_view sort_of(const ExperimentKind&) { return "experiment"; }

template <class Kind>
std::vector<detail::KindOfTable> rows_of(const std::vector<Kind>& kinds) {
  std::vector<detail::KindOfTable> all;
  for (const Kind& kind : kinds) all.push_back(row_of(kind));
  return all;
}

template <class Kind>
const Kind* named(const std::vector<Kind>& kinds, std::string_view name) {
  const auto found =
      std::find_if(kinds.begin(), kinds.end(), [&](const Kind& one) { return one.name == name; });
  return found == kinds.end() ? nullptr : &*found;
}

bool is_made(const auto& kind) { return static_cast<bool>(kind.made); }
bool is_made(const OrbitKind& kind) {
  return static_cast<bool>(kind.made) || static_cast<bool>(kind.history);
}

// With one more, if it is sound.
template <class Kind>
std::vector<Kind> extended(std::vector<Kind> kinds, Kind kind) {
  const detail::KindOfTable row = row_of(kind);
  detail::require_sound({sort_of(kind), kind.name, kind.help, kind.keys, row.sets, is_made(kind)});
  if (named(kinds, kind.name) != nullptr)
    throw DomainError(detail::shown_kind(sort_of(kind), kind.name) +
                      " is there; expected another name");
  kinds.push_back(std::move(kind));
  return kinds;
}

// Their order is that of pages and templates.
std::vector<PerturbationKind> our_perturbations() {
  using namespace detail;
  return {gravity_gradient_kind(),
          constant_torque_kind(),
          damping_kind(),
          tide_kind(),
          internal_damping_kind(),
          anelastic_damping_kind(),
          torque_table_kind(),
          solar_pressure_kind(),
          drag_kind(),
          residual_dipole_kind(),
          eddy_currents_kind(),
          kane_damper_kind()};
}

// Scenarios have one word for a chart, for its table in [state] and for its columns, and `polhode
// init` has one for a chart, a perturbation or an experiment.
void require_own_word(const Kinds& kinds, const ChartKind& chart) {
  std::vector<std::string_view> taken = column_group_names(kinds.columns());
  for (const std::string_view group : detail::spin_column_groups()) taken.push_back(group);
  for (const Key* key : keys_of(kinds.schema(), "state")) taken.push_back(key_name(key->path));
  for (const PerturbationKind& kind : kinds.perturbations()) taken.push_back(kind.name);
  for (const ExperimentKind& kind : kinds.experiments()) taken.push_back(kind.name);
  if (std::find(taken.begin(), taken.end(), chart.name) != taken.end())
    throw DomainError(detail::shown_kind("chart", chart.name) +
                      " is the name of a key of [state], a group of columns, a perturbation or an "
                      "experiment; "
                      "expected another name");
}

// A column is one number in all groups.
void require_own_columns(const Kinds& kinds, const ChartKind& chart) {
  const std::vector<std::string_view> known = column_names(kinds.columns());
  for (const ChartVariable& variable : chart.variables) {
    const std::string_view column = variable.column;
    const bool is_other = std::find(known.begin(), known.end(), column) != known.end() &&
                          column_dimension(column, kinds.columns()) != variable.dimension;
    if (is_other || column == "t")
      throw DomainError(detail::shown_kind("chart", chart.name) + ": the column " +
                        std::string(column) + " is another number; expected another name in rows");
  }
}

bool is_in(std::span<const std::string_view> words, std::string_view word) {
  return std::ranges::find(words, word) != words.end();
}

// DomainError unless the group and its columns have plain names that nothing else has.
void require_own_columns(const Kinds& kinds, const ColumnKind& kind) {
  const std::string shown = detail::shown_kind("column group", kind.name);
  std::vector<std::string_view> groups = column_group_names(kinds.columns());
  for (const std::string_view group : detail::spin_column_groups()) groups.push_back(group);
  const std::vector<std::string_view> columns = column_names(kinds.columns());
  if (!detail::is_name(kind.name)) throw DomainError(shown + "; expected letters, digits, - and _");
  if (is_in(groups, kind.name) || is_in(columns, kind.name) || kind.name == "t")
    throw DomainError(shown + " is there; expected another name");
  std::vector<std::string_view> own;
  for (const GroupColumn& column : kind.columns) {
    const std::string where = shown + ", column " + detail::quoted(column.name);
    if (!detail::is_name(column.name) || column.name.find('-') != std::string_view::npos)
      throw DomainError(where + "; expected letters, digits and _");
    if (is_in(groups, column.name) || is_in(columns, column.name) || column.name == "t")
      throw DomainError(where + " is there; expected another name");
    if (is_in(own, column.name))
      throw DomainError(where + " is there twice; expected another name");
    own.push_back(column.name);
  }
}

// `polhode init NAME` knows charts, perturbations and experiments by their names.
void require_other_template(std::string_view sort, std::string_view name, const Kinds& kinds) {
  const std::vector<std::string_view> charts = state_charts(kinds.schema());
  if (std::find(charts.begin(), charts.end(), name) != charts.end())
    throw DomainError(detail::shown_kind(sort, name) +
                      " is the name of a chart; expected another name");
  const bool is_perturbation = sort == "perturbation";
  if (is_perturbation ? kinds.experiment(name) != nullptr : kinds.perturbation(name) != nullptr)
    throw DomainError(detail::shown_kind(sort, name) + " is the name of " +
                      (is_perturbation ? "an experiment" : "a perturbation") +
                      "; expected another name");
}

struct Lists {
  std::vector<PerturbationKind> perturbations;
  std::vector<OrbitKind> orbits;
  std::vector<FrameKind> frames;
  std::vector<MethodKind> methods;
  std::vector<ExperimentKind> experiments;
  OutputFormats formats;
  std::optional<std::vector<ChartKind>> own_charts = std::nullopt;  // left out: ours as they are
  std::vector<ColumnKind> own_columns = {};
  std::vector<ObservationKind> observations = {};

  std::span<const ChartKind> charts() const { return own_charts ? *own_charts : default_charts(); }
};

// [NAME] of kinds of experiments from outside.
std::deque<detail::TableRows> custom_tables(const std::vector<ExperimentKind>& kinds) {
  std::deque<detail::TableRows> all;
  for (const ExperimentKind& kind : kinds) {
    KindText text{{}, kind.name, kind.help};
    text.time_unit = kind.time_unit;
    text.angle_unit = kind.angle_unit;
    all.emplace_back().add({.path = kind.name, .presence = Presence::required, .help = kind.help},
                           kind.keys, {}, {&text, 1});
  }
  return all;
}

std::vector<detail::ExperimentRow> experiment_rows(const std::vector<ExperimentKind>& kinds,
                                                   const std::deque<detail::TableRows>& own,
                                                   const detail::DescribedParts& described) {
  std::vector<detail::ExperimentRow> rows = {detail::rotation_row(described),
                                             detail::fit_row(described),
                                             detail::obliquity_row(described)};
  for (std::size_t i = 0; i < kinds.size(); ++i)
    rows.push_back(detail::row_of(kinds[i], own[i].part(), described));
  return rows;
}

}  // namespace

struct Kinds::Parts {
  explicit Parts(Lists of)
      : lists(std::move(of)),
        perturbations(perturbation_table, perturbation_kind_key, rows_of(lists.perturbations)),
        orbits(orbit_table, orbit_kind_key, rows_of(lists.orbits)),
        frames(frame_table, rows_of(lists.frames)),
        methods(method_table, method_kind_key, rows_of(lists.methods)),
        observations(lists.observations),
        state(lists.charts()),
        columns(lists.charts(), lists.own_columns),
        output(columns),
        own(custom_tables(lists.experiments)),
        table(experiment_rows(lists.experiments, own,
                              {state.part(),
                               perturbations.part(),
                               methods.part(),
                               {{&orbits_table, 1}, {}},
                               orbits.part(),
                               frames.part(),
                               observations.part()}),
              output.part(), lists.formats),
        schema(table.schema()) {}

  Lists lists;
  detail::KindRows perturbations;
  detail::KindRows orbits;
  detail::TablesOfKinds frames;
  detail::KindRows methods;
  detail::ObservationRows observations;
  detail::StateRows state;
  ColumnKinds columns;
  detail::OutputRows output;
  std::deque<detail::TableRows> own;
  detail::SchemaTable table;
  Schema schema;
};

Kinds::Kinds(std::shared_ptr<const Parts> parts) : parts_(std::move(parts)) {}

Kinds default_kinds() {
  static const auto ours = std::make_shared<const Kinds::Parts>(Lists{
      our_perturbations(),
      {detail::kepler_kind(), detail::state_kind(), detail::table_kind(), detail::ephemeris_kind(),
       detail::elements_kind(), detail::series_kind(), detail::shipped_kind()},
      {detail::precessing_kind(), detail::orbit_plane_kind(), detail::local_vertical_kind()},
      {detail::adaptive_kind(), detail::collocation_kind(), detail::splitting_kind(),
       detail::variation_of_constants_kind()},
      {detail::nutation_kind()},
      default_output_formats(),
      std::nullopt,
      {},
      {detail::attitude_kind(), detail::direction_kind(), detail::rate_kind(),
       detail::light_curve_kind()}});
  return Kinds(ours);
}

Kinds Kinds::with(PerturbationKind kind) const {
  require_other_template("perturbation", kind.name, *this);
  Lists lists = parts_->lists;
  lists.perturbations = extended(std::move(lists.perturbations), std::move(kind));
  return Kinds(std::make_shared<const Parts>(std::move(lists)));
}

Kinds Kinds::with(OrbitKind kind) const {
  Lists lists = parts_->lists;
  lists.orbits = extended(std::move(lists.orbits), std::move(kind));
  return Kinds(std::make_shared<const Parts>(std::move(lists)));
}

Kinds Kinds::with(MethodKind kind) const {
  Lists lists = parts_->lists;
  lists.methods = extended(std::move(lists.methods), std::move(kind));
  return Kinds(std::make_shared<const Parts>(std::move(lists)));
}

Kinds Kinds::with(FrameKind kind) const {
  Lists lists = parts_->lists;
  lists.frames = extended(std::move(lists.frames), std::move(kind));
  return Kinds(std::make_shared<const Parts>(std::move(lists)));
}

Kinds Kinds::with(ExperimentKind kind) const {
  for (const Key& key : schema().keys)
    if (kind.name == "rotation" || kind.name == "obliquity" ||
        (key_table(key.path).empty() && key_name(key.path) == kind.name))
      throw DomainError(detail::shown_kind("experiment", kind.name) +
                        " is the name of another table; expected another name");
  require_other_template("experiment", kind.name, *this);
  Lists lists = parts_->lists;
  lists.experiments = extended(std::move(lists.experiments), std::move(kind));
  return Kinds(std::make_shared<const Parts>(std::move(lists)));
}

Kinds Kinds::with(OutputFormat format) const {
  const std::string shown = detail::shown_kind("output format", format.name);
  detail::require_keys(shown, format.keys);
  if (!format.keys.empty() && !format.options)
    throw DomainError(shown + ": got keys and no function options; expected one");
  Lists lists = parts_->lists;
  lists.formats = lists.formats.with(std::move(format));
  return Kinds(std::make_shared<const Parts>(std::move(lists)));
}

Kinds Kinds::with(const ChartKind& chart) const {
  if (chart.in_scenarios) {
    require_own_word(*this, chart);
    require_own_columns(*this, chart);
  }
  Lists lists = parts_->lists;
  lists.own_charts = with_chart(lists.charts(), chart);
  return Kinds(std::make_shared<const Parts>(std::move(lists)));
}

Kinds Kinds::with(ObservationKind kind) const {
  for (const Key& key : kind.keys)
    if (detail::is_shared_observation_key(key.path))
      throw DomainError(detail::shown_kind("observation", kind.name) + ", key " +
                        detail::quoted(key.path) +
                        " is one of all observations; expected another name");
  Lists lists = parts_->lists;
  lists.observations = extended(std::move(lists.observations), std::move(kind));
  return Kinds(std::make_shared<const Parts>(std::move(lists)));
}

Kinds Kinds::with(ColumnKind kind) const {
  const std::string shown = detail::shown_kind("column group", kind.name);
  require_own_columns(*this, kind);
  if (kind.help.empty()) throw DomainError(shown + ": got no text; expected one sentence");
  if (kind.columns.empty() || kind.columns.size() > most_columns)
    throw DomainError(shown + ": got " + std::to_string(kind.columns.size()) +
                      " columns; expected 1 to " + std::to_string(most_columns));
  if (!kind.numbers) throw DomainError(shown + ": got no function of a row; expected one");
  Lists lists = parts_->lists;
  lists.own_columns.push_back(std::move(kind));
  return Kinds(std::make_shared<const Parts>(std::move(lists)));
}

std::span<const PerturbationKind> Kinds::perturbations() const {
  return parts_->lists.perturbations;
}
const PerturbationKind* Kinds::perturbation(std::string_view name) const {
  return named(parts_->lists.perturbations, name);
}
std::span<const OrbitKind> Kinds::orbits() const { return parts_->lists.orbits; }
const OrbitKind* Kinds::orbit(std::string_view name) const {
  return named(parts_->lists.orbits, name);
}
std::span<const FrameKind> Kinds::frames() const { return parts_->lists.frames; }
std::span<const MethodKind> Kinds::methods() const { return parts_->lists.methods; }
const MethodKind* Kinds::method(std::string_view name) const {
  return named(parts_->lists.methods, name);
}
std::span<const ExperimentKind> Kinds::experiments() const { return parts_->lists.experiments; }
const ExperimentKind* Kinds::experiment(std::string_view name) const {
  return named(parts_->lists.experiments, name);
}
std::span<const ObservationKind> Kinds::observations() const { return parts_->lists.observations; }
const ObservationKind* Kinds::observation(std::string_view name) const {
  return named(parts_->lists.observations, name);
}
const OutputFormats& Kinds::formats() const { return parts_->lists.formats; }
std::span<const ChartKind> Kinds::charts() const { return parts_->lists.charts(); }
const ColumnKinds& Kinds::columns() const { return parts_->columns; }

const Schema& Kinds::schema() const { return parts_->schema; }

const Schema& scenario_schema() {
  static const Kinds kinds = default_kinds();
  return kinds.schema();
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
