// SPDX-License-Identifier: MIT
// Gauss-Legendre collocation of s stages (Butcher 1964): implicit, of order 2 s, symmetric, and
// symplectic in canonical variables; it keeps every quadratic invariant, |q|^2 among them.
//
//   Y_i = y + sum_j mu_ij L_j,  L_j = h b_j f(t + c_i h, Y_j),  y' = y + sum_j L_j
//
// With a_ij = mu_ij b_j, the method is symplectic where mu_ij + mu_ji = 1 (Sanz-Serna 1988). In
// doubles that holds to the last bit, and then rounding makes no invariant drift (Antonana,
// Makazaga and Murua 2017).
#pragma once

#include <array>

#include "polhode/math/double_double.hpp"
#include "polhode/perturb/stages.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// A matrix by columns: what number j contributes to every row.
using StageMatrix = std::array<StageRow, most_stages>;

struct GaussScheme {
  std::size_t stages;
  StageRow c;               // nodes in [0, 1]
  StageRow b;               // weights
  StageMatrix mu;           // mu[j][i]
  StageMatrix coefficient;  // [j][m]: of P_m(2 x - 1), of a function by its values at the nodes
};

// s = 4, 8, 16 or 32.
const GaussScheme& gauss_scheme(std::size_t stages);

// How much its quadrature of x^(3/2) over a step of 1 errs, of the bend of that power: its
// distance from a straight line, 1 - 2 (1/2)^(3/2).
double power_error(const GaussScheme& scheme);

// The weights of a step of h, and how long it is to the last bit: their sum. They are symmetric, as
// b is.
struct StepWeights {
  StageRow hb{};
  DoubleDouble length;
};
StepWeights step_weights(const GaussScheme& scheme, double h);

// [m][i]: P_m at 1 + 2 ratio c_i: the polynomial of a step in the stages of the next one, `ratio`
// times as long.
StageMatrix continuation(const GaussScheme& scheme, double ratio);
// [m][i]: P_m at the nodes of `fine`, inside the same step.
StageMatrix refinement(const GaussScheme& scheme, const GaussScheme& fine);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
