// SPDX-License-Identifier: MIT
// Which terms a product keeps, how much memory it may take, and how much it may need.
//
// Equations   order of a term = sum of weight times exponent.
// Units       bytes.
// Domain      weights >= 0, by the names of variables; none keeps all terms.
// Accuracy    exact orders; sizes are upper bounds.
// Errors      none here; product.hpp and its companions throw.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "polhode/version.hpp"  // asks for C++20

namespace polhode {
inline namespace v0 {

struct Truncation {
  std::vector<std::pair<std::string, int>> weights;
  int order = 0;                                  // the highest that is kept
  std::size_t most_bytes = std::size_t{4} << 30;  // of one product, its digits on the heap apart

  bool cuts(int of_term) const { return !weights.empty() && of_term > order; }
};

struct ProductSize {
  double pairs;  // of terms that are multiplied
  double terms;  // of the result, at most
  double bytes;  // while it is made, at most
};

}  // namespace v0
}  // namespace polhode
