// SPDX-License-Identifier: MIT
// Any numbers of a state at the stages of a step by collocation, and what is done with them in
// lanes.
#pragma once

#include <array>
#include <vector>

#include "dynamics/collocation/gauss_scheme.hpp"
#include "polhode/math/instruction_set.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

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
  // F = A Y of columns of seven numbers: rates `from` to `to` of each. The first four numbers of
  // all columns come first, then the last three of all.
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
