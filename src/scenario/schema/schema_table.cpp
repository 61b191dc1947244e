// SPDX-License-Identifier: MIT
// The table of scenario keys: the head of a file, the parts of its kinds, and output. The keys of a
// kind stand between the head of a file and its output; their order is that of its row in
// experiment_kinds.cpp, which documents and templates follow.
#include "scenario/detail/schema_table.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "polhode/scenario/schema.hpp"
#include "scenario/detail/experiment_kinds.hpp"
#include "scenario/detail/schema_parts.hpp"
#include "scenario/ensemble/ensemble_plan.hpp"
#include "scenario/tables/head.hpp"
#include "scenario/tables/map.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace {

// The parts of all kinds, each once, with the words of the kinds that have it.
struct PartOfKinds {
  detail::SchemaPart part;
  std::string kinds;
};

void join(std::string& words, std::string_view word) {
  words += (words.empty() ? "" : "|") + std::string(word);
}

std::vector<PartOfKinds> parts_of(std::span<const detail::ExperimentRow> kinds) {
  std::vector<PartOfKinds> parts;
  for (const detail::ExperimentRow& kind : kinds)
    for (const detail::SchemaPart& part : kind.parts) {
      const auto same = std::find_if(parts.begin(), parts.end(), [&](const PartOfKinds& other) {
        return other.part.keys.data() == part.keys.data();
      });
      join(same == parts.end() ? parts.emplace_back(PartOfKinds{part, {}}).kinds : same->kinds,
           kind.name);
    }
  return parts;
}

}  // namespace

detail::SchemaTable::SchemaTable(std::span<const ExperimentRow> kinds, const SchemaPart& output,
                                 const OutputFormats& formats) {
  std::string all;
  for (const ExperimentRow& kind : kinds) join(all, kind.name);
  head_.emplace(all);
  add(head_->part(), {});
  for (const PartOfKinds& one : parts_of(kinds))
    add(one.part, one.kinds == all ? std::string_view() : words_.emplace_back(one.kinds));
  add(output, {});
  for (const OutputFormat& format : formats.all()) add(format);
  add(map_keys(), {});
  add(ensemble_keys(), {});
}

// [output.NAME] of a format that has keys.
void detail::SchemaTable::add(const OutputFormat& format) {
  if (format.keys.empty()) return;
  const std::string& table = words_.emplace_back("output." + format.name);
  keys_.push_back({.path = table, .help = words_.emplace_back(format.help)});
  for (const Key& key : format.keys) {
    keys_.push_back(key);
    keys_.back().path = words_.emplace_back(table + "." + std::string(key.path));
  }
}

void detail::SchemaTable::add(const SchemaPart& part, std::string_view kinds) {
  for (const Key& key : part.keys) {
    keys_.push_back(key);
    if (key_table(key.path).empty() && !kinds.empty()) keys_.back().kinds = kinds;
  }
  for (const Alternatives& row : part.alternatives) {
    alternatives_.push_back(row);
    if (row.table.empty() && !kinds.empty()) alternatives_.back().kinds = kinds;
  }
  texts_.insert(texts_.end(), part.kinds.begin(), part.kinds.end());
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
