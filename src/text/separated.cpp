// SPDX-License-Identifier: MIT
#include "polhode/text/separated.hpp"

namespace polhode {
inline namespace v0 {

std::vector<std::string_view> separated(std::string_view joined, char separator) {
  std::vector<std::string_view> parts;
  if (joined.empty()) return parts;
  for (;;) {
    const std::size_t end = joined.find(separator);
    parts.push_back(joined.substr(0, end));
    if (end == std::string_view::npos) return parts;
    joined.remove_prefix(end + 1);
  }
}

}  // namespace v0
}  // namespace polhode
