// SPDX-License-Identifier: MIT
// The numbers of one step of a rotor by collocation, and what is done with them in lanes.
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "dynamics/collocation/gauss_scheme.hpp"
#include "math/larger.hpp"
#include "polhode/math/instruction_set.hpp"
#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

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

}  // namespace detail
}  // namespace v0
}  // namespace polhode
