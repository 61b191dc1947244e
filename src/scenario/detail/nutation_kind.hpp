// SPDX-License-Identifier: MIT
// kind = "nutation": the theory of nutation of a planet, evaluated at times.
#pragma once

#include "polhode/scenario/experiment_kind.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

ExperimentKind nutation_kind();

}  // namespace detail
}  // namespace v0
}  // namespace polhode
