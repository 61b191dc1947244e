// SPDX-License-Identifier: MIT
// LineStream: doubles written one after the other; a large array goes past the caches into memory,
// line by line.
//
// Domain      any array of doubles, wherever it begins. For sources that are compiled for the set
//             `isa`.
// Accuracy    exact.
// Cost        one load and one store a register. Past the caches memory is not read before it is
//             written, so that half of its traffic is left out.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "polhode/math/detail/registers.hpp"

namespace polhode {
inline namespace v0 {

template <InstructionSet isa>
class LineStream {
 public:
  // From so many bytes on results are larger than what caches keep for long.
  static constexpr std::size_t large = std::size_t{1} << 21;
  static constexpr std::size_t line = 8;  // doubles

  // Room for `count` doubles at `to`.
  [[gnu::always_inline]] LineStream(double* to, std::size_t count)
      : to_(to), streams_(count * sizeof(double) >= large) {}
  LineStream(const LineStream&) = delete;
  LineStream& operator=(const LineStream&) = delete;
  // What is left of the last line; at the end, once.
  [[gnu::always_inline]] void finish() {
    std::memcpy(to_, kept_, count_ * sizeof(double));
    if (streams_) detail::order_streams();
  }

  // Whether numbers may as well be written to place(), and then be skipped.
  [[gnu::always_inline]] bool is_direct() const { return !streams_; }
  [[gnu::always_inline]] double* place() const { return to_; }
  [[gnu::always_inline]] void skip(std::size_t count) { to_ += count; }

  [[gnu::always_inline]] void put(const double* from, std::size_t count) {
    if (!streams_) {
      std::memcpy(to_, from, count * sizeof(double));
      to_ += count;
      return;
    }
    if (count_ > 0 || reinterpret_cast<std::uintptr_t>(to_) % (line * sizeof(double)) != 0) {
      const std::size_t n = std::min(count, to_line_end());
      std::memcpy(kept_ + count_, from, n * sizeof(double));
      count_ += n;
      from += n;
      count -= n;
      if (to_line_end() != 0) return;
      flush();
    }
    for (; count >= line; count -= line, from += line, to_ += line) detail::stream_line(from, to_);
    std::memcpy(kept_, from, count * sizeof(double));
    count_ = count;
  }

 private:
  // How many more belong to the line of what is kept.
  [[gnu::always_inline]] std::size_t to_line_end() const {
    const std::size_t at = reinterpret_cast<std::uintptr_t>(to_) / sizeof(double) % line + count_;
    return at >= line ? 0 : line - at;
  }
  [[gnu::always_inline]] void flush() {
    if (count_ == line)
      detail::stream_line(kept_, to_);
    else
      std::memcpy(to_, kept_, count_ * sizeof(double));
    to_ += count_;
    count_ = 0;
  }

  double* to_;  // where what is kept begins
  bool streams_;
  std::size_t count_ = 0;
  double kept_[line];
};

}  // namespace v0
}  // namespace polhode
