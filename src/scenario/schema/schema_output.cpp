// SPDX-License-Identifier: MIT
// The table of scenario keys: what the rows hold. The keys of a format of files stand in its own
// source.
#include <string>
#include <vector>

#include "polhode/output/columns.hpp"
#include "scenario/detail/schema_parts.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

using enum KeyType;
using enum Presence;

constexpr Key keys[] = {
    {.path = "output", .fallback = "{}", .help = "What the rows hold."},
    {.path = "output.columns",
     .type = choices,
     .fallback = "[\"q\", \"omega\"]",
     .example = "[\"q\", \"omega\", \"andoyer\"]",
     .help = "Groups of columns after t. A column that two groups share is written once."},
};

// "q|omega|...": the groups that rows can hold.
const std::string& column_words() {
  static const std::string words = [] {
    std::string joined;
    for (const std::string_view name : column_group_names())
      joined += (joined.empty() ? "" : "|") + std::string(name);
    return joined;
  }();
  return words;
}

}  // namespace

SchemaPart output_keys() {
  static const std::vector<Key> all = [] {
    std::vector<Key> made(std::begin(keys), std::end(keys));
    for (Key& key : made)
      if (key.path == "output.columns") key.allowed = column_words();
    return made;
  }();
  return {all, {}};
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
