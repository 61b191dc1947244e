// SPDX-License-Identifier: MIT
#include "io/detail/part_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
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

int reopened_part(const std::string& part, std::int64_t bytes) {
  const int descriptor = ::open(part.c_str(), O_RDWR | O_CLOEXEC);
  if (descriptor < 0)
    throw DomainError(printable(part, longest_path) +
                      ": cannot be continued: " + std::strerror(errno));
  struct stat status {};
  std::string why;
  if (::fstat(descriptor, &status) != 0 || ::lseek(descriptor, bytes, SEEK_SET) < 0) {
    why = std::strerror(errno);
  } else if (!S_ISREG(status.st_mode) || status.st_size < bytes) {
    why = "it has " + std::to_string(status.st_size) + " bytes; expected " + std::to_string(bytes) +
          " and more";
  } else if (::ftruncate(descriptor, bytes) != 0) {
    why = std::strerror(errno);
  }
  if (why.empty()) return descriptor;
  ::close(descriptor);
  throw DomainError(printable(part, longest_path) + ": cannot be continued: " + why);
}

PartFile::PartFile(const std::string& path, std::optional<std::int64_t> from)
    : path_(path), part_(path == "-" ? path : part_path(path)), file_(stdout) {
  if (path == "-") return;
  if (from) {
    file_ = ::fdopen(reopened_part(part_, *from), "r+b");
    bytes_ = *from;
    if (file_ == nullptr) throw DomainError(write_failure(part_, errno));
    return;
  }
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
    bytes_ += written;
  }
}

std::optional<std::int64_t> PartFile::synced_bytes() {
  if (part_ == path_) return std::nullopt;
  if (::fsync(::fileno(file_)) != 0) throw OutputError(write_failure(part_, errno));
  return bytes_;
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
