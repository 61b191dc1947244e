// SPDX-License-Identifier: MIT
// The bytes of a file, unpacked where it is a .gz.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

class GzipFile {
 public:
  enum class Pipes { rejected, read };

  // DomainError where it cannot be opened, or is a folder.
  explicit GzipFile(const std::string& path, Pipes pipes = Pipes::rejected);
  ~GzipFile();
  GzipFile(const GzipFile&) = delete;
  GzipFile& operator=(const GzipFile&) = delete;

  // How many bytes it wrote; 0 at the end. DomainError for a damaged file.
  std::size_t read(std::span<char> bytes);

 private:
  std::string shown_;
  void* stream_ = nullptr;  // gzFile
};

// The whole of a file or pipe, unpacked; "-" is standard input as it is. DomainError when it cannot
// be read or has more than `largest` bytes.
std::string text_of_file(const std::string& path, std::size_t largest);

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
