// SPDX-License-Identifier: MIT
// Whether a number type carries double-double values: what integrators choose coefficients by.
//
// Domain      any type.
// Accuracy    exact.
// Cost        none at run time.
#pragma once

#include "polhode/math/double_double.hpp"
#include "polhode/math/dual.hpp"

namespace polhode {
inline namespace v0 {

template <class T>
inline constexpr bool is_double_double = false;
template <>
inline constexpr bool is_double_double<DoubleDouble> = true;
template <int N>
inline constexpr bool is_double_double<Dual<DoubleDouble, N>> = true;

}  // namespace v0
}  // namespace polhode
