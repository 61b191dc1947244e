// SPDX-License-Identifier: MIT
// What the comments of a table that `polhode run` wrote say of its columns: units, and the branch
// of Sadov's and Serret's sets, which their numbers do not hold.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace polhode {
inline namespace v0 {
namespace detail {

class TableNotes {
 public:
  // True for a line that was a note; it speaks of the columns of this table alone, so a converted
  // table must not repeat it.
  bool read(std::string_view comment);

  // The unit of a column, where the table says it.
  std::string_view unit(std::string_view column) const;
  // The constant value of a column that the table has left to a note.
  std::optional<double> constant(std::string_view column) const;

 private:
  std::map<std::string, std::string, std::less<>> units_;
  std::map<std::string, double, std::less<>> constants_;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
