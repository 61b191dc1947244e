// SPDX-License-Identifier: MIT
// What the fuzz targets of text share.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

namespace fuzz {

// Not an assertion: it holds in every build.
inline void require(bool good) {
  if (!good) std::abort();
}

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

// A message about the file "fuzz" in one line.
inline void require_message(std::string_view message) {
  require(message.starts_with("fuzz:") && message.find('\n') == std::string_view::npos);
}

}  // namespace fuzz
