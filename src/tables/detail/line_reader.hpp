// SPDX-License-Identifier: MIT
// Lines of a stream of bytes, in constant memory and without a copy per line.
#pragma once

#include <cstring>
#include <optional>
#include <string>
#include <string_view>

#include "polhode/tables/convert.hpp"
#include "tables/detail/trimmed.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

class LineReader {
 public:
  static constexpr std::size_t longest_line = std::size_t{1} << 20;

  explicit LineReader(const ByteSource& source)
      : source_(source), buffer_(std::size_t{1} << 16, '\0') {}

  // The next line without its end, valid until the next call; nothing at the end of the stream or
  // when a line is too long.
  std::optional<std::string_view> next() {
    for (;;) {
      const char* begin = buffer_.data() + first_;
      const std::size_t size = last_ - first_;
      const void* found =
          size > searched_ ? std::memchr(begin + searched_, '\n', size - searched_) : nullptr;
      if (found != nullptr) {
        const auto length = static_cast<std::size_t>(static_cast<const char*>(found) - begin);
        first_ += length + 1;
        searched_ = 0;
        return line({begin, length});
      }
      searched_ = size;
      if (size > longest_line) {
        too_long_ = true;
        return std::nullopt;
      }
      if (ended_) {
        first_ = last_;
        searched_ = 0;
        if (size == 0) return std::nullopt;
        return line({begin, size});
      }
      refill();
    }
  }
  bool too_long() const { return too_long_; }

 private:
  std::string_view line(std::string_view bytes) {
    if (bytes.ends_with('\r')) bytes.remove_suffix(1);
    if (is_first_) bytes = without_mark(bytes);
    is_first_ = false;
    return bytes;
  }
  void refill() {
    std::memmove(buffer_.data(), buffer_.data() + first_, last_ - first_);
    last_ -= first_;
    first_ = 0;
    if (last_ > buffer_.size() / 2 && buffer_.size() < 2 * longest_line)
      buffer_.resize(2 * buffer_.size());  // up to 2 MiB, for lines that are so long
    const std::size_t count = source_({buffer_.data() + last_, buffer_.size() - last_});
    ended_ = count == 0;
    last_ += count;
  }

  const ByteSource& source_;
  std::string buffer_;
  std::size_t first_ = 0;
  std::size_t last_ = 0;
  std::size_t searched_ = 0;  // of the line that begins at first_
  bool is_first_ = true;      // the line that comes next
  bool ended_ = false;
  bool too_long_ = false;
};

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
