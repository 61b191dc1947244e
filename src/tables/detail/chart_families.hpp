// SPDX-License-Identifier: MIT
// The charts of polhode, family by family.
#pragma once

#include <span>

#include "polhode/tables/convert.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

// Of all charts that are made of Andoyer's variables.
inline constexpr Citation andoyer1923{
    "andoyer1923",
    "Andoyer, H. (1923). Cours de mecanique celeste, vol. 1. Gauthier-Villars, Paris.",
    "Andoyer variables"};

std::span<const ChartKind> rotor_charts();
std::span<const ChartKind> euler_charts();
std::span<const ChartKind> andoyer_charts();
std::span<const ChartKind> poincare_charts();
std::span<const ChartKind> serret_charts();
std::span<const ChartKind> sadov_charts();

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
