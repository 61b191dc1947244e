// SPDX-License-Identifier: MIT
// Levenberg-Marquardt up to the first bound: the one door to Eigen's.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace polhode {
inline namespace v0 {
namespace fit {
namespace detail {

struct Descent {
  enum class End { small_step, on_bound, iteration_limit, no_value };
  End end = End::no_value;
  std::vector<double> y;
  int iterations = 0;
  int evaluations = 0;
};

// The numbers at y; where `jacobian` is not null their derivatives, row by row. False: no value.
using Numbers =
    std::function<bool(const std::vector<double>& y, double* numbers, double* jacobian)>;

// Whether y is within the bounds. Numbers beyond are those of the nearest point within; the first
// step that ends beyond is the last one.
using Within = std::function<bool(const std::vector<double>& y)>;

// From y, for as many numbers, at least as many as variables; `first_step` as LeastSquares.
Descent levenberg_marquardt(const Numbers& f, const Within& is_within, std::size_t numbers,
                            std::vector<double> y, int most_iterations, double first_step);

}  // namespace detail
}  // namespace fit
}  // namespace v0
}  // namespace polhode
