// SPDX-License-Identifier: MIT
// A file that has its name only when it is complete: written as PATH.part, renamed by commit().
#pragma once

#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "polhode/error.hpp"
#include "polhode/output/sink.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

// The name to write under before `path` is complete: PATH.part, or the path itself for a device or
// a pipe. Throws DomainError for a folder.
std::string part_path(const std::string& path);
// Beside a part that changes in place: what stood there at its last savepoint.
std::string undo_path(const std::string& part);
// Gives a finished part its name. Throws OutputError.
void rename_part(const std::string& part, const std::string& path);
// What a part that goes on must be: as long as this and more, with this in front. One that has
// got its name already, by a process that was killed then, may lose it again.
struct PartState {
  std::int64_t bytes = 0;
  std::string head = {};
  bool may_be_named = true;
};
// The descriptor of a file that is there or is made, for reading and writing, and for one process
// alone. Throws as new_part.
int locked_file(const std::string& path);
// The descriptor of an empty part, and of one that is there, cut back to its state; for reading and
// writing, and for one process alone. Throw DomainError when the path cannot be had or another run
// has it, OutputError when the machine fails.
int new_part(const std::string& part);
int reopened_part(const std::string& part, const PartState& state);
// DomainError (FileInUse) where another process writes the part of an output.
void require_not_in_use(const std::string& path);
// Another process has it.
struct FileInUse : DomainError {
  using DomainError::DomainError;
};

// "PATH: cannot be written: No space left on device"
std::string write_failure(const std::string& path, int error_number);
// The disk is full, or the file may not grow: what to do before going on.
struct NoSpace : OutputError {
  NoSpace(const std::string& what, std::string what_to_do)
      : OutputError(what), remedy(std::move(what_to_do)) {}
  std::string remedy;
};
// Throws OutputError, NoSpace where that is why.
[[noreturn]] void fail_to_write(const std::string& path, int error_number);

class PartFile {
 public:
  // "-" is standard output. With a state, the part that is there goes on behind it. Throws as
  // new_part and reopened_part.
  explicit PartFile(const std::string& path, const std::optional<PartState>& from = std::nullopt);
  ~PartFile();
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;

  // Throws OutputError when not all of it could be written.
  void write(std::string_view bytes);
  // Over bytes that have been written.
  void overwrite(std::int64_t offset, std::string_view bytes);
  void commit();
  // How long the part is, all of it on the disk; none for standard output, devices and pipes.
  std::optional<std::int64_t> synced_bytes();

 private:
  std::string path_;
  std::string part_;
  std::FILE* file_;
  std::int64_t bytes_ = 0;
};

// A file of our own next to an output, as a whole or not at all: its path is no input, so that
// whatever keeps it from being written is an OutputError.
void replace_file(const std::string& path, std::string_view bytes);

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
