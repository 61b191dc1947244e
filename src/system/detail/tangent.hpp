// SPDX-License-Identifier: MIT
// Tangent vectors (theta_B, g_B) of the hub and matrices that act on them.
#pragma once

#include <array>

#include "polhode/math/matrix6.hpp"
#include "polhode/system/canonical_rates.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

inline std::array<double, 6> product(const Matrix6& m, const std::array<double, 6>& x) {
  std::array<double, 6> y{};
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j)
      y[static_cast<std::size_t>(i)] += m(i, j) * x[static_cast<std::size_t>(j)];
  return y;
}

inline std::array<double, 6> product(const Matrix6& m, const HubRates& x) {
  return product(m, std::array<double, 6>{x.theta.x, x.theta.y, x.theta.z, x.g.x, x.g.y, x.g.z});
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
