// SPDX-License-Identifier: MIT
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
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "polhode/dynamics/method.hpp"
#include "polhode/text/units.hpp"
#include "polhode/trajectory/save_at.hpp"

namespace polhode {
inline namespace v0 {

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

}  // namespace v0
}  // namespace polhode
