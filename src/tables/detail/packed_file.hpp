// SPDX-License-Identifier: MIT
// The bytes of a file, unpacked where it is a .gz.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace polhode {
inline namespace v0 {
namespace detail {

class PackedFile {
 public:
  // DomainError where it cannot be opened, or is a folder.
  explicit PackedFile(const std::string& path);
  ~PackedFile();
  PackedFile(const PackedFile&) = delete;
  PackedFile& operator=(const PackedFile&) = delete;

  // How many bytes it wrote; 0 at the end. DomainError for a damaged file.
  std::size_t read(std::span<char> bytes);

 private:
  std::string shown_;
  void* stream_ = nullptr;  // gzFile
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
