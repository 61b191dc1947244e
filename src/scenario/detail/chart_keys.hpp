// SPDX-License-Identifier: MIT
// The keys of [state] and [output], to which every chart that scenarios know adds its own.
#pragma once

#include <deque>
#include <span>
#include <string>
#include <vector>

#include "polhode/tables/chart_kind.hpp"
#include "scenario/detail/schema_parts.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

class StateKeys {
 public:
  explicit StateKeys(std::span<const ChartKind> charts);
  StateKeys(const StateKeys&) = delete;
  StateKeys& operator=(const StateKeys&) = delete;

  // Refers to this.
  SchemaPart part() const { return {keys_, alternatives_}; }

 private:
  void add(const ChartKind& chart);

  std::deque<std::string> words_;  // that keys refer to
  std::vector<Key> keys_;
  std::vector<Alternatives> alternatives_;
};

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
