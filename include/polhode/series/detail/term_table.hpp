// SPDX-License-Identifier: MIT
// Terms added up by their codes, and sorted: a hash table with open addresses.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include "polhode/version.hpp"  // asks for C++20

namespace polhode {
inline namespace v0 {
namespace series {
namespace detail {

template <class Word, class T>
struct CodedTerm {
  Word code;
  T c;
};

template <class Word, class T>
class TermTable {
 public:
  using Slot = CodedTerm<Word, T>;

  // expected: how many codes there will be, or fewer. bits: how many a code has, fewer than Word.
  TermTable(std::size_t expected, int bits)
      : slots_(std::bit_ceil(std::max<std::size_t>(16, 2 * expected)), Slot{free_code, T(0)}),
        bits_(bits),
        shift_(64 - std::countr_zero(slots_.size())) {}

  void add(Word code, const T& c) {
    Slot& slot = slot_of(code);
    if (slot.code == code) {
      slot.c = slot.c + c;
      return;
    }
    slot.code = code;
    slot.c = c;
    if (++used_ * 2 > slots_.size()) grow();
  }

  // Ascending, without zeros.
  std::vector<Slot> sorted() && {
    std::erase_if(slots_,
                  [](const Slot& slot) { return slot.code == free_code || slot.c == T(0); });
    if (std::is_trivially_copyable_v<T> && slots_.size() > 200)
      sort_by_digits();
    else
      std::sort(slots_.begin(), slots_.end(),
                [](const Slot& a, const Slot& b) { return a.code < b.code; });
    return std::move(slots_);
  }

 private:
  static constexpr Word free_code = ~Word{0};
  static constexpr int digit_bits = 11;

  std::size_t place(Word code) const {
    auto h = static_cast<std::uint64_t>(code);
    if constexpr (sizeof(Word) > 8)
      h ^= static_cast<std::uint64_t>(code >> 64) * 0x243f6a8885a308d3U;
    h *= 0x9e3779b97f4a7c15U;  // 2^64 over the golden ratio
    h ^= h >> 32;
    return static_cast<std::size_t>((h * 0x9e3779b97f4a7c15U) >> shift_);
  }
  // At most as many looks as there are slots; half of them are free.
  Slot& slot_of(Word code) {
    std::size_t i = place(code);
    while (slots_[i].code != code && slots_[i].code != free_code) i = (i + 1) & (slots_.size() - 1);
    return slots_[i];
  }
  void grow() {
    std::vector<Slot> old(2 * slots_.size(), Slot{free_code, T(0)});
    old.swap(slots_);
    --shift_;
    for (Slot& slot : old)
      if (slot.code != free_code) slot_of(slot.code) = std::move(slot);
  }
  // From the least significant digit on, each time in the order of the digits below. At most 12
  // times.
  void sort_by_digits() {
    std::vector<Slot> other(slots_.size());
    for (int low = 0; low < bits_; low += digit_bits) {
      constexpr std::size_t digits = std::size_t{1} << digit_bits;
      const auto digit = [low](const Slot& slot) {
        return static_cast<std::size_t>(slot.code >> low) & (digits - 1);
      };
      std::array<std::size_t, digits> start{};
      for (const Slot& slot : slots_) ++start[digit(slot)];
      std::size_t sum = 0;
      for (std::size_t& count : start) sum += std::exchange(count, sum);
      for (Slot& slot : slots_) other[start[digit(slot)]++] = std::move(slot);
      slots_.swap(other);
    }
  }

  std::vector<Slot> slots_;
  std::size_t used_ = 0;
  int bits_, shift_;
};

}  // namespace detail
}  // namespace series
}  // namespace v0
}  // namespace polhode
