// SPDX-License-Identifier: MIT
// All pairs of terms of two series whose order is kept, multiplied and added up.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "polhode/series/detail/orders.hpp"
#include "polhode/series/detail/term_table.hpp"
#include "polhode/series/key.hpp"
#include "polhode/series/truncation.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// Orders of terms, ascending, with the place of each term.
template <class T>
std::vector<std::pair<int, std::size_t>> by_order(std::span<const Term<T>> terms,
                                                  const Orders& orders) {
  std::vector<std::pair<int, std::size_t>> sorted;
  sorted.reserve(terms.size());
  for (std::size_t i = 0; i < terms.size(); ++i) sorted.emplace_back(orders.of(terms[i].key), i);
  if (orders.is_weighted()) std::sort(sorted.begin(), sorted.end());
  return sorted;
}

template <class T>
ProductSize product_size(const Symbols& symbols, std::span<const Term<T>> a,
                         std::span<const Term<T>> b, const Orders& orders, int order) {
  double pairs = static_cast<double>(a.size()) * static_cast<double>(b.size());
  if (orders.is_weighted()) {
    const auto left = by_order<T>(a, orders), right = by_order<T>(b, orders);
    pairs = 0.0;
    std::size_t kept = right.size();
    for (const auto& [of_a, i] : left) {
      while (kept > 0 && of_a + right[kept - 1].first > order) --kept;
      pairs += static_cast<double>(kept);
    }
  }
  KeyBox box(symbols);
  const double keys = box.keys(box.range<T>(a), box.range<T>(b));
  const double terms = std::min(2.0 * pairs, keys);
  // A table is half full at most and twice as large where it grew last; then it is kept while the
  // next one is filled.
  return {pairs, terms, 4.0 * terms * static_cast<double>(sizeof(Term<T>))};
}

// A sum of products of series.
template <class T>
class Products {
 public:
  Products(const Symbols& symbols, const Truncation& keep)
      : symbols_(symbols), orders_(symbols, keep), keep_(keep) {}

  // factor * a * b.
  void add(std::span<const Term<T>> a, std::span<const Term<T>> b, const T& factor) {
    require_room(product_size<T>(symbols_, a, b, orders_, keep_.order), keep_.most_bytes);
    const auto right = by_order<T>(b, orders_);
    std::vector<Term<T>> sorted;
    sorted.reserve(b.size());
    for (const auto& [order, i] : right) sorted.push_back(b[i]);
    for (const Term<T>& term : a) {
      std::size_t count = sorted.size();
      if (orders_.is_weighted()) {
        const long long room = static_cast<long long>(keep_.order) - orders_.of(term.key);
        count = static_cast<std::size_t>(
            std::partition_point(right.begin(), right.end(),
                                 [&](const auto& one) { return one.first <= room; }) -
            right.begin());
      }
      add_row(term, std::span<const Term<T>>(sorted).first(count), factor);
    }
  }

  // Sorted.
  std::vector<Term<T>> terms() && {
    std::vector<Term<T>> all = std::move(table_).terms();
    std::sort(all.begin(), all.end(),
              [](const Term<T>& a, const Term<T>& b) { return a.key < b.key; });
    all.shrink_to_fit();
    return all;
  }

 private:
  void add_row(const Term<T>& a, std::span<const Term<T>> b, const T& factor) {
    const PackedFields& exponents = symbols_.exponents();
    const PackedFields& multipliers = symbols_.multipliers();
    const std::uint64_t zero = multipliers.zero(), of_a = a.key.angle();
    const bool sine_a = a.key.function() == Function::sine;
    const T whole = factor * a.c, half = whole / T(2);
    for (const Term<T>& term : b) {
      const std::uint64_t of_b = term.key.angle();
      const std::uint64_t word = exponents.sum(a.key.exponents, term.key.exponents);
      const bool sine_b = term.key.function() == Function::sine;
      const std::uint64_t function = sine_a != sine_b ? Key::function_bit : 0;
      const Key sum{word, multipliers.sum(of_a, of_b)};
      if (!fits(symbols_, sum)) out_of_range(symbols_, sum);
      if (of_a == zero || of_b == zero) {
        table_.add({word, sum.multipliers | function}, whole * term.c);
        continue;
      }
      const T c = half * term.c;
      // cos cos, sin cos and cos sin have + of A + B; sin sin has -.
      table_.add({word, sum.multipliers | function}, sine_a && sine_b ? -c : c);
      add_difference(word, multipliers.difference(of_a, of_b), function, c, sine_b && !sine_a);
    }
  }
  // c cos(A - B), or sin; -c where the sine is that of B.
  void add_difference(std::uint64_t word, std::uint64_t angle, std::uint64_t function, const T& c,
                      bool negative) {
    const PackedFields& multipliers = symbols_.multipliers();
    if (function != 0 && angle == multipliers.zero()) return;
    if (multipliers.is_negative(angle)) {
      angle = multipliers.negative(angle);
      negative = negative != (function != 0);
    }
    if (!multipliers.fits(angle)) out_of_range(symbols_, {word, angle});
    table_.add({word, angle | function}, negative ? -c : c);
  }

  Symbols symbols_;
  Orders orders_;
  Truncation keep_;
  TermTable<T> table_;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
