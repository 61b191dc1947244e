// SPDX-License-Identifier: MIT
// Orders of terms by the weights of a truncation.
#pragma once

#include <utility>
#include <vector>

#include "polhode/series/series.hpp"
#include "polhode/series/symbols.hpp"

namespace polhode {
inline namespace v0 {
namespace series {
namespace detail {

class Orders {
 public:
  // Throws for a weight that is negative or above 1000, and for what is no variable.
  Orders(const Symbols& symbols, const Truncation& keep);

  bool is_weighted() const { return !weights_.empty(); }
  // Of at most 12 variables.
  int of(const TermKey& key) const {
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

}  // namespace detail
}  // namespace series
}  // namespace v0
}  // namespace polhode
