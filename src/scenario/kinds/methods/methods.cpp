// SPDX-License-Identifier: MIT
// The kinds of [method].
#include <array>
#include <limits>
#include <variant>

#include "polhode/error.hpp"
#include "polhode/scenario/method_kind.hpp"
#include "scenario/detail/built_in_kinds.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

namespace {

// Keys of methods that choose their steps.
template <class A>
constexpr KindKey<A> tolerance_key =
    quantity_key<&A::tolerance, A>(
        "tolerance", Dimension::number,
        "Error of one step, relative; from 1e-15 (double-double: 1e-30) to 0.01.")
        .otherwise("1e-12");

template <class A>
constexpr KindKey<A> largest_step_key =
    quantity_key<&A::largest_step, A>(
        "largest_step", Dimension::time,
        "No step is longer: for a torque that comes and goes within a step. Left out: "
        "adaptive and collocation take a quarter of a turn of the fastest orbit, field or frame, "
        "where there is one.")
        .example("1")
        .positive();

// The method itself, if its tolerance is in range.
template <class A>
Method valid_tolerance(const A& method, const KeyValues& at) {
  return at.built("tolerance", [&] {
    require_valid(method);
    return method;
  });
}

constexpr std::array adaptive_keys = {
    tolerance_key<Adaptive>,
    choice_key<&Adaptive::precision, Precision::compensated, Precision::double_double>(
        "precision", "compensated|double-double",
        "Arithmetic: double with compensated sums, or double-double, some twenty times slower.")
        .otherwise("\"compensated\""),
    largest_step_key<Adaptive>,
};

std::vector<Citation> adaptive_citations(const Method&) {
  return {{"verner2010",
           "Verner, J. H. (2010). Numerically optimal Runge-Kutta pairs with interpolants. "
           "Numerical Algorithms 53, 383-396.",
           "the integration"}};
}

}  // namespace

MethodKind adaptive_kind() {
  return method_kind<Adaptive>(
      "adaptive", "Runge-Kutta of order 9 with steps as long as the tolerance lets them be.",
      adaptive_keys, valid_tolerance, adaptive_citations);
}

namespace {

// As in a file, where every number is a double.
struct CollocationKeys {
  double tolerance = Collocation{}.tolerance;
  double stages = Collocation{}.stages;
  double step = 0.0;
  double largest_step = std::numeric_limits<double>::infinity();
};

constexpr std::array collocation_keys = {
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

Method made_collocation(const CollocationKeys& k, const KeyValues& at) {
  const int stages = at.built("stages", [&] {
    for (const int known : {4, 8, 16})
      if (k.stages == known) return known;
    throw DomainError("Collocation: stages must be 4, 8 or 16");
  });
  return valid_tolerance(Collocation{k.tolerance, stages, k.step, k.largest_step}, at);
}

std::vector<Citation> collocation_citations(const Method&) {
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
      "Gauss collocation of order 16, its stages computed together: accurate and fast.",
      collocation_keys, made_collocation, collocation_citations);
}

namespace {

using enum SplittingScheme;

constexpr std::array splitting_keys = {
    quantity_key<&Splitting::step>("step", Dimension::time, "The step; positive.")
        .required()
        .example("0.01"),
    choice_key<&Splitting::scheme, order2, order4, order6, order8, ABA864, ABA1064>(
        "scheme", "order2|order4|order6|order8|ABA864|ABA1064",
        "How free rotation and perturbation are composed.")
        .otherwise("\"ABA864\""),
};

Method made_splitting(const Splitting& method, const KeyValues& at) {
  return at.built("step", [&] {
    require_valid(method);
    return method;
  });
}

// The source of a scheme; none for order 2, which is common knowledge.
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

std::vector<Citation> splitting_citations(const Method& method) {
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
      splitting_keys, made_splitting, splitting_citations);
}

namespace {

constexpr std::array variation_keys = {
    tolerance_key<VariationOfConstants>,
    largest_step_key<VariationOfConstants>,
};

std::vector<Citation> variation_citations(const Method&) {
  return {{"butcher1964",
           "Butcher, J. C. (1964). Implicit Runge-Kutta processes. Mathematics of Computation 18, "
           "50-64.",
           "collocation at Gauss' nodes"}};
}

}  // namespace

MethodKind variation_of_constants_kind() {
  return method_kind<VariationOfConstants>(
      "variation-of-constants",
      "The constants of the free rotation are the unknowns: long steps for weak torques.",
      variation_keys, valid_tolerance, variation_citations);
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
