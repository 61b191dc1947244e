// SPDX-License-Identifier: MIT
// The keys of [output]: the groups of columns that rows can hold, those of charts among them.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "polhode/tables/chart_kind.hpp"
#include "scenario/detail/schema_parts.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

class OutputKeys {
 public:
  explicit OutputKeys(std::span<const ChartKind> charts);
  OutputKeys(const OutputKeys&) = delete;
  OutputKeys& operator=(const OutputKeys&) = delete;

  // Refers to this.
  SchemaPart part() const { return {keys_, {}}; }

 private:
  std::string groups_;  // "q|omega|..."
  std::vector<Key> keys_;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
