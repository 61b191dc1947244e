// SPDX-License-Identifier: MIT
#include "output/part_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <utility>

#include "polhode/error.hpp"
#include "polhode/output/sink.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

constexpr int most_trips = 100;  // other processes that finish just when a file is opened

}  // namespace

std::string write_failure(const std::string& path, int error_number) {
  const std::string name = path == "-" ? "<stdout>" : printable(path, longest_path);
  return name + ": cannot be written: " + std::strerror(error_number);
}

void fail_to_write(const std::string& path, int error_number) {
  const std::string what = write_failure(path, error_number);
  if (error_number == ENOSPC || error_number == EDQUOT) throw NoSpace(what, "make space");
  if (error_number == EFBIG)
    throw NoSpace(what, "raise the limit on the size of files (ulimit -f)");
  throw OutputError(what);
}

std::string part_path(const std::string& path) {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(path, ignored);
  if (std::filesystem::is_directory(status) || path.ends_with('/'))
    throw DomainError(printable(path, longest_path) + ": is a folder; expected a file to write");
  const bool other = std::filesystem::exists(status) && !std::filesystem::is_regular_file(status);
  return other ? path : path + ".part";
}

std::string undo_path(const std::string& part) { return part + "-undo"; }

void rename_part(const std::string& part, const std::string& path) {
  if (part == path) return;
  if (std::rename(part.c_str(), path.c_str()) != 0) fail_to_write(path, errno);
}

namespace {

// Locks of an open file: they keep other processes out, and no reader. Not every file system has
// them.
void require_alone(int descriptor, const std::string& part) {
  struct flock lock {};
  lock.l_type = F_WRLCK;
  lock.l_whence = SEEK_SET;
  if (::fcntl(descriptor, F_OFD_SETLK, &lock) == 0 || (errno != EAGAIN && errno != EACCES)) return;
  ::close(descriptor);
  throw FileInUse(printable(part, longest_path) + ": another process is writing it");
}

// Not where another process has given the file its name, or removed it, between open and lock.
bool is_still_at(int descriptor, const std::string& path) {
  struct stat of {};
  struct stat there {};
  return ::fstat(descriptor, &of) == 0 && ::stat(path.c_str(), &there) == 0 &&
         of.st_dev == there.st_dev && of.st_ino == there.st_ino;
}

// What a user's path can be wrong in; the rest is a machine that cannot.
[[noreturn]] void fail_to_open(const std::string& part, int error_number) {
  constexpr int wrong_paths[] = {EACCES, EPERM,   EROFS,        EISDIR, ENOENT,
                                 ENXIO,  ENOTDIR, ENAMETOOLONG, ELOOP,  EINVAL};
  if (std::ranges::find(wrong_paths, error_number) != std::end(wrong_paths))
    throw DomainError(write_failure(part, error_number));
  fail_to_write(part, error_number);
}

std::string difference(int descriptor, const PartState& state) {
  struct stat status {};
  if (::fstat(descriptor, &status) != 0) return std::strerror(errno);
  if (!S_ISREG(status.st_mode) || status.st_size < state.bytes)
    return "it has " + std::to_string(status.st_size) + " bytes; expected " +
           std::to_string(state.bytes) + " and more";
  std::string head(state.head.size(), '\0');
  if (::pread(descriptor, head.data(), head.size(), 0) != static_cast<ssize_t>(head.size()) ||
      head != state.head)
    return "it is the output of another scenario";
  return {};
}

}  // namespace

int locked_file(const std::string& path) {
  for (int trip = 0; trip < most_trips; ++trip) {
    const int descriptor = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor < 0 && errno == ENOENT)
      throw DomainError(printable(path, longest_path) + ": its folder does not exist");
    if (descriptor < 0) fail_to_open(path, errno);
    require_alone(descriptor, path);
    if (is_still_at(descriptor, path)) return descriptor;
    ::close(descriptor);
  }
  throw FileInUse(printable(path, longest_path) + ": other processes are writing it");
}

void require_not_in_use(const std::string& path) {
  if (path == "-") return;
  const std::string part = part_path(path);
  const int descriptor = part == path ? -1 : ::open(part.c_str(), O_RDWR | O_CLOEXEC);
  if (descriptor < 0) return;
  struct flock lock {};
  lock.l_type = F_WRLCK;
  lock.l_whence = SEEK_SET;
  const bool free = ::fcntl(descriptor, F_OFD_GETLK, &lock) != 0 || lock.l_type == F_UNLCK;
  ::close(descriptor);
  if (!free) throw FileInUse(printable(part, longest_path) + ": another process is writing it");
}

