// SPDX-License-Identifier: MIT
// A file that has its name only when it is complete: written as PATH.part, renamed by commit().
#pragma once

#include <cstdio>
#include <string>
#include <string_view>

namespace polhode {
inline namespace v0 {
namespace detail {

// The name to write under before `path` is complete: PATH.part, or the path itself for a device or
// a pipe. Throws DomainError for a folder.
std::string part_path(const std::string& path);
// Gives a finished part its name. Throws OutputError.
void rename_part(const std::string& part, const std::string& path);
// "PATH: cannot be written: No space left on device"
std::string write_failure(const std::string& path, int error_number);

class PartFile {
 public:
  // "-" is standard output. Throws DomainError when it cannot be opened.
  explicit PartFile(const std::string& path);
  ~PartFile();
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;

  // Throws OutputError when not all of it could be written.
  void write(std::string_view bytes);
  void commit();

 private:
  std::string path_;
  std::string part_;
  std::FILE* file_;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
