// SPDX-License-Identifier: MIT
// A cell of a stage, and what has become of it.
#pragma once

#include <cstdint>
#include <string>

namespace polhode {
inline namespace v0 {
namespace detail {

struct Cell {
  enum class Fate : std::int64_t { done, failed, dropped };
  std::int64_t index = 0;
  Fate fate = Fate::dropped;
  std::string bytes = {};  // of the result, or why there is none
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
