// SPDX-License-Identifier: MIT
// std::max with a NaN that stays: what judges a step or a term must not lose one.
#pragma once

namespace polhode {
inline namespace v0 {
namespace detail {

// Without a branch that depends on which is larger.
constexpr double larger(double a, double b) {
  const double most = a < b ? b : a;
  return b == b ? most : b;
}
template <class... More>
constexpr double larger(double a, double b, More... more) {
  return larger(larger(a, b), more...);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
