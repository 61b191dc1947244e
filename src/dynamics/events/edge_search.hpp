// SPDX-License-Identifier: MIT
// The first edge in a step: where a switching function changes its sign, found as events are.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "polhode/version.hpp"  // asks for C++20

namespace polhode {
inline namespace v0 {
namespace detail {

// Switching functions times their sides along a step, x from 0 to 1: negative beyond an edge.
class SwitchCurve {
 public:
  virtual ~SwitchCurve() = default;
  virtual std::vector<double> along(double x) const = 0;  // of an interpolation
  virtual double truly(std::size_t which, double x) const = 0;
  virtual double rounding(std::size_t which) const = 0;
};

struct Edge {
  std::size_t which;
  double x;
  bool is_nan = false;  // no edge: the function is NaN there, and no edge was found before
};

struct EdgeSearch {
  std::optional<Edge> first;
  std::vector<double> at_end;  // the functions at x = 1
};

// At x = 0 a function may be zero, of either sign. A dip below zero is found where it is a parabola
// or a V, or longer than a quarter of the step.
EdgeSearch search_edges(const SwitchCurve& curve);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
