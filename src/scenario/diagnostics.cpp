// SPDX-License-Identifier: MIT
#include "scenario/diagnostics.hpp"

#include <algorithm>

#include "polhode/scenario/scenario.hpp"
#include "text/printable.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

constexpr std::size_t longest_text = 600;

}  // namespace

Diagnostics::Diagnostics(std::string_view name) : name_(printable(name, longest_path)) {}

void Diagnostics::add(Position where, std::string_view path, std::string_view text) {
  entries_.push_back(
      {where, name_ + ":" + std::to_string(where.line) + ":" + std::to_string(where.column) + ": " +
                  printable(path, longest_path) + ": " + printable(text, longest_text)});
}

std::string Diagnostics::text() const {
  std::vector<Entry> sorted = entries_;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const Entry& a, const Entry& b) { return a.where < b.where; });
  std::string lines;
  for (const Entry& entry : sorted) lines += (lines.empty() ? "" : "\n") + entry.line;
  return lines;
}

void Diagnostics::raise() const {
  if (!entries_.empty()) throw ScenarioError(text());
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
