// SPDX-License-Identifier: MIT
// Numbers that may not be finite: the larger of several, which keeps a NaN, and finite vectors.
#pragma once

#include <cmath>

#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// std::max that keeps a NaN, since a step or a term must not lose one; without a branch that
// depends on which is larger.
constexpr double larger(double a, double b) {
  const double most = a < b ? b : a;
  return b == b ? most : b;
}
template <class... More>
constexpr double larger(double a, double b, More... more) {
  return larger(larger(a, b), more...);
}

template <Real T>
bool is_finite(const BasicVec3<T>& v) {
  using std::isfinite;
  return isfinite(v.x) && isfinite(v.y) && isfinite(v.z);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
