// SPDX-License-Identifier: MIT
// [method] kind = "variation-of-constants".
#include <array>

#include "scenario/detail/method_kinds.hpp"
#include "scenario/kinds/methods/tolerance_keys.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

constexpr std::array keys = {
    tolerance_key<VariationOfConstants>,
    largest_step_key<VariationOfConstants>,
};

std::vector<Citation> cited(const Method&) {
  return {{"butcher1964",
           "Butcher, J. C. (1964). Implicit Runge-Kutta processes. Mathematics of Computation 18, "
           "50-64.",
           "collocation at Gauss' nodes"}};
}

}  // namespace

MethodKind variation_of_constants_kind() {
  return method_kind<VariationOfConstants>(
      "variation-of-constants",
      "The constants of the free rotation are the unknowns: long steps for weak torques.", keys,
      valid_tolerance, cited);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
