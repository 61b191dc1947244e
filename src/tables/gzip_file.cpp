// SPDX-License-Identifier: MIT
// The only source that knows zlib, which reads files that are not packed as they are.
#include "tables/detail/gzip_file.hpp"

#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <optional>

#include "polhode/error.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

constexpr std::size_t largest_read = std::size_t{1} << 24;

}  // namespace

GzipFile::GzipFile(const std::string& path, Pipes pipes) : shown_(printable(path, longest_name)) {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(path, ignored);
  if (std::filesystem::is_directory(status))
    throw DomainError(shown_ + ": is a folder; expected a file");
  // a pipe or a device may never end
  if (pipes == Pipes::rejected && std::filesystem::exists(status) &&
      !std::filesystem::is_regular_file(status))
    throw DomainError(shown_ + ": is not a regular file");
  errno = 0;
  stream_ = gzopen(path.c_str(), "rb");
  if (stream_ == nullptr)
    throw DomainError(shown_ + ": cannot be read: " + std::strerror(errno == 0 ? ENOMEM : errno));
}

GzipFile::~GzipFile() { gzclose_r(static_cast<gzFile>(stream_)); }

std::size_t GzipFile::read(std::span<char> bytes) {
  auto* const file = static_cast<gzFile>(stream_);
  errno = 0;
  const int count =
      gzread(file, bytes.data(), static_cast<unsigned>(std::min(bytes.size(), largest_read)));
  int code = Z_OK;
  const char* const text = gzerror(file, &code);
  if (code == Z_BUF_ERROR)
    throw DomainError(shown_ + ": cannot be unpacked: it ends before its end");
  if (count < 0)
    throw DomainError(
        shown_ + ": cannot be read: " + (code == Z_ERRNO ? std::strerror(errno) : printable(text)));
  return static_cast<std::size_t>(count);
}

std::string text_of_file(const std::string& path, std::size_t largest) {
  const bool is_input = path == "-";
  std::optional<GzipFile> file;
  std::string text, piece(std::size_t{1} << 16, '\0');
  if (!is_input) file.emplace(path, GzipFile::Pipes::read);
  const std::string shown = is_input ? "<stdin>" : printable(path, longest_name);
  while (const std::size_t count =
             is_input ? std::fread(piece.data(), 1, piece.size(), stdin) : file->read(piece)) {
    if (text.size() + count > largest)
      throw DomainError(shown + ": has more than " + std::to_string(largest >> 20) + " MiB");
    text.append(piece, 0, count);
  }
  if (is_input && std::ferror(stdin) != 0)
    throw DomainError(shown + ": cannot be read: " + std::strerror(errno));
  return text;
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
