// SPDX-License-Identifier: MIT
// A file as a whole.
#pragma once

#include <cstddef>
#include <cstdio>
#include <limits>
#include <optional>
#include <string>

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

// What is left of an open file, up to so many bytes. None where it cannot be read: errno says why.
std::optional<std::string> file_bytes(std::FILE* file,
                                      std::size_t most = std::numeric_limits<std::size_t>::max());
std::optional<std::string> file_bytes(const std::string& path,
                                      std::size_t most = std::numeric_limits<std::size_t>::max());

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
