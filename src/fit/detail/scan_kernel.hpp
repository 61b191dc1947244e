// SPDX-License-Identifier: MIT
// Chi-square of a block of frequency pairs on packs: what the sources of fit/lanes instantiate.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "fit/detail/cholesky_lanes.hpp"
#include "fit/detail/scan_task.hpp"
#include "math/pack_functions.hpp"
#include "polhode/detail/math/pack.hpp"

namespace polhode {
inline namespace v0 {
namespace fit {
namespace detail {

// Rows of 1, cos x, sin x, cos 2x, sin 2x ... over the points, and sums of their products.
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

// What the sums of a pair become, and room for it: one for a block.
template <InstructionSet isa>
struct ScanRoom {
  using T = Pack<isa>;
  // Tiles that fit the registers.
  static constexpr std::size_t tile_rows = 4, tile_columns = isa == InstructionSet::avx512 ? 4 : 2;

  const ScanBlock* block;
  std::size_t m1, m2, left_rows, right_rows, width, size, groups;
  std::vector<T> right;              // functions of f2, by points
  std::vector<T> sums, values, own;  // products: of weights, of weighted values, of one group
  std::vector<T> cosines, sines;     // of j f1 + k f2, j >= 0, k of either sign
  std::vector<T> matrix, inverse, factors;

  explicit ScanRoom(const ScanBlock& b)
      : block(&b),
        m1(b.first_order),
        m2(b.second_order),
        left_rows(4 * m1 + 1),
        right_rows(4 * m2 + 1),
        width(4 * m2 + 1),
        size((2 * m1 + 1) * (2 * m2 + 1) - 1),
        groups(b.points->groups()),
        right(right_rows * b.points->padded),
        sums(left_rows * right_rows),
        values((2 * m1 + 1) * (2 * m2 + 1)),
        own(values.size()),
        cosines((2 * m1 + 1) * width),
        sines(cosines.size()),
        matrix((size + 1) * (groups + size)),
        inverse(size),
        factors(values.size()) {}

  T* row(std::size_t i) { return matrix.data() + i * (groups + size); }

  // Calls at(index, j, k + 2 m2) for each harmonic, in the order of the unknowns.
  template <class Call>
  void each_unknown(const Call& at) const {
    std::size_t h = 0;
    for (std::size_t k = 1; k <= m2; ++k) at(h++, std::size_t{0}, 2 * m2 + k);
    for (std::size_t j = 1; j <= m1; ++j)
      for (std::size_t k = m2; k <= 3 * m2; ++k) at(h++, j, k);
  }

  void second_frequencies(const T& f) {
    const ScanTable& p = *block->points;
    for (std::size_t i = 0; i < p.count; ++i)
      each_harmonic(T(f * T(p.t[i])), 2 * m2,
                    [&](std::size_t q, const T& x) { right[q * p.padded + i] = x; });
  }

  // Sums of cos and sin of j f1 + k f2, from those of products; orders to n1 and n2.
  void combine(const std::vector<T>& products, std::size_t stride, std::size_t n1, std::size_t n2) {
    const auto at = [&](std::size_t q, std::size_t p) { return products[q * stride + p]; };
    const T none(0.0);
    for (std::size_t j = 0; j <= n1; ++j)
      for (std::size_t k = 0; k <= n2; ++k) {
        const std::size_t cj = j == 0 ? 0 : 2 * j - 1, ck = k == 0 ? 0 : 2 * k - 1;
        const T cc = at(cj, ck), cs = k == 0 ? none : at(cj, 2 * k);
        const T sc = j == 0 ? none : at(2 * j, ck);
        const T ss = j == 0 || k == 0 ? none : at(2 * j, 2 * k);
        T* c = cosines.data() + j * width + 2 * m2;
        T* s = sines.data() + j * width + 2 * m2;
        c[k] = cc - ss;
        s[k] = sc + cs;
        *(c - k) = cc + ss;
        *(s - k) = sc - cs;
      }
  }

  // Sums of one group: the columns of L of its constant.
  void constant(std::size_t g) {
    combine(own, 2 * m2 + 1, m1, m2);
    const T part(1.0 / std::sqrt(block->points->group_weight[g]));
    each_unknown([&](std::size_t h, std::size_t j, std::size_t k) {
      row(2 * h)[g] = cosines[j * width + k] * part;
      row(2 * h + 1)[g] = sines[j * width + k] * part;
    });
    row(size)[g] = T(0.0);  // values are from the mean of their group
  }

  void right_hand_side() {
    combine(values, 2 * m2 + 1, m1, m2);
    each_unknown([&](std::size_t h, std::size_t j, std::size_t k) {
      row(size)[groups + 2 * h] = cosines[j * width + k];
      row(size)[groups + 2 * h + 1] = sines[j * width + k];
    });
  }

  // cos a cos b = (cos(a - b) + cos(a + b)) / 2 and its like, for the harmonics a >= b.
  void normal_matrix() {
    combine(sums, right_rows, 2 * m1, 2 * m2);
    const T half(0.5);
    each_unknown([&](std::size_t a, std::size_t ja, std::size_t ka) {
      T* even = row(2 * a) + groups;
      T* odd = row(2 * a + 1) + groups;
      each_unknown([&](std::size_t b, std::size_t jb, std::size_t kb) {
        if (b > a) return;
        const std::size_t less = (ja - jb) * width + ka + 2 * m2 - kb;
        const std::size_t more = (ja + jb) * width + ka + kb - 2 * m2;
        even[2 * b] = half * (cosines[less] + cosines[more]);
        even[2 * b + 1] = half * (sines[more] - sines[less]);
        odd[2 * b] = half * (sines[more] + sines[less]);
        odd[2 * b + 1] = half * (cosines[less] - cosines[more]);
      });
    });
  }

  // What solves the normal equations, as factors of the products of functions: the constants of the
  // groups in the first column of L's last row.
  void amplitudes() {
    T* x = row(size);
    for (std::size_t k = size; k-- > 0;) {
      const T found = x[groups + k] * inverse[k];
      x[groups + k] = found;
      const T* l = row(k);
      for (std::size_t i = 0; i < groups + k; ++i) x[i] = x[i] - found * l[i];
    }
    const std::size_t few = 2 * m2 + 1;
    for (T& factor : factors) factor = T(0.0);
    each_unknown([&](std::size_t h, std::size_t j, std::size_t place) {
      const bool less = place < 2 * m2, flat = place == 2 * m2;
      const std::size_t k = less ? 2 * m2 - place : place - 2 * m2;
      const std::size_t ck = flat ? 0 : 2 * k - 1;
      const T a = x[groups + 2 * h], b = x[groups + 2 * h + 1];
      T* even = factors.data() + (j == 0 ? 0 : 2 * j - 1) * few;
      T* odd = factors.data() + 2 * j * few;
      even[ck] = even[ck] + a;
      if (j > 0) odd[ck] = odd[ck] + b;
      if (flat) return;
      even[2 * k] = less ? T(even[2 * k] - b) : T(even[2 * k] + b);
      if (j > 0) odd[2 * k] = less ? T(odd[2 * k] + a) : T(odd[2 * k] - a);
    });
  }

  // Weighted squares of what is left of the values of a group. An error of the amplitudes enters
  // with its square, which it would not in the total less what the normal equations take off.
  T squares(const double* left, std::size_t g) const {
    const ScanTable& p = *block->points;
    const std::size_t few = 2 * m2 + 1;
    const T constant = matrix[size * (groups + size) + g] * T(1.0 / std::sqrt(p.group_weight[g]));
    T sum(0.0);
    for (std::size_t i = p.starts[g]; i < p.starts[g + 1]; ++i) {
      T off = T(p.weighted[i]) - T(p.weight[i]) * constant;
      for (std::size_t q = 0; q <= 2 * m1; ++q) {
        const T* factor = factors.data() + q * few;
        T of_second = factor[0];
        for (std::size_t k = 1; k < few; ++k)
          of_second = of_second + factor[k] * right[k * p.padded + i];
        off = off - T(left[q * p.padded + i]) * of_second;
      }
      sum = sum + off * off * T(p.variance[i]);
    }
    return sum;
  }

  // Chi-square of the functions of f1 in `left` (times weights, then times weighted values) with
  // those of f2.
  void pair(const double* left, double* chi_square, std::uint8_t* suspect, std::size_t count) {
    const ScanTable& p = *block->points;
    const std::size_t few = 2 * m2 + 1;
    const double* weighted = left + left_rows * p.padded;
    for (std::size_t g = 0; g < groups; ++g) {
      sum_products<tile_rows, tile_columns>(
          ProductSums<T>{left, p.padded, right.data(), p.padded, own.data(), few, p.starts[g],
                         p.starts[g + 1]},
          2 * m1 + 1, few);
      constant(g);
    }
    sum_products<tile_rows, tile_columns>(
        ProductSums<T>{left, p.padded, right.data(), p.padded, sums.data(), right_rows, 0, p.count},
        left_rows, right_rows);
    sum_products<tile_rows, tile_columns>(
        ProductSums<T>{weighted, p.padded, right.data(), p.padded, values.data(), few, 0, p.count},
        2 * m1 + 1, few);
    normal_matrix();
    right_hand_side();
    const LanesOfMatrices<T> m{matrix.data(), groups + size, groups, size, size + 1};
    const auto doubtful = cholesky<tile_rows, tile_columns>(m, inverse.data(), T(block->floor));
    amplitudes();
    T rest(0.0);
    for (std::size_t g = 0; g < groups; ++g) rest = rest + squares(left, g);
    for (std::size_t lane = 0; lane < count; ++lane) {
      chi_square[lane] = rest.lanes[lane];
      suspect[lane] = doubtful.lanes[lane] != 0 ? 1 : 0;
    }
  }
};

// The functions of f1 of one row: times weights to order 2 m1, times weighted values to m1.
template <InstructionSet isa>
void first_functions(const ScanBlock& block, double f, double* to) {
  using T = Pack<isa>;
  const ScanTable& p = *block.points;
  const std::size_t weighted = 4 * block.first_order + 1, few = 2 * block.first_order + 1;
  for (std::size_t i = 0; i < p.padded; i += T::width) {
    const T w = T::loaded(p.weight.data() + i), wy = T::loaded(p.weighted.data() + i);
    each_harmonic(T(T(f) * T::loaded(p.t.data() + i)), 2 * block.first_order,
                  [&](std::size_t q, const T& x) {
                    T(w * x).store(to + q * p.padded + i);
                    if (q < few) T(wy * x).store(to + (weighted + q) * p.padded + i);
                  });
  }
}

template <InstructionSet isa>
void scan_in_lanes(const ScanBlock& block) {
  using T = Pack<isa>;
  const std::size_t functions = (6 * block.first_order + 2) * block.points->padded;
  std::vector<double> left(block.rows * functions);
  for (std::size_t r = 0; r < block.rows; ++r)
    first_functions<isa>(block, block.first[r], left.data() + r * functions);
  ScanRoom<isa> room(block);
  for (std::size_t c = 0; c < block.columns; c += T::width) {
    room.second_frequencies(T::loaded(block.second + c));
    const std::size_t count = block.columns - c < T::width ? block.columns - c : T::width;
    for (std::size_t r = 0; r < block.rows; ++r)
      room.pair(left.data() + r * functions, block.chi_square + r * block.columns + c,
                block.suspect + r * block.columns + c, count);
  }
}

}  // namespace detail
}  // namespace fit
}  // namespace v0
}  // namespace polhode
