// SPDX-License-Identifier: MIT
// Holds how a scenario reads a table against what the table says of itself (table_header.hpp).
#pragma once

#include <string>
#include <vector>

#include "polhode/text/key_values.hpp"
#include "polhode/text/units.hpp"
#include "tables/table_header.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

// Each throws a DomainError "moon.csv:1: ...; expected ..." where they differ.
class TableCheck {
 public:
  // `at` is the table of keys that names the file, and outlives this; `columns` as they were asked
  // for, by name or number, times first.
  TableCheck(const KeyValues& at, const NumberTable& file, const std::vector<std::string>& columns);

  // How a column is read: the key that may say so, and what its unit is in core units.
  struct Read {
    const char* key;
    double unit;
    Dimension dimension;
  };
  void unit(std::size_t column, const Read& read) const;
  void axes(const std::string& used) const;
  // Of a torque table, whose key axes is "body" or "inertial".
  void torque_axes(const std::string& used) const;
  // Of times that count from an epoch: that it is the one of the state.
  void epoch() const;
  // Of times that are dates.
  void scale(const std::string& used) const;

 private:
  const TableHeader::Note* said_of(std::size_t column, Dimension dimension) const;

  const KeyValues& at_;
  TableHeader header_;
  std::vector<std::string> names_;
};

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
