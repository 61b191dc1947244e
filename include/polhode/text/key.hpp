// SPDX-License-Identifier: MIT
// Key: one key of a TOML file as constant data, a row of the table of keys
// (polhode/scenario/schema.hpp). What a kind of thing says of its keys is said with it.
//
// Units       a key with a dimension takes a bare number (in the units of the file), "27.38 h", or
//             { value = 27.38, unit = "h" }.
// Domain      in a path, "*" stands for a name that the file chooses (orbit.*; letters, digits, -
//             and _) and "[]" after a name for each table of an array (perturbation[]). In a table
//             with a key `kind` a key may belong to some kinds alone.
// Cost        constant data.
#pragma once

#include <cstdint>
#include <limits>
#include <string_view>

#include "polhode/text/units.hpp"

namespace polhode {
inline namespace v0 {
namespace io {

enum class KeyType {
  table,       // [body]
  integer,     // 1
  number,      // 27.38, "27.38 h" or { value = 27.38, unit = "h" }
  numbers,     // an array of them; { value = [..], unit = ".." } gives them one unit
  matrix,      // three rows of three
  linear_map,  // a matrix, or three numbers, its diagonal
  square,      // as many rows as each has numbers
  boolean,     // true or false
  text,        // "any text"
  name,        // "moon": letters, digits, - and _
  unit,        // "h", "kg m2"
  choice,      // one word of a list
  choices,     // an array of words of a list, none twice
  epoch,       // "2013-01-05T00:00:00 UTC" or "JD 2456297.5 TDB"
  columns,     // an array of column names of a data file, or of their numbers
  units,       // an array of units
  key_list,    // an array of keys of the file
};

enum class Presence {
  optional,     // may be left out; `fallback` then stands in, if there is one
  required,     // must be there
  alternative,  // belongs to an Alternatives row of its table
};

// What each of the numbers of a key must be.
enum class Range { any, positive, not_negative };

// The integers that a key takes.
struct WholeRange {
  std::int64_t least = std::numeric_limits<std::int64_t>::min();
  std::int64_t most = std::numeric_limits<std::int64_t>::max();
  std::string_view shown = {};  // the greatest, in messages

  bool operator==(const WholeRange&) const = default;
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
  // A line of the table beside which the key is left out: "field = \"earth\"".
  std::string_view unused_with = {};
  bool is_file = false;      // a text: the path of a file, from the folder of the scenario
  bool in_template = false;  // stands in what `polhode init` writes, though it is optional

  Range range = Range::any;  // of numbers
  bool takes_date = false;   // of times: "2013-02-04" too, counted from state.epoch
  WholeRange whole = {};     // of integers

  bool operator==(const Key&) const = default;
};

// The last name of a path, without "[]", and the path of the table that holds it ("" at the top).
std::string_view key_name(std::string_view path);
std::string_view key_table(std::string_view path);

}  // namespace io
}  // namespace v0
}  // namespace polhode
