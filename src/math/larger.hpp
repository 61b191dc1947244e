// SPDX-License-Identifier: MIT
// std::max with a NaN that stays: what judges a step or a term must not lose one.
#pragma once

namespace polhode {
inline namespace v0 {
namespace detail {

constexpr double larger(double a, double b) { return a < b || b != b ? b : a; }
template <class... More>
constexpr double larger(double a, double b, More... more) {
  return larger(larger(a, b), more...);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
