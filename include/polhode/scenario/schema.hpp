// SPDX-License-Identifier: MIT
// The keys of a scenario file: one declarative table. It drives the reader, the JSON Schema, the
// page docs/reference/scenario.md, "did you mean" and `polhode init`.
//
// Units       those of the rows (polhode/text/key.hpp).
// Domain      schema 1. Rows may be added, never changed: a file of schema 1 stays valid.
// Cost        the table is constant data.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "polhode/text/key.hpp"
#include "polhode/text/separated.hpp"
#include "polhode/text/units.hpp"

namespace polhode {
inline namespace v0 {
namespace io {

// Exactly one of several sets of keys of a table: "quaternion|euler", "stop+step|stop+count|at".
struct Alternatives {
  std::string_view table;
  std::string_view sets;
  std::string_view kinds = {};  // words of `kind` in the table that it belongs to; empty: all
};

// What a word of the key `kind` of a table stands for, in one sentence.
struct KindText {
  std::string_view table;
  std::string_view kind;
  std::string_view text;
  bool on_surface = false;  // acts on the facets of [[surface]]
  bool over_ages = false;   // elements over ages, without positions
  bool is_dated = false;    // positions of a date: they need state.epoch, and axes of the sky
  std::string_view time_unit = {}, angle_unit = {};  // of the template of an experiment
};

struct Schema {
  std::span<const Key> keys;
  std::span<const Alternatives> alternatives;
  std::span<const KindText> kinds = {};
};
// That of default_kinds (polhode/scenario/kinds.hpp).
const Schema& scenario_schema();

// The keys directly inside a table, in the order of the schema.
std::vector<const Key*> keys_of(const Schema& schema, std::string_view table);
// Whether a key of a table goes with kind = "..." there.
bool belongs(const Key& key, std::string_view kind);
bool belongs(const Alternatives& row, std::string_view kind);
// Whether it must stand there.
bool is_required(const Key& key, std::string_view kind);
// What a value of this key must be, in words that continue "expected ".
std::string expectation(const Key& key, const Units& units);

// docs/reference/scenario.schema.json
std::string json_schema(const Schema& schema);
// The generated part of docs/reference/scenario.md: one list of keys per table of the file.
std::string markdown_reference(const Schema& schema);
// The list of units of the same page.
std::string markdown_units();
// The charts that [state.CHART] knows.
std::vector<std::string_view> state_charts(const Schema& schema = scenario_schema());
// What scenario_template knows, sort by sort.
struct TemplateSort {
  std::string_view sort;  // "chart", "perturbation", "experiment", "orbit", ...
  std::vector<std::string>
      words;  // names of its kinds; of one that a sort before has, "frame.NAME"
};
std::vector<TemplateSort> scenario_templates(const Schema& schema = scenario_schema());
// A commented scenario to start from, with the kind that the word stands for. DomainError when it
// stands for none. `program` is what reads it.
std::string scenario_template(std::string_view word, const Schema& schema = scenario_schema(),
                              std::string_view program = "polhode");

}  // namespace io
}  // namespace v0
}  // namespace polhode
