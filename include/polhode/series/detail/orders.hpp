// SPDX-License-Identifier: MIT
// Orders of terms by the weights of a truncation, and how many keys lie between bounds.
#pragma once

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "polhode/series/key.hpp"
#include "polhode/series/truncation.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

class Orders {
 public:
  // Throws for a weight that is negative or above 1000, and for what is no variable.
  Orders(const Symbols& symbols, const Truncation& keep);

  bool is_weighted() const { return !weights_.empty(); }
  // Of at most 12 variables.
  int of(const Key& key) const {
    int order = 0;
    for (const auto& [variable, weight] : weights_)
      order += weight * fields_.at(key.exponents, variable);
    return order;
  }

 private:
  PackedFields fields_;
  std::vector<std::pair<int, int>> weights_;
};

// Throws where a product may need more.
void require_room(const ProductSize& size, std::size_t most_bytes);

// The least and the largest of each field: exponents, then multipliers.
struct KeyRange {
  std::vector<std::pair<int, int>> fields;
};

class KeyBox {
 public:
  explicit KeyBox(const Symbols& symbols) : symbols_(symbols) {}

  template <class T>
  KeyRange range(std::span<const Term<T>> terms) const {
    KeyRange range;
    const auto visit = [&](const PackedFields& fields, auto word) {
      for (int i = 0; i < fields.count(); ++i) {
        int least = 0, largest = 0;
        bool first = true;
        for (const Term<T>& term : terms) {
          const int n = fields.at(word(term.key), i);
          least = first ? n : std::min(least, n);
          largest = first ? n : std::max(largest, n);
          first = false;
        }
        range.fields.emplace_back(least, largest);
      }
    };
    visit(symbols_.exponents(), [](const Key& key) { return key.exponents; });
    visit(symbols_.multipliers(), [](const Key& key) { return key.multipliers; });
    return range;
  }
  // Of a product, at most.
  double keys(const KeyRange& a, const KeyRange& b) const;

 private:
  const Symbols& symbols_;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
