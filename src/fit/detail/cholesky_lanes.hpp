// SPDX-License-Identifier: MIT
// L of A = L L^T for as many matrices as there are lanes, in tiles that stay in registers.
#pragma once

#include <cstddef>

#include "polhode/detail/math/pack.hpp"

namespace polhode {
inline namespace v0 {
namespace fit {
namespace detail {

// Row i of the matrices from entry i stride on. Of the columns, those before `known` are of L
// already, for all rows; then come `size` of A. There may be more rows than columns: those below
// are eliminated too, so that a right-hand side as the last of `rows` becomes L^-1 of it.
template <class T>
struct LanesOfMatrices {
  T* entries;
  std::size_t stride, known, size, rows;
};

// Rows r.. and columns c.. of A, less what the columns before take off.
template <std::size_t rows, std::size_t columns, class T>
[[gnu::always_inline]] inline void reduce_tile(const LanesOfMatrices<T>& m, std::size_t r,
                                               std::size_t c, T (&tile)[rows][columns]) {
  const T* left = m.entries + r * m.stride;
  const T* right = m.entries + c * m.stride;
  const std::size_t before = m.known + c;
#pragma GCC unroll 4
  for (std::size_t a = 0; a < rows; ++a)
#pragma GCC unroll 4
    for (std::size_t b = 0; b < columns; ++b) tile[a][b] = left[a * m.stride + before + b];
  for (std::size_t k = 0; k < before; ++k) {
    T y[columns];
#pragma GCC unroll 4
    for (std::size_t b = 0; b < columns; ++b) y[b] = right[b * m.stride + k];
#pragma GCC unroll 4
    for (std::size_t a = 0; a < rows; ++a) {
      const T x = left[a * m.stride + k];
#pragma GCC unroll 4
      for (std::size_t b = 0; b < columns; ++b) tile[a][b] = tile[a][b] - x * y[b];
    }
  }
}

template <std::size_t rows, std::size_t columns, class T>
[[gnu::always_inline]] inline void solve_tile(const LanesOfMatrices<T>& m, const T* inverse,
                                              std::size_t r, std::size_t c) {
  T tile[rows][columns];
  reduce_tile(m, r, c, tile);
#pragma GCC unroll 4
  for (std::size_t a = 0; a < rows; ++a) {
    T* row = m.entries + (r + a) * m.stride + m.known + c;
#pragma GCC unroll 4
    for (std::size_t b = 0; b < columns; ++b) {
      T x = tile[a][b];
#pragma GCC unroll 4
      for (std::size_t k = 0; k < b; ++k)
        x = x - row[k] * m.entries[(c + b) * m.stride + m.known + c + k];
      row[b] = x * inverse[c + b];
    }
  }
}

// A pivot below `floor` times its entry of A is taken as that entry, and its lane is doubtful.
template <std::size_t columns, class T>
[[gnu::always_inline]] inline typename T::Mask pivot_tile(const LanesOfMatrices<T>& m, T* inverse,
                                                          std::size_t c, const T& floor) {
  T tile[columns][columns];
  typename T::Mask doubtful(false);
  reduce_tile(m, c, c, tile);
#pragma GCC unroll 4
  for (std::size_t a = 0; a < columns; ++a) {
    T* row = m.entries + (c + a) * m.stride + m.known + c;
    const T whole = row[a];
#pragma GCC unroll 4
    for (std::size_t b = 0; b < a; ++b) {
      T x = tile[a][b];
#pragma GCC unroll 4
      for (std::size_t k = 0; k < b; ++k)
        x = x - row[k] * m.entries[(c + b) * m.stride + m.known + c + k];
      row[b] = x * inverse[c + b];
    }
    T pivot = tile[a][a];
#pragma GCC unroll 4
    for (std::size_t k = 0; k < a; ++k) pivot = pivot - row[k] * row[k];
    const typename T::Mask low = !(pivot > floor * whole);
    doubtful = doubtful || low;
    const T root = sqrt(select(low, T(1.0), pivot));
    row[a] = root;
    inverse[c + a] = T(1.0) / root;
  }
  return doubtful;
}

// L in place of A. Every entry has the operations of the plain loop, in its order, whatever the
// tiles are. `inverse` has room for `size`.
template <std::size_t rows, std::size_t columns, class T>
typename T::Mask cholesky(const LanesOfMatrices<T>& m, T* inverse, const T& floor) {
  typename T::Mask doubtful(false);
  std::size_t c = 0;
  for (; c + columns <= m.size; c += columns) {
    doubtful = doubtful || pivot_tile<columns>(m, inverse, c, floor);
    std::size_t r = c + columns;
    for (; r + rows <= m.rows; r += rows) solve_tile<rows, columns>(m, inverse, r, c);
    for (; r < m.rows; ++r) solve_tile<1, columns>(m, inverse, r, c);
  }
  for (; c < m.size; ++c) {
    doubtful = doubtful || pivot_tile<1>(m, inverse, c, floor);
    for (std::size_t r = c + 1; r < m.rows; ++r) solve_tile<1, 1>(m, inverse, r, c);
  }
  return doubtful;
}

}  // namespace detail
}  // namespace fit
}  // namespace v0
}  // namespace polhode
