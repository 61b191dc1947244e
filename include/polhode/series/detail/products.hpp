// SPDX-License-Identifier: MIT
// A sum of products of series: all pairs of terms whose order is kept, multiplied and added up.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "polhode/series/detail/key_box.hpp"
#include "polhode/series/detail/orders.hpp"
#include "polhode/series/detail/term_codes.hpp"
#include "polhode/series/detail/term_table.hpp"
#include "polhode/series/series.hpp"
#include "polhode/series/symbols.hpp"

namespace polhode {
inline namespace v0 {
namespace series {
namespace detail {

// factor * a * b.
template <class T>
struct Pairing {
  std::span<const Term<T>> a, b;
  T factor;
};

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
double pair_count(const Pairing<T>& of, const Orders& orders, int order) {
  if (!orders.is_weighted())
    return static_cast<double>(of.a.size()) * static_cast<double>(of.b.size());
  const auto left = by_order<T>(of.a, orders), right = by_order<T>(of.b, orders);
  double pairs = 0.0;
  std::size_t kept = right.size();
  for (const auto& [of_a, i] : left) {
    while (kept > 0 && of_a + right[kept - 1].first > order) --kept;
    pairs += static_cast<double>(kept);
  }
  return pairs;
}

// That a table has room for before the first: larger ones grow, since many products have far fewer
// terms than they could have.
inline constexpr double most_expected_terms = 1 << 17;

template <class T>
class Products {
 public:
  // The series must outlive this.
  Products(const Symbols& symbols, const Truncation& keep, std::vector<Pairing<T>> pairings)
      : symbols_(symbols), orders_(symbols, keep), keep_(keep), pairings_(std::move(pairings)) {
    std::erase_if(pairings_, [](const auto& one) { return one.a.empty() || one.b.empty(); });
    box_.variables.resize(symbols.variables().size());
    box_.angles.resize(symbols.angles().size());
    for (const Pairing<T>& one : pairings_) box_.add_product<T>(symbols, one.a, one.b);
  }

  ProductSize size() const {
    double pairs = 0.0;
    for (const Pairing<T>& one : pairings_) pairs += pair_count(one, orders_, keep_.order);
    const double terms = std::min(2.0 * pairs, box_.keys());
    // A table has four slots a term at most, and where it grew last, half as many beside it.
    const std::size_t slot =
        is_short() ? sizeof(CodedTerm<std::uint64_t, T>) : sizeof(CodedTerm<LongWord, T>);
    return {pairs, terms, terms * static_cast<double>(6 * slot + sizeof(Term<T>))};
  }

  // Sorted; throws where it may need too much memory, and for terms that leave the range of keys.
  std::vector<Term<T>> terms() const {
    const ProductSize most = size();
    require_room(most, keep_.most_bytes);
    return is_short() ? terms_by<std::uint64_t>(most) : terms_by<LongWord>(most);
  }

 private:
  template <class Word>
  struct Factor {
    Word exponents, multipliers;
    T c;
    bool is_sine;
  };

  // No code has all bits set.
  bool is_short() const { return box_.bits() < 64; }

  template <class Word>
  std::vector<Term<T>> terms_by(const ProductSize& most) const {
    const TermCodes<Word> codes(symbols_, box_);
    TermTable<Word, T> table(static_cast<std::size_t>(std::min(most.terms, most_expected_terms)),
                             box_.bits());
    for (const Pairing<T>& one : pairings_) add(codes, table, one);
    const auto sorted = std::move(table).sorted();
    std::vector<Term<T>> terms;
    terms.reserve(sorted.size());
    for (const auto& one : sorted) terms.push_back({codes.key(one.code), one.c});
    return terms;
  }

  template <class Word>
  static Factor<Word> factor_of(const TermCodes<Word>& codes, const Term<T>& term) {
    return {codes.exponents(term.key), codes.multipliers(term.key), term.c,
            term.key.function() == Trigonometric::sine};
  }

  template <class Word>
  void add(const TermCodes<Word>& codes, TermTable<Word, T>& table,
           const Pairing<T>& pairing) const {
    const auto right = by_order<T>(pairing.b, orders_);
    std::vector<Factor<Word>> b;
    b.reserve(right.size());
    for (const auto& [order, i] : right) b.push_back(factor_of(codes, pairing.b[i]));
    for (const Term<T>& term : pairing.a) {
      std::size_t count = b.size();
      if (orders_.is_weighted()) {
        const long long room = static_cast<long long>(keep_.order) - orders_.of(term.key);
        const auto end = std::partition_point(right.begin(), right.end(),
                                              [&](const auto& one) { return one.first <= room; });
        count = static_cast<std::size_t>(end - right.begin());
      }
      Factor<Word> a = factor_of(codes, term);
      a.c = pairing.factor * a.c;
      add_row(codes, table, a, std::span<const Factor<Word>>(b).first(count));
    }
  }

  template <class Word>
  static void add_row(const TermCodes<Word>& codes, TermTable<Word, T>& table,
                      const Factor<Word>& a, std::span<const Factor<Word>> b) {
    constexpr Word sine{1};
    const Word zero = codes.zero(), base = codes.base() + a.exponents;
    const T half = a.c / T(2);
    for (const Factor<Word>& one : b) {
      const Word monomial = base + one.exponents;
      const Word function = a.is_sine != one.is_sine ? sine : Word{0};
      const Word sum = monomial + (zero + a.multipliers + one.multipliers) + function;
      if (a.multipliers == 0 || one.multipliers == 0) {
        table.add(sum, a.c * one.c);
        continue;
      }
      const T c = half * one.c;
      // cos cos, sin cos and cos sin have + of A + B; sin sin has -.
      table.add(sum, a.is_sine && one.is_sine ? -c : c);
      Word difference = zero + a.multipliers - one.multipliers;
      // cos A sin B has - of sin(A - B).
      bool negative = one.is_sine && !a.is_sine;
      if (difference < zero) {
        difference = zero + one.multipliers - a.multipliers;
        negative = negative != (function != 0);
      } else if (difference == zero && function != 0) {
        continue;
      }
      table.add(monomial + difference + function, negative ? -c : c);
    }
  }

  Symbols symbols_;
  Orders orders_;
  Truncation keep_;
  std::vector<Pairing<T>> pairings_;
  KeyBox box_;
};

}  // namespace detail
}  // namespace series
}  // namespace v0
}  // namespace polhode
