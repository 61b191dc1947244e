// SPDX-License-Identifier: MIT
// The keys of a scenario file: one declarative table. It drives the reader, the JSON Schema, the
// page docs/reference/scenario.md, "did you mean" and `polhode init`.
//
// Equations   none.
// Units       a key with a dimension takes a bare number (in the units of the file), "27.38 h", or
//             { value = 27.38, unit = "h" }.
// Domain      schema 1. Rows may be added, never changed: a file of schema 1 stays valid. In a
//             path, "*" stands for a name that the file chooses (orbit.*; letters, digits, - and _)
//             and "[]" after a name for each table of an array (perturbation[]). In a table with a
//             key `kind` a key may belong to some kinds alone.
// Accuracy    none.
// Errors      none.
// Cost        the table is constant data.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "polhode/text/separated.hpp"
#include "polhode/text/units.hpp"

namespace polhode {
inline namespace v0 {

enum class KeyType {
  table,       // [body]
  integer,     // 1
  number,      // 27.38, "27.38 h" or { value = 27.38, unit = "h" }
  numbers,     // an array of them; { value = [..], unit = ".." } gives them one unit
  matrix,      // three rows of three
  linear_map,  // a matrix, or three numbers, its diagonal
  boolean,     // true or false
  text,        // "any text"
  name,        // "moon": letters, digits, - and _
  unit,        // "h", "kg m2"
  choice,      // one word of a list
  choices,     // an array of words of a list, none twice
  epoch,       // "2013-01-05T00:00:00 UTC" or "JD 2456297.5 TDB"
  columns,     // an array of column names of a data file, or of their numbers
};

enum class Presence {
  optional,     // may be left out; `fallback` then stands in, if there is one
  required,     // must be there
  alternative,  // belongs to an Alternatives row of its table
};

struct Key {
  std::string_view path;
  KeyType type = KeyType::table;
  Presence presence = Presence::optional;
  Dimension dimension = Dimension::number;
  int length = 0;                   // of numbers; 0: any, but not none
  std::string_view allowed = {};    // words (or integers) joined by "|"
  std::string_view fallback = {};   // as TOML; "{}" of a table: read as if it were there, empty
  std::string_view example = {};    // as TOML, what `polhode init` writes
  std::string_view help = {};       // one sentence
  std::string_view kinds = {};      // words of `kind` in its table that it belongs to; empty: all
  std::string_view needed_by = {};  // those that an optional key must come with
  bool is_file = false;             // a text: the path of a file, from the folder of the scenario
  bool in_template = false;         // stands in what `polhode init` writes, though it is optional

  bool operator==(const Key&) const = default;
};

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
};

struct Schema {
  std::span<const Key> keys;
  std::span<const Alternatives> alternatives;
  std::span<const KindText> kinds = {};
};
// That of default_kinds (polhode/scenario/kinds.hpp).
const Schema& scenario_schema();

// The last name of a path, without "[]", and the path of the table that holds it ("" at the top).
std::string_view key_name(std::string_view path);
std::string_view key_table(std::string_view path);
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
std::vector<std::string_view> state_charts();
// What scenario_template knows: the charts, for free rotation, and the kinds of [[perturbation]].
std::vector<std::string_view> scenario_templates(const Schema& schema = scenario_schema());
// A commented scenario to start from, with the given chart in [state.CHART] or the given kind of
// perturbation. DomainError when there is none of this name.
std::string scenario_template(std::string_view name, const Schema& schema = scenario_schema());

}  // namespace v0
}  // namespace polhode
