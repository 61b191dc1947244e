// SPDX-License-Identifier: MIT
// What an output says behind its rows, since it is known when they are all there.
#pragma once

#include <string>
#include <vector>

#include "polhode/output/sink.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

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
}  // namespace v0
}  // namespace polhode
