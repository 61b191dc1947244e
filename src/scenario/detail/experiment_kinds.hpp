// SPDX-License-Identifier: MIT
// The kinds of experiments: what a file may describe by its key `kind`, ours and those from
// outside: what each brings to the table of keys, and how it is made from values.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "polhode/output/output_format.hpp"
#include "polhode/scenario/kinds.hpp"
#include "polhode/scenario/scenario.hpp"
#include "scenario/detail/schema_parts.hpp"
#include "scenario/values.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

// Where an experiment is made.
struct KindContext : FileValues {
  const Kinds& kinds;        // of what it holds
  const OutputPlan& output;  // what it must be able to give
};

struct MadeExperiment {
  Experiment experiment;
  // Makes it again from values that differ at the paths `changed` only, and shares with it what
  // does not depend on them. From any thread.
  std::function<Experiment(const KindContext& at, std::span<const std::string> changed)> remake;
};

// What a kind brings to the table of keys: its own parts, and those that it shares with others.
struct ExperimentRow {
  std::string_view name;
  std::vector<SchemaPart> parts;
};

ExperimentRow rotation_row(const DescribedParts& described);
ExperimentRow fit_row(const DescribedParts& described);
ExperimentRow obliquity_row(const DescribedParts& described);
// Of a kind from outside, whose own table is `own`.
ExperimentRow row_of(const ExperimentKind& kind, const SchemaPart& own,
                     const DescribedParts& described);

// Of the kind that the file names; the schema has let its word pass. Throws a ScenarioError at the
// place of what is wrong.
MadeExperiment made_experiment(const KindContext& at);

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