int new_part(const std::string& part) {
  const int descriptor = locked_file(part);
  if (::ftruncate(descriptor, 0) == 0) return descriptor;
  const int error_number = errno;
  ::close(descriptor);
  fail_to_open(part, error_number);
}

int reopened_part(const std::string& part, const PartState& state) {
  const std::string name = part.substr(0, part.size() - std::string_view(".part").size());
  std::string there = part;
  int descriptor = ::open(part.c_str(), O_RDWR | O_CLOEXEC);
  if (descriptor < 0 && errno == ENOENT && state.may_be_named) {
    there = name;
    descriptor = ::open(name.c_str(), O_RDWR | O_CLOEXEC);
  }
  if (descriptor < 0)
    throw DomainError(printable(part, longest_path) + ": cannot be continued: " +
                      (errno == ENOENT ? "it is gone" : std::strerror(errno)) + "; expected the " +
                      std::to_string(state.bytes) + " bytes that its checkpoint counts");
  require_alone(descriptor, part);
  if (!is_still_at(descriptor, there)) {
    ::close(descriptor);
    throw FileInUse(printable(part, longest_path) +
                    ": cannot be continued: another process has just finished it");
  }
  std::string why = difference(descriptor, state);
  if (why.empty() && (::ftruncate(descriptor, state.bytes) != 0 ||
                      ::lseek(descriptor, state.bytes, SEEK_SET) < 0 ||
                      (there != part && std::rename(there.c_str(), part.c_str()) != 0)))
    why = std::strerror(errno);
  if (why.empty()) return descriptor;
  ::close(descriptor);
  throw DomainError(printable(part, longest_path) + ": cannot be continued: " + why);
}

PartFile::PartFile(const std::string& path, const std::optional<PartState>& from)
    : path_(path), part_(path == "-" ? path : part_path(path)), file_(stdout) {
  if (path == "-") return;
  if (part_ == path_) {  // a device or a pipe
    file_ = std::fopen(part_.c_str(), "wb");
  } else {
    file_ = ::fdopen(from ? reopened_part(part_, *from) : new_part(part_), "r+b");
  }
  if (file_ == nullptr) fail_to_open(part_, errno);
  if (from) bytes_ = from->bytes;
}

PartFile::~PartFile() {
  if (file_ != nullptr && file_ != stdout) std::fclose(file_);
}

// Past the buffer of FILE: what has been written is in the file, even if the process is killed.
// Where not all of it has space, none of it stays: a file ends with a whole row.
void PartFile::write(std::string_view bytes) {
  const auto all = static_cast<std::int64_t>(bytes.size());
  while (!bytes.empty()) {
    const ssize_t written = ::write(::fileno(file_), bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) {
      const int error_number = written == 0 ? ENOSPC : errno;
      const bool cut = part_ != path_ && ::ftruncate(::fileno(file_), bytes_) == 0 &&
                       ::lseek(::fileno(file_), bytes_, SEEK_SET) == bytes_;
      static_cast<void>(cut);
      fail_to_write(part_, error_number);
    }
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  bytes_ += all;
}

void PartFile::overwrite(std::int64_t offset, std::string_view bytes) {
  const ssize_t written = ::pwrite(::fileno(file_), bytes.data(), bytes.size(), offset);
  if (written != static_cast<ssize_t>(bytes.size()))
    fail_to_write(part_, written < 0 ? errno : ENOSPC);
}

std::optional<std::int64_t> PartFile::synced_bytes() {
  if (part_ == path_) return std::nullopt;
  if (::fsync(::fileno(file_)) != 0) fail_to_write(part_, errno);
  return bytes_;
}

void PartFile::commit() {
  if (path_ == "-") return;
  const bool named = part_ != path_;
  if (named && ::fsync(::fileno(file_)) != 0) fail_to_write(part_, errno);
  rename_part(part_, path_);  // before the lock goes with fclose
  if (std::fclose(std::exchange(file_, nullptr)) != 0) fail_to_write(part_, errno);
}

void replace_file(const std::string& path, std::string_view bytes) {
  try {
    PartFile file(path);
    file.write(bytes);
    file.commit();
  } catch (const DomainError& error) {
    throw OutputError(error.what());
  }
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
