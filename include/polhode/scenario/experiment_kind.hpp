// SPDX-License-Identifier: MIT
// In this header: custom_experiment, experiment_kind.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "polhode/dynamics/method.hpp"
#include "polhode/scenario/schema.hpp"
#include "polhode/text/citation.hpp"
#include "polhode/text/key_values.hpp"
#include "polhode/text/kind_key.hpp"
#include "polhode/text/units.hpp"
#include "polhode/trajectory/save_at.hpp"

namespace polhode {
inline namespace v0 {
namespace io {

// CustomExperiment: an experiment from outside. Either custom_experiment
// (polhode/run/custom_experiment.hpp) has made it from a model that integrate() moves, or its
// columns are functions of time. Files, checkpoints, events and summaries are those of every run.
//
// Equations   those of its model or formula.
// Units       times in core units (polhode/text/units.hpp); columns are written in those of the
//             file.
// Domain      rows in order, on one side of t = 0 or on both; it starts at t = 0.
// Accuracy    that of its method.
// Errors      none: it is a plain value.

namespace detail {
struct RowsMaker;
}

struct CustomColumn {
  std::string name;
  Dimension dimension;
};

// A line that `polhode info` prints: "wheel", "momentum", 0.4, Dimension::momentum.
struct SummaryItem {
  std::string key;    // of JSON
  std::string label;  // for people
  double number;
  Dimension dimension;
};

struct CustomExperiment {
  std::string kind;                   // "gyrostat"
  std::optional<SaveAt> rows;         // always there
  std::vector<CustomColumn> columns;  // behind t
  Method method = default_model_method;
  std::vector<SummaryItem> facts = {};
  // Further facts, which take time to find: asked for when they are shown.
  std::function<std::vector<SummaryItem>()> more_facts = nullptr;
  bool has_events = false;
  std::vector<std::string> event_names = {};  // where they are known beforehand
  std::string identity = {};  // bytes of the state at t = 0: a run is continued with the same alone
  std::shared_ptr<const detail::RowsMaker> maker = nullptr;
  // In place of a model: the numbers of the columns at a time, in core units.
  std::function<void(double, std::span<double>)> formula = nullptr;
};

inline const std::optional<SaveAt>& row_times(const CustomExperiment& own) { return own.rows; }
inline bool has_events(const CustomExperiment& own) { return own.has_events; }
inline std::optional<Method> propagation_method(const CustomExperiment& own) {
  return own.formula ? std::nullopt : std::optional(own.method);
}

// ExperimentKind: all that there is to say of a kind of experiment from outside: its word for the
// key `kind` of a file, the keys of its own table [NAME], how it is made from them, what it rests
// on. It shares [time] and [method] with a rotation; docs/extending/experiment.md adds one.
//
// Equations   none of its own; its model has them (polhode/dynamics/model.hpp).
// Units       core units (polhode/text/units.hpp).
// Domain      names of letters, digits and -, other than the tables that every file may have.
// Accuracy    that of the experiment.
// Errors      a builder throws a DomainError, or says by KeyValues::refuse what it expected: both
//             become a ScenarioError at the place in the file.
// Cost        that of the experiment.

// Where an experiment is made: the values of its table, and what it shares with others.
class ExperimentContext : public KeyValues {
 public:
  ExperimentContext(const KeyValues& table, const SaveAt& rows, const Method& method)
      : KeyValues(table), rows_(rows), method_(method) {}

  const SaveAt& rows() const { return rows_; }      // of [time]
  const Method& method() const { return method_; }  // of [method], or the default
  // Refuses, at its place, a method that does not move the model; `is_frozen`: Splitting does.
  void require_method(bool is_frozen) const;

 private:
  const SaveAt& rows_;
  const Method& method_;
};

// Texts are constant data: they outlive every kind.
struct ExperimentKind {
  std::string_view name;  // "gyrostat"
  std::string_view help;  // one sentence: what it is
  std::vector<Key> keys;  // of the table [gyrostat]; paths are their own names
  std::function<CustomExperiment(const ExperimentContext&)> made;
  std::vector<Citation> citations = {};
  // Of its template; empty: that of the first example that has one, and degrees.
  std::string_view time_unit = {}, angle_unit = {};
};

// A kind whose arguments are a plain struct A, filled by its keys.
template <class A>
ExperimentKind experiment_kind(std::string_view name, std::string_view help,
                               std::span<const KindKey<A>> keys,
                               CustomExperiment (*made)(const A&, const ExperimentContext&),
                               const std::vector<Citation>& citations = {}) {
  return {.name = name,
          .help = help,
          .keys = keys_of(keys),
          .made = [all = std::vector<KindKey<A>>(keys.begin(), keys.end()),
                   made](const ExperimentContext& at) { return made(arguments<A>(all, at), at); },
          .citations = citations};
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
