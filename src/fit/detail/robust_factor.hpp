// SPDX-License-Identifier: MIT
// The factor of a session under a robust loss.
//
// Equations   f of the least sum scale^2 rho((u - f v)^2 / scale^2) (polhode/fit/loss.hpp), u and v
//             flux and brightness over the error of the flux. The start is the weighted median of
//             u / v, which minimises sum |u - f v|; from there Newton's method, kept within what
//             signs of the slope enclose; where the sum bends downwards, twice a step of reweighted
//             least squares, whose sum falls (Hunter & Lange 2004).
// Domain      huber and soft_l1 are convex: the least is one, but for a flat bottom, of which one
//             point is taken. Under cauchy there may be several minima: the one
//             is taken that descent from the median meets, in steps that change no residual of
//             usual size by more than the scale. It is a function of the points alone, with jumps
//             where two minima change places.
// Accuracy    budget robust_factor in tests/budgets/fit.hpp.
// Errors      NaN where no v has a weight, or a number is none.
// Cost        a sort of the points, and some ten passes through them.
#pragma once

#include <span>

#include "polhode/fit/loss.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// The residual is u - f v; v is not below 0.
struct FactorPoint {
  double u, v;
};

double robust_factor(const Loss& loss, std::span<const FactorPoint> points);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
