// SPDX-License-Identifier: MIT
// What a description of a kind must be, before a file is read with it.
#pragma once

#include "polhode/scenario/perturbation_kind.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// DomainError "Kinds: perturbation "push", key "radius": ..." unless its keys have plain names of
// their own and texts, its sets are of them, and what stands for them or shows them is TOML that
// they take.
void require_sound(const PerturbationKind& kind);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
