// SPDX-License-Identifier: MIT
// The tables of every file: its head, [units] and [output].
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "polhode/output/column_kind.hpp"
#include "scenario/table.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

struct HeadTable {
  std::int64_t schema = 1;
  std::optional<std::string> title;
  std::string kind;
};
// The head for these kinds of experiments, "rotation|fit|obliquity", and [units].
class HeadRows : public TableRows {
 public:
  explicit HeadRows(std::string kinds);
};
Placed<HeadTable> head_table(const FileValues& file);

struct OutputTable {
  std::vector<std::string> columns;  // groups of them
};
class OutputRows : public TableRows {
 public:
  explicit OutputRows(const ColumnKinds& columns);
};
Placed<OutputTable> output_table(const FileValues& file);
// Throws a ScenarioError at output.columns.
[[noreturn]] void refuse_columns(const FileValues& file, std::string_view message);

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
