// SPDX-License-Identifier: MIT
// The cells of a landscape that are minima.
#pragma once

#include <cstddef>
#include <vector>

#include "polhode/fit/fourier_scan.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

struct LandscapeCell {
  std::size_t row, column;
};

// The lowest first, at most `most`.
std::vector<LandscapeCell> minimum_cells(const Landscape& of, std::size_t most);

// Pairs that refinement brought together, in either order: nearer than a hundredth of a step.
bool are_one(const FourierFit& a, const FourierFit& b, double step);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
