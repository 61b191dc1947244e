// SPDX-License-Identifier: MIT
// AffineTorque: a torque c - A g, as friction gives it at one time and attitude, and what it does
// to the momentum in a while.
//
// Equations   dg/dt = c - A g: g(h) - g = h phi(-h A) (c - A g), phi(X) = (exp(X) - 1) / X, at
//             fixed time and attitude. Of several such terms the sum is one again: with the kicks
//             of other terms in c, a splitting needs no composition within its kick.
// Units       c momentum per time; A one per time.
// Domain      any finite c, A and h of either sign.
// Accuracy    a few roundings of the change of g where |h A| <= 1/2; beyond, of g.
// Errors      none; NaN in, NaN out.
// Cost        some 30 flops per term of the series, two to three of them where |h A| is 1e-6;
//             beyond |h A| = 1/2 a matrix exponential by doubling.
#pragma once

#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {

struct AffineTorque {
  Vec3 constant;  // c
  Mat3 damping;   // A

  constexpr bool operator==(const AffineTorque&) const = default;
};

AffineTorque operator+(const AffineTorque& a, const AffineTorque& b);

// g(h) - g
Vec3 change_of_momentum(const AffineTorque& torque, const Vec3& g, double h);

}  // namespace v0
}  // namespace polhode
