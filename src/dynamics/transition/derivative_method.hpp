// SPDX-License-Identifier: MIT
// What carries derivatives of a motion, in double: the method of a problem, or one that makes the
// same motion to the same tolerance.
#pragma once

#include <string>
#include <variant>

#include "polhode/dynamics/method.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

using DerivativeMethod = std::variant<Adaptive, Splitting, Collocation>;

// `what` is carried. DomainError of `function` for a tolerance that double does not reach, and for
// a method from outside, which knows states alone.
DerivativeMethod derivative_method(const std::string& function, const std::string& what,
                                   const Method& method);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
