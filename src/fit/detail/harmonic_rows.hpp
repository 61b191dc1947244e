// SPDX-License-Identifier: MIT
// Rows of 1, cos x, sin x, cos 2x, sin 2x ... over the points, and sums of their products.
#pragma once

#include <cstddef>

#include "polhode/math/pack.hpp"
#include "polhode/math/pack_functions.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

constexpr double two_pi_of_scan = 6.283185307179586;

// Calls row(q, value) with value q of these for q = 0 to 2 order, at x = 2 pi f t.
template <class T, class Row>
[[gnu::always_inline]] inline void each_harmonic(const T& turns, std::size_t order,
                                                 const Row& row) {
  const SinCos<T> one = sincos(T(T(two_pi_of_scan) * (turns - rint(turns))));
  T c(1.0), s(0.0);
  row(std::size_t{0}, c);
  for (std::size_t j = 1; j <= order; ++j) {
    const T next = c * one.cos - s * one.sin;
    s = s * one.cos + c * one.sin;
    c = next;
    row(2 * j - 1, c);
    row(2 * j, s);
  }
}

// Where a tile of sums is taken from and goes to: left rows are numbers, `stride` apart, right ones
// packs.
template <class T>
struct ProductSums {
  const double* left;
  std::size_t left_stride;
  const T* right;
  std::size_t right_stride;
  T* to;
  std::size_t to_stride;
  std::size_t begin, end;  // points
};

template <std::size_t rows, std::size_t columns, class T>
[[gnu::always_inline]] inline void sum_tile(const ProductSums<T>& of, std::size_t r,
                                            std::size_t c) {
  T sum[rows][columns];
#pragma GCC unroll 4
  for (std::size_t a = 0; a < rows; ++a)
#pragma GCC unroll 4
    for (std::size_t b = 0; b < columns; ++b) sum[a][b] = T(0.0);
  const double* left = of.left + r * of.left_stride;
  const T* right = of.right + c * of.right_stride;
  for (std::size_t i = of.begin; i < of.end; ++i) {
    T y[columns];
#pragma GCC unroll 4
    for (std::size_t b = 0; b < columns; ++b) y[b] = right[b * of.right_stride + i];
#pragma GCC unroll 4
    for (std::size_t a = 0; a < rows; ++a) {
      const T x(left[a * of.left_stride + i]);
#pragma GCC unroll 4
      for (std::size_t b = 0; b < columns; ++b) sum[a][b] = sum[a][b] + x * y[b];
    }
  }
#pragma GCC unroll 4
  for (std::size_t a = 0; a < rows; ++a)
#pragma GCC unroll 4
    for (std::size_t b = 0; b < columns; ++b) of.to[(r + a) * of.to_stride + c + b] = sum[a][b];
}

// All sums of products of so many left and right rows. Every sum is one after the other, over the
// points in order, whatever tile it is in.
template <std::size_t rows, std::size_t columns, class T>
void sum_products(const ProductSums<T>& of, std::size_t left, std::size_t right) {
  std::size_t r = 0;
  for (; r + rows <= left; r += rows) {
    std::size_t c = 0;
    for (; c + columns <= right; c += columns) sum_tile<rows, columns>(of, r, c);
    for (; c < right; ++c) sum_tile<rows, 1>(of, r, c);
  }
  for (; r < left; ++r) {
    std::size_t c = 0;
    for (; c + columns <= right; c += columns) sum_tile<1, columns>(of, r, c);
    for (; c < right; ++c) sum_tile<1, 1>(of, r, c);
  }
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
