// SPDX-License-Identifier: MIT
// One form of a series: terms brought to it, and two such rows of terms added.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "polhode/series/symbols.hpp"

namespace polhode {
inline namespace v0 {
namespace series {
namespace detail {

void require_same(const Symbols& a, const Symbols& b);

// Turns the angle round where it starts with a negative multiplier; false for sin 0.
template <class T>
bool turned(const PackedFields& multipliers, Term<T>& term) {
  const std::uint64_t angle = term.key.angle();
  const bool is_sine = term.key.function() == Trigonometric::sine;
  if (multipliers.is_negative(angle)) {
    term.key.multipliers = multipliers.negative(angle) | (is_sine ? TermKey::function_bit : 0);
    if (is_sine) term.c = -term.c;
  }
  return !is_sine || angle != multipliers.zero();
}

// Sorted terms with their equal neighbours added up and zeros gone.
template <class T>
void add_neighbours(std::vector<Term<T>>& terms) {
  std::size_t n = 0;
  for (std::size_t i = 0; i < terms.size();) {
    Term<T> sum = std::move(terms[i++]);
    while (i < terms.size() && terms[i].key == sum.key) sum.c = sum.c + terms[i++].c;
    if (!(sum.c == T(0))) terms[n++] = std::move(sum);
  }
  terms.erase(terms.begin() + static_cast<std::ptrdiff_t>(n), terms.end());
}

template <class T>
std::vector<Term<T>> canonical(const Symbols& symbols, std::vector<Term<T>> terms) {
  std::erase_if(terms, [&](Term<T>& term) { return !turned<T>(symbols.multipliers(), term); });
  for (const Term<T>& term : terms)
    if (!fits(symbols, term.key)) out_of_range(symbols, term.key);
  const auto before = [](const Term<T>& a, const Term<T>& b) { return a.key < b.key; };
  // Equal keys stay in the order given, so that sums of doubles do not depend on the sort.
  if (!std::is_sorted(terms.begin(), terms.end(), before))
    std::stable_sort(terms.begin(), terms.end(), before);
  add_neighbours(terms);
  return terms;
}

template <class T>
std::vector<Term<T>> merged(const Symbols& of_a, const Symbols& of_b, std::span<const Term<T>> a,
                            std::span<const Term<T>> b, bool subtract) {
  require_same(of_a, of_b);
  std::vector<Term<T>> sum;
  sum.reserve(a.size() + b.size());
  auto left = a.begin();
  auto right = b.begin();
  while (left != a.end() || right != b.end()) {
    if (right == b.end() || (left != a.end() && left->key < right->key)) {
      sum.push_back(*left++);
    } else if (left == a.end() || right->key < left->key) {
      sum.push_back({right->key, subtract ? -right->c : right->c});
      ++right;
    } else {
      T c = subtract ? left->c - right->c : left->c + right->c;
      if (!(c == T(0))) sum.push_back({left->key, std::move(c)});
      ++left;
      ++right;
    }
  }
  // Lie transforms keep sums of series with the same keys: half of the room.
  if (4 * sum.size() < 3 * sum.capacity()) sum.shrink_to_fit();
  return sum;
}

}  // namespace detail
}  // namespace series
}  // namespace v0
}  // namespace polhode
