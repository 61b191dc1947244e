// SPDX-License-Identifier: MIT
// Levenberg-Marquardt without bounds: the one door to Eigen's.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace polhode {
inline namespace v0 {
namespace detail {

struct Descent {
  enum class End { small_step, iteration_limit, no_value };
  End end = End::no_value;
  std::vector<double> y;
  int iterations = 0;
  int evaluations = 0;
};

// The numbers at y; where `jacobian` is not null their derivatives, row by row. False: no value.
using Numbers =
    std::function<bool(const std::vector<double>& y, double* numbers, double* jacobian)>;

// From y, for as many numbers, at least as many as variables.
Descent levenberg_marquardt(const Numbers& f, std::size_t numbers, std::vector<double> y,
                            int most_iterations);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
