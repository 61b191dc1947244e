// SPDX-License-Identifier: MIT
// Terms added up by their keys: a hash table with open addresses.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "polhode/series/key.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template <class T>
class TermTable {
 public:
  TermTable() : slots_(16, Term<T>{free_key, T(0)}), shift_(64 - 4) {}

  void add(const Key& key, const T& c) {
    Term<T>& slot = slot_of(key);
    if (slot.key == key) {
      slot.c = slot.c + c;
      return;
    }
    slot = {key, c};
    if (++used_ * 2 > slots_.size()) grow();
  }

  // In any order; zeros are left out. Empties the table.
  std::vector<Term<T>> terms() && {
    std::erase_if(slots_,
                  [](const Term<T>& slot) { return slot.key == free_key || slot.c == T(0); });
    used_ = 0;
    return std::move(slots_);
  }

 private:
  // No key fits with all bits set.
  static constexpr Key free_key{~std::uint64_t{0}, ~std::uint64_t{0}};

  std::size_t place(const Key& key) const {
    // Odd numbers without a pattern: 2^64 over the golden ratio, and the fraction of pi.
    std::uint64_t h = key.exponents * 0x9e3779b97f4a7c15U + key.multipliers;
    h ^= h >> 32;
    h *= 0x243f6a8885a308d3U;
    h ^= h >> 29;
    return static_cast<std::size_t>((h * 0x9e3779b97f4a7c15U) >> shift_);
  }
  // At most as many looks as there are slots; half of them are free.
  Term<T>& slot_of(const Key& key) {
    std::size_t i = place(key);
    while (slots_[i].key != key && slots_[i].key != free_key) i = (i + 1) & (slots_.size() - 1);
    return slots_[i];
  }
  void grow() {
    std::vector<Term<T>> old(2 * slots_.size(), Term<T>{free_key, T(0)});
    old.swap(slots_);
    --shift_;
    for (Term<T>& slot : old)
      if (slot.key != free_key) slot_of(slot.key) = std::move(slot);
  }

  std::vector<Term<T>> slots_;
  std::size_t used_ = 0;
  int shift_;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
