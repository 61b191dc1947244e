// SPDX-License-Identifier: MIT
// What orders of a Fourier series must be, for so many points.
#pragma once

#include <string>

#include "polhode/error.hpp"
#include "polhode/fit/fourier_fit.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

inline void check_orders(const std::string& who, const ScanPoints& points, FourierOrders orders) {
  for (const std::size_t order : {orders.first, orders.second})
    if (order > 9 || (order == 0 && orders.second == 0))
      throw DomainError(who + ": order " + std::to_string(order) + ": it must be 1 to 9");
  const std::size_t unknowns = points.constants() + 2 * orders.harmonics();
  if (points.size() <= unknowns)
    throw DomainError(who + ": " + std::to_string(points.size()) + " points do not determine " +
                      std::to_string(unknowns) + " coefficients: take a lower order");
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
