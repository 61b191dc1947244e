// SPDX-License-Identifier: MIT
// What is said of keys that a table does not know: where they belong, or what they may have meant.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "polhode/scenario/schema.hpp"
#include "scenario/values.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

// A table of the file with its own keys.
struct KnownTable {
  std::string_view pattern;                // its path in the schema
  std::vector<std::string_view> keys;      // those that it may have
  std::string_view kind;                   // "" where it has none
  std::vector<std::string_view> all = {};  // of any kind

  bool knows(std::string_view name) const;
};
KnownTable known_table(std::string_view pattern, std::string_view kind,
                       const std::vector<const Key*>& known);

// Keys that a table does not know, and the known ones that they may stand for.
struct Unknown {
  bool any = false;
  std::vector<std::string_view> meant = {};
};

struct StrayKey {
  std::string_view name;
  Position where;
  bool is_section = false;          // [NAME], not a key = value
  std::string_view near = {};       // the known key that was meant
  std::vector<const Key*> at = {};  // where keys of this name belong, in other tables
};

// Finds near and at; `tables` are those that this kind of file may have at its top.
StrayKey stray_key(const Schema& schema, const std::vector<std::string_view>& tables,
                   const KnownTable& table, StrayKey stray);

// The key of the table that leads to the place of a stray one, or that was meant; "" where none
// is known.
std::string_view leads_to(const KnownTable& table, const StrayKey& stray);

// One line for each, or for all that belong in one other table.
void report(std::vector<StrayKey> strays, const KnownTable& table, const std::string& path,
            Diagnostics& diagnostics);

// "a table [body] with one of moments, tensor".
std::string table_in_words(const Schema& schema, const Key& key);

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
