// SPDX-License-Identifier: MIT
// How many terms and bytes a Lie transform will take, before it starts.
//
// Equations   keys of order n, exponents and multipliers, are those of H_n, and those of order
//             n - a with a key of H_a, a momentum less, over a rate. Bytes: n + 3 series of each
//             order n, and the table of a product, which begins with 2^18 places.
// Units       bytes.
// Domain      as in lie_transform.hpp.
// Accuracy    terms: an upper bound, 1 to 2.5 times what is there, and 5 where few terms of H have
//             to do with each other (tests/unit/secular/transform_size.cpp). It is counted for a
//             tenth of a second; higher orders are extrapolated by a power of the order, that of
//             the dimensions of the keys. Digits of rationals on the heap come on top.
// Errors      DomainError for what a Lie transform refuses of H_0, its orders and clocks.
// Cost        20 to 50 ns a pair of keys, 2e6 pairs at most; from a fifth of a small transform down
//             to a hundredth of a large one (benchmarks/perturbation_theory.cpp).
#pragma once

#include <vector>

#include "polhode/secular/detail/lie_problem.hpp"
#include "polhode/secular/elimination.hpp"

namespace polhode {
inline namespace v0 {

// By order.
struct TransformSize {
  std::vector<double> terms;  // of a series of this order, at most
  std::vector<double> bytes;  // of memory, if this order is the last
  int counted;                // the last order that was counted; what follows is extrapolated
};

template <Coefficient T>
TransformSize transform_size(const Elimination<T>& problem) {
  const detail::KeyCount count = detail::lie_keys(problem, detail::checked_parts(problem)).count();
  return {count.terms, detail::bytes_of<T>(count), count.counted};
}

}  // namespace v0
}  // namespace polhode
