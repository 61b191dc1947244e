// SPDX-License-Identifier: MIT
// What an output says beside its rows: the scenario that it is from, and notes behind them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "polhode/output/sink.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

constexpr std::string_view scenario_lead = "| ";
constexpr std::string_view file_lead = "file ";  // of a note: file_note

// What a scenario, its files and the rows are known by.
struct Origin {
  std::vector<std::string> scenario;
  std::vector<std::string> files;
  std::vector<std::string> columns;  // the head line of a text; groups of HDF5; not of an AEM
};

// Empty: there is none.
std::string difference(const Origin& found, const Origin& wanted);

// A sink that can be told once, before it finishes. Text files have a comment for each note at
// their end, "# NAME: note"; HDF5 has an attribute NAME, a text for each.
class ClosingNotes {
 public:
  virtual ~ClosingNotes() = default;
  virtual void close_with(const std::string& name, const std::vector<std::string>& notes) = 0;
};

// Of sinks that cannot, nothing becomes.
inline void close_with(Sink& sink, const std::string& name, const std::vector<std::string>& notes) {
  if (auto* const closing = dynamic_cast<ClosingNotes*>(&sink); closing != nullptr)
    closing->close_with(name, notes);
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
