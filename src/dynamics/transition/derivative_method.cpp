// SPDX-License-Identifier: MIT
#include "dynamics/transition/transition_steppers.hpp"
#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

struct InItsPlace {
  const std::string& function;
  const std::string& what;

  DerivativeMethod operator()(Adaptive method) const {
    if (method.tolerance < 1e-15)
      throw DomainError(function + ": tolerance " + number_text(method.tolerance) +
                        " must be from 1e-15: " + what + " are carried in double");
    method.precision = Precision::compensated;
    return method;
  }
  DerivativeMethod operator()(const Splitting& method) const { return method; }
  // The motion is the same to the tolerance; its variational equations need no constants.
  DerivativeMethod operator()(const VariationOfConstants& method) const {
    return Adaptive{.tolerance = method.tolerance, .largest_step = method.largest_step};
  }
  DerivativeMethod operator()(const Collocation& method) const { return method; }
  DerivativeMethod operator()(const CustomMethod& method) const {
    throw DomainError(function + ": method \"" + method.traits.kind + "\" carries no " + what +
                      ": take Adaptive, Collocation, Splitting or VariationOfConstants");
  }
};

}  // namespace

DerivativeMethod derivative_method(const std::string& function, const std::string& what,
                                   const Method& method) {
  return std::visit(InItsPlace{function, what}, method);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
