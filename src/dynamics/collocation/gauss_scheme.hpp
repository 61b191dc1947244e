// SPDX-License-Identifier: MIT
// Gauss-Legendre collocation: the scheme, and the numbers of a step at its stages with what is done
// with them in lanes.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "math/finite.hpp"
#include "polhode/detail/perturb/stages.hpp"
#include "polhode/math/double_double.hpp"
#include "polhode/math/instruction_set.hpp"
#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// A matrix by columns: what number j contributes to every row.
using StageMatrix = std::array<StageRow, most_stages>;

// Gauss-Legendre collocation of s stages (Butcher 1964): implicit, of order 2 s, symmetric, and
// symplectic in canonical variables; it keeps every quadratic invariant, |q|^2 among them.
//
//   Y_i = y + sum_j mu_ij L_j,  L_j = h b_j f(t + c_i h, Y_j),  y' = y + sum_j L_j
//
// With a_ij = mu_ij b_j, the method is symplectic where mu_ij + mu_ji = 1 (Sanz-Serna 1988). In
// doubles that holds to the last bit, and then rounding makes no invariant drift (Antonana,
// Makazaga and Murua 2017).
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

// How often a sweep moves the stages by the effects that it has asked for. Where torques are weak
// next to the free rotation these settle long before the attitude does.
inline constexpr int passes_of_sweep = 3;
// Where the first pass of a sweep changes no more than that, the others end at rounding.
inline constexpr double settled_change = std::numeric_limits<double>::epsilon();

// What of the body the equations of motion ask for.
struct RotorConstants {
  std::array<DoubleDouble, 3> half_inverse;  // 1 / (2 I)
  Vec3 euler;                                // 1/I3 - 1/I2, 1/I1 - 1/I3, 1/I2 - 1/I1
};

struct RotorStep {
  std::array<double, 7> y{}, carry{};  // q_SB, g_B at the start, and what they lost to rounding
  StageRow hb{};
  double inverse_momentum = 0.0;  // 1 / |g|, roughly: the measure of a change
  StageStates Y;
  StageEffects effects;  // a sweep takes them into `drive`, and leaves zeros
  int passes = passes_of_sweep;
  bool has_rate = false;            // any effect has a v
  bool has_frame = false;           // it moves
  std::array<StageRow, 3> mu_S{};   // its rate
  std::array<StageRow, 7> drive{};  // the effects that F was made of: u, then v; the last is 0
  std::array<StageRow, 7> F{};      // the rates of Y
  std::array<StageRow, 7> L{};      // h b F
};

// At the start of a step.
inline double inverse_momentum(const std::array<double, 7>& y) {
  double most = std::numeric_limits<double>::min();
  for (std::size_t n = 4; n < 7; ++n) most = larger(most, std::abs(y[n]));
  return 1.0 / most;
}

// Compiled for each set of instructions; every one with the same bits.
struct RotorLanes {
  // Y from F.
  void (*place)(const GaussScheme&, RotorStep&);
  // How large the momentum of Y is.
  void (*measure)(RotorStep&);
  // F from Y and the effects, and Y from F, `passes` times: first g, then q at the rates
  // that belong to it. The largest change of any stage in the first pass, relative to |q| = 1 and
  // to |g|.
  double (*sweep)(const GaussScheme&, const RotorConstants&, RotorStep&);
  // y and carry at the end of the step.
  void (*finish)(RotorStep&);
  // to = matrix * from, from of `stages` numbers and to of so many rows.
  void (*transform)(const StageMatrix& matrix, std::size_t rows,
                    const std::array<StageRow, 7>& from, std::array<StageRow, 7>& to);
};
RotorLanes rotor_lanes(std::size_t stages, InstructionSet set);

// Any numbers of a state at the stages of a step by collocation, and what is done with them in
// lanes.
struct NumberStep {
  explicit NumberStep(std::size_t count) : y(count), carry(count), Y(count), F(count), L(count) {}

  std::vector<double> y, carry;  // at the start of the step, and what they lost to rounding
  std::vector<StageRow> Y, F;    // at the stages, and their rates
  std::vector<StageRow> L;       // h b F
};

// The derivatives of seven rates by seven numbers, at every stage: [rate][number].
using StageJacobian = std::array<std::array<StageRow, 7>, 7>;

// Compiled for each set of instructions; every one with the same bits.
struct NumberLanes {
  // Y from F for numbers `first` to `last`, and by how much each of them changed at most.
  void (*move)(const GaussScheme&, const StageRow& hb, NumberStep&, std::size_t first,
               std::size_t last, double* changes);
  // F = A Y of columns of seven numbers: rates `from` to `to` of each. The first numbers of all
  // columns come first, then the second ones, and so on.
  void (*multiply)(const StageJacobian&, NumberStep&, std::size_t columns, std::size_t from,
                   std::size_t to);
  // y and carry at the end of the step.
  void (*finish)(const StageRow& hb, NumberStep&);
  // to = matrix * from, from of `stages` numbers and to of so many rows.
  void (*transform)(const StageMatrix& matrix, std::size_t rows, const StageRow* from,
                    std::size_t count, StageRow* to);
};
NumberLanes number_lanes(std::size_t stages, InstructionSet set);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
