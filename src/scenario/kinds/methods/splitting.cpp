// SPDX-License-Identifier: MIT
// [method] kind = "splitting".
#include <array>
#include <variant>

#include "scenario/detail/method_kinds.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

using enum SplittingScheme;

constexpr std::array keys = {
    quantity_key<&Splitting::step>("step", Dimension::time, "The step; positive.")
        .required()
        .example("0.01"),
    choice_key<&Splitting::scheme, order2, order4, order6, order8, ABA864, ABA1064>(
        "scheme", "order2|order4|order6|order8|ABA864|ABA1064",
        "How free rotation and perturbation are composed.")
        .otherwise("\"ABA864\""),
};

Method made(const Splitting& method, const KeyValues& at) {
  return at.built("step", [&] {
    require_valid(method);
    return method;
  });
}

// What one of the schemes rests on; the second order has been known for ever.
std::vector<Citation> of_scheme(SplittingScheme scheme) {
  switch (scheme) {
    case order2:
      return {};
    case order4:
      return {{"blanesmoan2002",
               "Blanes, S., Moan, P. C. (2002). Practical symplectic partitioned Runge-Kutta and "
               "Runge-Kutta-Nystroem methods. Journal of Computational and Applied Mathematics "
               "142, 313-330.",
               "the splitting of order 4"}};
    case order6:
    case order8:
      return {{"kahanli1997",
               "Kahan, W., Li, R.-C. (1997). Composition constants for raising the orders of "
               "unconventional schemes for ordinary differential equations. Mathematics of "
               "Computation 66, 1089-1099.",
               "the splittings of order 6 and 8"}};
    case ABA864:
    case ABA1064:
      return {{"blanes2013",
               "Blanes, S., Casas, F., Farres, A., Laskar, J., Makazaga, J., Murua, A. (2013). New "
               "families of symplectic splitting methods for numerical integration in dynamical "
               "astronomy. Applied Numerical Mathematics 68, 58-72.",
               "the splitting for near-integrable systems"}};
  }
  return {};
}

std::vector<Citation> cited(const Method& method) {
  std::vector<Citation> all = {
      {"celledoni2008",
       "Celledoni, E., Fasso, F., Saefstroem, N., Zanna, A. (2008). The exact computation of the "
       "free rigid body motion and its use in splitting methods. SIAM Journal on Scientific "
       "Computing 30, 2084-2112.",
       "splitting with the exact free rotor"}};
  for (const Citation& own : of_scheme(std::get<Splitting>(method).scheme)) all.push_back(own);
  return all;
}

}  // namespace

MethodKind splitting_kind() {
  return method_kind<Splitting>(
      "splitting",
      "Exact free rotation and exact kicks of the torques in turn, with a step that you choose.",
      keys, made, cited);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
