// SPDX-License-Identifier: MIT
// [method] kind = "adaptive".
#include <array>

#include "scenario/detail/method_kinds.hpp"
#include "scenario/kinds/methods/tolerance_keys.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

constexpr std::array keys = {
    tolerance_key<Adaptive>,
    choice_key<&Adaptive::precision, Precision::compensated, Precision::double_double>(
        "precision", "compensated|double-double",
        "Arithmetic: double with compensated sums, or double-double, some twenty times slower.")
        .otherwise("\"compensated\""),
    largest_step_key<Adaptive>,
};

std::vector<Citation> cited(const Method&) {
  return {{"verner2010",
           "Verner, J. H. (2010). Numerically optimal Runge-Kutta pairs with interpolants. "
           "Numerical Algorithms 53, 383-396.",
           "the integration"}};
}

}  // namespace

MethodKind adaptive_kind() {
  return method_kind<Adaptive>(
      "adaptive", "Runge-Kutta of order 9 with steps as long as the tolerance lets them be.", keys,
      valid_tolerance, cited);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
