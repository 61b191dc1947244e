// SPDX-License-Identifier: MIT
// The kinds of [method] that polhode has: one source of kinds/methods/ each. A new one is a source
// there, a line here and one in kinds.cpp.
#pragma once

#include "polhode/scenario/method_kind.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

MethodKind adaptive_kind();
MethodKind collocation_kind();
MethodKind splitting_kind();
MethodKind variation_of_constants_kind();

}  // namespace detail
}  // namespace v0
}  // namespace polhode
