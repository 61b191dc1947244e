// SPDX-License-Identifier: MIT
// What the comments of a table that `polhode run` wrote say of its columns: units, and the options
// of charts, which their numbers do not hold.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "polhode/tables/chart_kind.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

class TableNotes {
 public:
  // That the charts outlive.
  explicit TableNotes(std::span<const ChartKind> charts) : charts_(charts) {}

  // True for a line that was a note; it speaks of the columns of this table alone, so a converted
  // table must not repeat it.
  bool read(std::string_view comment);

  // The unit of a column, where the table says it.
  std::string_view unit(std::string_view column) const;
  // An option of a chart, where the table says it.
  std::optional<double> option(std::string_view chart, std::string_view name) const;

 private:
  void read_option(const ChartKind& chart, std::string_view name, std::string_view word);

  std::map<std::string, std::string, std::less<>> units_;
  std::map<std::pair<std::string_view, std::string_view>, double> options_;
  std::span<const ChartKind> charts_;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
