// SPDX-License-Identifier: MIT
#include "text/file_bytes.hpp"

#include <algorithm>
#include <cerrno>
#include <memory>

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

constexpr std::size_t piece_bytes = 65536;

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

}  // namespace

std::optional<std::string> file_bytes(std::FILE* file, std::size_t most) {
  std::string bytes;
  while (bytes.size() < most) {
    const std::size_t before = bytes.size(), asked = std::min(piece_bytes, most - before);
    bytes.resize(before + asked);
    errno = 0;
    const std::size_t got = std::fread(bytes.data() + before, 1, asked, file);
    bytes.resize(before + got);
    if (got == asked) continue;
    if (std::ferror(file) != 0) return std::nullopt;
    break;
  }
  return bytes;
}

std::optional<std::string> file_bytes(const std::string& path, std::size_t most) {
  errno = 0;
  std::unique_ptr<std::FILE, CloseFile> file(std::fopen(path.c_str(), "rbe"));
  if (!file) return std::nullopt;
  std::optional<std::string> bytes = file_bytes(file.get(), most);
  const int error_number = errno;
  file.reset();
  errno = error_number;
  return bytes;
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
