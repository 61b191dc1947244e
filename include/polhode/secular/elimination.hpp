// SPDX-License-Identifier: MIT
// What a Lie transform is asked for.
//
// Equations   as in lie_transform.hpp.
// Units       those of the Hamiltonian's symbols.
// Domain      as in lie_transform.hpp.
// Errors      none here; lie_transform.hpp and transform_size.hpp throw.
#pragma once

#include <string>
#include <vector>

#include "polhode/series/linear_flow.hpp"
#include "polhode/series/series.hpp"

namespace polhode {
inline namespace v0 {
namespace secular {

template <series::Coefficient T>
struct Elimination {
  series::Series<T> hamiltonian;
  series::Truncation keep;          // the small parameters, and the highest order
  std::vector<std::string> angles;  // to be eliminated
  std::vector<series::Multiples> resonances =
      {};  // combinations of them that stay, and their multiples
  std::vector<series::AngleRate<T>> clocks = {};
  double least_divisor = 0.0;  // the smallest coefficient of a rate to divide by
  double slowest = 0.0;        // what turns at a rate with a smaller coefficient stays
};

}  // namespace secular
}  // namespace v0
}  // namespace polhode
