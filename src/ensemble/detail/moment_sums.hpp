// SPDX-License-Identifier: MIT
// Means, and sums of products about them, of `size` numbers: the lower triangle row by row.
#pragma once

#include <cmath>
#include <cstddef>

namespace polhode {
inline namespace v0 {
namespace ensemble {
namespace detail {

// One more, the n-th, as Welford does. part = 1 / n.
inline void add_to_moments(const double* x, std::size_t size, double part, double* mean,
                           double* products) {
  for (std::size_t i = 0; i < size; ++i) {
    const double d = x[i] - mean[i];
    mean[i] += d * part;
    for (std::size_t j = 0; j <= i; ++j) *products++ += d * (x[j] - mean[j]);
  }
}
// The same, of a size that the compiler knows: a third of the time, the same bits.
template <std::size_t size>
void add_to_moments_of(const double* x, double part, double* mean, double* products) {
  double before[size], after[size];
#pragma GCC unroll 6
  for (std::size_t i = 0; i < size; ++i) {
    before[i] = x[i] - mean[i];
    const double moved = mean[i] + before[i] * part;
    after[i] = x[i] - moved;
    mean[i] = moved;
  }
#pragma GCC unroll 6
  for (std::size_t i = 0; i < size; ++i)
#pragma GCC unroll 6
    for (std::size_t j = 0; j <= i; ++j) *products++ += before[i] * after[j];
}
inline void add_to_any_moments(const double* x, std::size_t size, double part, double* mean,
                               double* products) {
  if (size == 1) return add_to_moments_of<1>(x, part, mean, products);
  if (size == 2) return add_to_moments_of<2>(x, part, mean, products);
  if (size == 3) return add_to_moments_of<3>(x, part, mean, products);
  if (size == 6) return add_to_moments_of<6>(x, part, mean, products);
  add_to_moments(x, size, part, mean, products);
}

// Those of nb more, as Chan, Golub and LeVeque do. na + nb > 0.
inline void merge_moments(const double* mean_b, const double* products_b, double nb,
                          std::size_t size, double na, double* mean, double* products) {
  const double part = nb / (na + nb), weight = na * part;
  double* s = products;
  for (std::size_t i = 0; i < size; ++i)
    for (std::size_t j = 0; j <= i; ++j)
      *s++ += *products_b++ + (mean_b[i] - mean[i]) * (mean_b[j] - mean[j]) * weight;
  for (std::size_t i = 0; i < size; ++i) mean[i] += (mean_b[i] - mean[i]) * part;
}

// Of n directions in a plane with a resultant of length r: they agree, or the chance exp(-n r^2)
// of as long a resultant at random (Rayleigh) is small.
inline bool tells_a_mean(double r, double n) { return r >= 0.9 || n * r * r > 6.907755278982137; }

}  // namespace detail
}  // namespace ensemble
}  // namespace v0
}  // namespace polhode
