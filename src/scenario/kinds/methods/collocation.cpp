// SPDX-License-Identifier: MIT
// [method] kind = "collocation".
#include <array>
#include <cmath>

#include "polhode/error.hpp"
#include "scenario/detail/method_kinds.hpp"
#include "scenario/kinds/methods/tolerance_keys.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

// As in a file, where every number is a double.
struct CollocationKeys {
  double tolerance = Collocation{}.tolerance;
  double stages = Collocation{}.stages;
  double step = 0.0;
  double largest_step = std::numeric_limits<double>::infinity();
};

constexpr std::array keys = {
    tolerance_key<CollocationKeys>,
    quantity_key<&CollocationKeys::stages>("stages", Dimension::number,
                                           "4, 8 or 16; the order is twice as large.")
        .otherwise("8"),
    quantity_key<&CollocationKeys::step>(
        "step", Dimension::time,
        "Every step is so long: energies of torques that have one do not drift. Left out: chosen "
        "by the tolerance.")
        .example("0.1")
        .positive(),
    largest_step_key<CollocationKeys>,
};

Method made(const CollocationKeys& k, const KeyValues& at) {
  const int stages = at.built("stages", [&] {
    for (const int known : {4, 8, 16})
      if (k.stages == known) return known;
    throw DomainError("Collocation: stages must be 4, 8 or 16");
  });
  return valid_tolerance(Collocation{k.tolerance, stages, k.step, k.largest_step}, at);
}

std::vector<Citation> cited(const Method&) {
  return {{"butcher1964",
           "Butcher, J. C. (1964). Implicit Runge-Kutta processes. Mathematics of Computation 18, "
           "50-64.",
           "collocation at Gauss' nodes"},
          {"antonana2017",
           "Antonana, M., Makazaga, J., Murua, A. (2017). Reducing and monitoring round-off error "
           "propagation for symplectic implicit Runge-Kutta schemes. Numerical Algorithms 76, "
           "861-880.",
           "coefficients that keep quadratic invariants in doubles"}};
}

}  // namespace

MethodKind collocation_kind() {
  return method_kind<CollocationKeys>(
      "collocation",
      "Gauss collocation of order 16, its stages computed together: accurate and fast.", keys, made,
      cited);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
