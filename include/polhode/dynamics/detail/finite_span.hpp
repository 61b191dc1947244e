// SPDX-License-Identifier: MIT
// What refuses a problem whose times are not finite where it is made. It holds nothing.
#pragma once

#include "polhode/version.hpp"  // asks for C++20

namespace polhode {
inline namespace v0 {
namespace detail {

struct FiniteSpan {
  FiniteSpan(double start, double stop);  // DomainError unless both are finite
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
