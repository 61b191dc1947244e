// SPDX-License-Identifier: MIT
// The box of exponents and multipliers that the terms of products are in.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <span>
#include <vector>

#include "polhode/series/symbols.hpp"

namespace polhode {
inline namespace v0 {
namespace series {
namespace detail {

// From least to largest. Of an angle: from -largest to largest.
struct FieldRange {
  int least = 0, largest = 0;
};

struct KeyBox {
  std::vector<FieldRange> variables, angles;

  // Makes room for the products of two series; none is empty.
  template <class T>
  void add_product(const Symbols& symbols, std::span<const Term<T>> a, std::span<const Term<T>> b) {
    for (std::size_t i = 0; i < variables.size(); ++i) {
      const auto at = [&](const TermKey& key) {
        return exponent(symbols, key, static_cast<int>(i));
      };
      const FieldRange of_a = range<T>(a, at), of_b = range<T>(b, at);
      const int least = of_a.least + of_b.least, largest = of_a.largest + of_b.largest;
      variables[i].least = is_empty ? least : std::min(variables[i].least, least);
      variables[i].largest = is_empty ? largest : std::max(variables[i].largest, largest);
    }
    for (std::size_t i = 0; i < angles.size(); ++i) {
      const auto at = [&](const TermKey& key) {
        return std::abs(multiplier(symbols, key, static_cast<int>(i)));
      };
      const int largest = range<T>(a, at).largest + range<T>(b, at).largest;
      angles[i] = {0, std::max(angles[i].largest, largest)};
    }
    is_empty = false;
  }

  // Of a field from 0 to n.
  static int width(int n) {
    int bits = 0;
    for (; n != 0; n /= 2) ++bits;
    return bits;
  }
  // Fields of all, and the function.
  int bits() const {
    int sum = 1;
    for (const FieldRange& range : variables) sum += width(range.largest - range.least);
    for (const FieldRange& range : angles) sum += width(2 * range.largest);
    return sum;
  }
  // How many there are in it.
  double keys() const {
    double all = 1.0;
    for (const FieldRange& range : variables) all *= range.largest - range.least + 1;
    // Half of the angles are the others turned round; each has a cosine and a sine.
    for (const FieldRange& range : angles) all *= 2 * range.largest + 1;
    return all;
  }

  bool is_empty = true;

 private:
  template <class T, class At>
  static FieldRange range(std::span<const Term<T>> terms, const At& at) {
    FieldRange found{at(terms[0].key), at(terms[0].key)};
    for (const Term<T>& term : terms) {
      found.least = std::min(found.least, at(term.key));
      found.largest = std::max(found.largest, at(term.key));
    }
    return found;
  }
};

}  // namespace detail
}  // namespace series
}  // namespace v0
}  // namespace polhode
