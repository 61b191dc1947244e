// SPDX-License-Identifier: MIT
// The table of keys of every kind of experiment: the head of a file, the parts of the kinds, then
// output with its formats, and map.
#pragma once

#include <deque>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "polhode/output/output_format.hpp"
#include "polhode/scenario/schema.hpp"
#include "scenario/detail/experiment_kinds.hpp"
#include "scenario/detail/schema_parts.hpp"
#include "scenario/tables/head.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

class SchemaTable {
 public:
  // A part that several kinds share is there once. Its keys at the top of the file belong to these
  // kinds alone; those of all kinds say nothing of kinds.
  explicit SchemaTable(std::span<const ExperimentRow> kinds, const SchemaPart& output = {},
                       const OutputFormats& formats = default_output_formats());
  SchemaTable(const SchemaTable&) = delete;
  SchemaTable& operator=(const SchemaTable&) = delete;

  Schema schema() const { return {keys_, alternatives_, texts_}; }

 private:
  void add(const SchemaPart& part, std::string_view kinds);
  void add(const OutputFormat& format);

  std::optional<HeadRows> head_;
  std::deque<std::string> words_;  // that keys refer to
  std::vector<Key> keys_;
  std::vector<Alternatives> alternatives_;
  std::vector<KindText> texts_;
};

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
