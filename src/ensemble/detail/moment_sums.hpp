// SPDX-License-Identifier: MIT
// Means, and sums of products about them, of `size` numbers: the lower triangle row by row.
#pragma once

#include <cstddef>

namespace polhode {
inline namespace v0 {
namespace detail {

// One more, the n-th, as Welford does.
inline void add_to_moments(const double* x, std::size_t size, double n, double* mean,
                           double* products) {
  const double part = 1.0 / n;
  for (std::size_t i = 0; i < size; ++i) {
    const double d = x[i] - mean[i];
    mean[i] += d * part;
    for (std::size_t j = 0; j <= i; ++j) *products++ += d * (x[j] - mean[j]);
  }
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

}  // namespace detail
}  // namespace v0
}  // namespace polhode
