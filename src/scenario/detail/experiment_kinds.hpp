// SPDX-License-Identifier: MIT
// The kinds of experiments: what a file may describe by its key `kind`. A kind is one row: its
// name, the parts of the table of keys that are its own, and how it is made from values. Nothing
// else knows its keys.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "polhode/output/output_plan.hpp"
#include "polhode/scenario/kinds.hpp"
#include "polhode/scenario/scenario.hpp"
#include "scenario/detail/schema_parts.hpp"
#include "scenario/values.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// Where an experiment is made.
struct KindContext {
  const Values& values;
  const Units& units;
  const Kinds& kinds;        // of what it holds
  const OutputPlan& output;  // what it must be able to give
  const std::string& name;   // of the file, for messages
};

// Makes the experiment again with other numbers at the paths that it was made for; from any thread.
using Remake = std::function<Experiment(const Values&)>;

// Prepares that of an experiment, for numbers at the paths `changed`, next to which all else is
// shared with it. What `at` refers to must outlive the result.
using PrepareRemake =
    std::function<Remake(const KindContext& at, std::vector<std::string> changed)>;

struct MadeExperiment {
  Experiment experiment;
  PrepareRemake prepare;
};

struct ExperimentKind {
  std::string_view name;
  std::vector<SchemaPart> (*keys)(const DescribedParts& described);
  // Throws a ScenarioError at the place of what is wrong.
  MadeExperiment (*make)(const KindContext& at);
};

std::span<const ExperimentKind> experiment_kinds();
// The one that the file names; the schema has let its word pass.
const ExperimentKind& kind_of(const Values& values);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
