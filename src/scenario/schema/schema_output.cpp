// SPDX-License-Identifier: MIT
// The table of scenario keys: what the rows hold. The keys of a format of files stand in its own
// source.
#include <algorithm>

#include "output/obliquity_columns.hpp"
#include "polhode/output/columns.hpp"
#include "scenario/detail/output_keys.hpp"

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
     .help = "Groups of columns after t. A column that two groups share is written once. Kind "
             "obliquity has obliquity, precession, climatic_precession, pericentre, eccentricity, "
             "spin, andoyer, insolation and tides, of which the first three are the default; all "
             "else, and andoyer, is of a rotation."},
};

bool is_among(std::string_view words, std::string_view word) {
  const std::vector<std::string_view> all = separated(words, '|');
  return std::find(all.begin(), all.end(), word) != all.end();
}

}  // namespace

OutputKeys::OutputKeys(std::span<const ChartKind> charts)
    : keys_(std::begin(keys), std::end(keys)) {
  for (const std::string_view name : column_group_names(charts))
    groups_ += (groups_.empty() ? "" : "|") + std::string(name);
  for (const std::string_view name : spin_column_groups())
    if (!is_among(groups_, name)) groups_ += "|" + std::string(name);
  for (Key& key : keys_)
    if (key.path == "output.columns") key.allowed = groups_;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
