// SPDX-License-Identifier: MIT
// The keys of methods that choose their steps.
#pragma once

#include "polhode/scenario/method_kind.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

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

// As it is, if it is in range.
template <class A>
Method valid_tolerance(const A& method, const KeyValues& at) {
  return at.built("tolerance", [&] {
    require_valid(method);
    return method;
  });
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
