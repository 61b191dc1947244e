// SPDX-License-Identifier: MIT
// Rows of packs: structures of doubles, one after the other in memory, as packs of their members,
// and back.
//
// Domain      structures of six or seven doubles; `from` and `to` need no alignment.
// Accuracy    exact.
// Cost        one or two shuffles a number and register.
#pragma once

#include <array>
#include <cstddef>
#include <cstring>

#include "polhode/detail/math/pack.hpp"
#include "polhode/math/detail/four_columns.hpp"

namespace polhode {
inline namespace v0 {

// Lane i of n columns, at to + n i.
template <std::size_t n, InstructionSet isa>
[[gnu::always_inline]] inline void store_rows(const std::array<Pack<isa>, n>& c, double* to) {
  static_assert(n == 6 || n == 7);
  using Four = detail::FourColumns<isa>;
  constexpr std::size_t width = Pack<isa>::width;
  const auto first = Four::rows(c[0], c[1], c[2], c[3]);
  const auto rest = Four::rows(c[4], c[5], c[n - 1], c[n - 1]);
#pragma GCC unroll 8
  for (std::size_t i = 0; i < width; ++i) {
    std::memcpy(to + n * i, &first[i], 32);
    // of seven, the number too many is where the next row begins
    const bool whole = n == 7 && i + 1 < width;
    std::memcpy(to + n * i + 4, &rest[i], whole ? 32 : 16);
    if (n == 7 && !whole) to[n * i + 6] = rest[i][2];
  }
}

// n columns, lane i of them from from + n i.
template <std::size_t n, InstructionSet isa>
[[gnu::always_inline]] inline std::array<Pack<isa>, n> loaded_rows(const double* from) {
  static_assert(n == 6 || n == 7);
  using Four = detail::FourColumns<isa>;
  typename Four::Rows first, rest;
#pragma GCC unroll 8
  for (std::size_t i = 0; i < Pack<isa>::width; ++i) {
    first[i] = detail::vector_at<detail::FourDoubles>(from + n * i);
    rest[i] = detail::vector_at<detail::FourDoubles>(from + n * i + (n - 4));
  }
  const auto a = Four::columns(first), b = Four::columns(rest);
  if constexpr (n == 7)
    return {a[0], a[1], a[2], a[3], b[1], b[2], b[3]};
  else
    return {a[0], a[1], a[2], a[3], b[2], b[3]};
}

}  // namespace v0
}  // namespace polhode
