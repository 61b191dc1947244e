// SPDX-License-Identifier: MIT
#include "io/detail/part_file.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <utility>

#include "io/detail/values.hpp"
#include "polhode/error.hpp"
#include "polhode/io/sink.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

constexpr std::size_t longest_path = 500;

}  // namespace

std::string write_failure(const std::string& path, int error_number) {
  const std::string name = path == "-" ? "<stdout>" : printable(path, longest_path);
  return name + ": cannot be written: " + std::strerror(error_number);
}

std::string part_path(const std::string& path) {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(path, ignored);
  if (std::filesystem::is_directory(status) || path.ends_with('/'))
    throw DomainError(printable(path, longest_path) + ": is a folder; expected a file to write");
  const bool other = std::filesystem::exists(status) && !std::filesystem::is_regular_file(status);
  return other ? path : path + ".part";
}

void rename_part(const std::string& part, const std::string& path) {
  if (part == path) return;
  if (std::rename(part.c_str(), path.c_str()) != 0) throw OutputError(write_failure(path, errno));
}

PartFile::PartFile(const std::string& path)
    : path_(path), part_(path == "-" ? path : part_path(path)), file_(stdout) {
  if (path == "-") return;
  file_ = std::fopen(part_.c_str(), "wb");
  if (file_ == nullptr && errno == ENOENT)
    throw DomainError(printable(path, longest_path) + ": its folder does not exist");
  if (file_ == nullptr) throw DomainError(write_failure(part_, errno));
}

PartFile::~PartFile() {
  if (file_ != nullptr && file_ != stdout) std::fclose(file_);
}

// Past the buffer of FILE: what has been written is in the file, even if the process is killed.
void PartFile::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(::fileno(file_), bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) throw OutputError(write_failure(part_, written == 0 ? ENOSPC : errno));
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void PartFile::commit() {
  if (path_ == "-") return;
  const bool named = part_ != path_;
  if (named && ::fsync(::fileno(file_)) != 0) throw OutputError(write_failure(part_, errno));
  if (std::fclose(std::exchange(file_, nullptr)) != 0)
    throw OutputError(write_failure(part_, errno));
  rename_part(part_, path_);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
