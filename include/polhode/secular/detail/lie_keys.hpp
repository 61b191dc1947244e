// SPDX-License-Identifier: MIT
// Which keys the parts of a Lie transform can have, found without their coefficients: how many
// terms it will have at most, before it starts.
//
// A bracket adds two keys, and takes a momentum away; one of the two was divided by a rate. So the
// keys of order n are those of H_n, and those of order n - a, each with a step: a key of H_a, a
// momentum less, over a rate. Which terms cancel, and which stay in the mean, is not asked.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "polhode/series/product.hpp"
#include "polhode/series/series.hpp"

namespace polhode {
inline namespace v0 {
namespace secular {
namespace detail {

// A cosine, a sine, or both of an angle: a coefficient of cosines alone that never cancels.
class KeyFunctions {
 public:
  constexpr KeyFunctions() = default;
  explicit constexpr KeyFunctions(int n) : bits_(n == 0 ? 0 : 1) {}
  static constexpr KeyFunctions of(series::Trigonometric function) {
    KeyFunctions one(1);
    if (function == series::Trigonometric::sine) one.bits_ = 2;
    return one;
  }

  constexpr bool cosine() const { return (bits_ & 1U) != 0; }
  constexpr bool sine() const { return (bits_ & 2U) != 0; }
  // How many.
  explicit constexpr operator double() const {
    return (cosine() ? 1.0 : 0.0) + (sine() ? 1.0 : 0.0);
  }

  friend constexpr KeyFunctions operator+(KeyFunctions a, KeyFunctions b) {
    a.bits_ = static_cast<unsigned char>(a.bits_ | b.bits_);
    return a;
  }
  friend constexpr KeyFunctions operator-(KeyFunctions a, KeyFunctions b) { return a + b; }
  friend constexpr KeyFunctions operator-(KeyFunctions a) { return a; }
  friend constexpr KeyFunctions operator*(KeyFunctions a, KeyFunctions b) {
    const bool even = (a.cosine() && b.cosine()) || (a.sine() && b.sine());
    const bool odd = (a.cosine() && b.sine()) || (a.sine() && b.cosine());
    a.bits_ = static_cast<unsigned char>((even ? 1U : 0U) | (odd ? 2U : 0U));
    return a;
  }
  friend constexpr KeyFunctions operator/(KeyFunctions a, KeyFunctions b) { return a * b; }
  friend constexpr bool operator==(KeyFunctions, KeyFunctions) = default;

 private:
  unsigned char bits_ = 0;
};

using Keys = series::Series<KeyFunctions>;

template <class T>
Keys keys_of(const series::Series<T>& a) {
  std::vector<series::Term<KeyFunctions>> terms;
  terms.reserve(a.size());
  for (const series::Term<T>& term : a.terms())
    terms.push_back(
        {{term.key.exponents, term.key.angle()}, KeyFunctions::of(term.key.function())});
  return Keys(a.symbols(), std::move(terms));
}
template <class T>
std::vector<Keys> keys_of(const std::vector<series::Series<T>>& parts) {
  std::vector<Keys> keys;
  for (const series::Series<T>& part : parts) keys.push_back(keys_of(part));
  return keys;
}

struct KeyCount {
  std::vector<double> terms;  // by order
  int counted;                // to this order; then they grow as a power of the order
};

// Of a transform that ends at each order; of bytes a term, and a place in the table of a product.
std::vector<double> bytes_by_order(const std::vector<double>& terms, std::size_t term,
                                   std::size_t slot);
// Throws where the last order takes more; what: "a map", or nothing.
void require_room(const std::string& what, const KeyCount& count, const std::vector<double>& bytes,
                  std::size_t most_bytes);

class LieKeys {
 public:
  // Parts of a Hamiltonian by order, all terms of rates, and how many variables the coefficients
  // depend on.
  LieKeys(std::vector<Keys> hamiltonian, const Keys& rates, int variables_of_coefficients);

  // Pairs of keys that are added before the rest is extrapolated: a tenth of a second.
  static constexpr double most_pairs = 2e6;

  // Of the Hamiltonian and all that comes of it.
  KeyCount count(double pairs = most_pairs) const;
  // Of a function, by order, and all that comes of it; or of a symbol, whose displacement has order
  // 1 at least.
  KeyCount count_of(std::vector<Keys> parts) const;
  KeyCount count_of(std::string_view symbol) const;

 private:
  using Flags = std::vector<bool>;
  // Which pairs have a coordinate that the parts depend on.
  Flags coordinates(const std::vector<Keys>& parts) const;
  // What a bracket takes away.
  Keys falls(const Flags& has_coordinate) const;
  KeyCount walk(std::vector<Keys> parts, const Flags& has_coordinate,
                double pairs = most_pairs) const;

  std::vector<Keys> h_;  // without its part of order 0
  double integrable_;    // terms of that
  Keys over_rates_;
  int variables_of_coefficients_;
};

}  // namespace detail
}  // namespace secular
}  // namespace v0
}  // namespace polhode
