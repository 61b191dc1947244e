// SPDX-License-Identifier: MIT
// What Sadov's variables of many states need of the body; by mode: short axis, long axis.
#pragma once

#include <cstddef>

#include "polhode/free/sadov.hpp"
#include "polhode/free/serret.hpp"
#include "polhode/math/double_double.hpp"
#include "polhode/math/instruction_set.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

struct SadovConstants {
  std::size_t axis[3];  // sorted axes <- body axes
  double sign[3];
  DoubleDouble plus, minus;         // I1 I3 (G^2 - 2 T I2) = plus g3^2 - minus g1^2
  double d1[2], d3[2];              // D1 = d1[0] g2^2 + d1[1] g3^2, D3 = d3[0] g1^2 + d3[1] g2^2
  double k2_per_DC[2];              // k^2 DA / DC
  double kp2_per_D2[2];             // k'^2 DA / (I1 I3 |D2|)
  double A_over_C[2];               // (a1/a3)^2 DA / DC
  double kap2[2], root_of_kap2[2];  // kappa^2, sqrt(1 + kappa^2)
  double cosine[2], sine[2];        // of the amplitude, per momentum along primed axes 1 and 2
  double to_axes[2][4];             // body axes <- primed axes with positive signs
  double usual[2];                  // 1 where the mode is not next to one that degenerates
  // of the way back: the sign of the attitude of the axes where the momentum along the third is
  // negative; on the separatrix the deficit of the action, 1 - a3/G and a3/G; and a2/a1
  double half_turn[2], border[2], most[2], least[2], a2_over_a1[2];
  // of Serret's elements: sorted moments in a power of two, that unit, 1/2I along the body axes,
  // and the rate of u over a3 at momentum 1 in that unit
  double moment[3], moment_unit;
  DoubleDouble half_inverse[3];
  double rate_per_a3[2];
};

// Of at most 64 states; usual[i] says whether result i is right.
template <InstructionSet isa>
void sadov_in_lanes(const SadovConstants& constants, const RotorState* states, std::size_t count,
                    SadovState* results, bool* usual);

// A time each, or one for all.
struct TimesOfStates {
  const double* first;
  std::size_t step;

  double operator[](std::size_t i) const { return first[i * step]; }
  TimesOfStates from(std::size_t i) const { return {first + i * step, step}; }
};

// Serret's elements of states, each at its time.
template <InstructionSet isa>
void serret_in_lanes(const SadovConstants& constants, const RotorState* states,
                     const TimesOfStates& times, std::size_t count, SerretState* results,
                     bool* usual);

// The states of at most 64 sets.
template <InstructionSet isa>
void rotors_of_sadov_in_lanes(const SadovConstants& constants, const SadovState* sets,
                              std::size_t count, RotorState* results, bool* usual);

template <InstructionSet isa>
void rotors_of_serret_in_lanes(const SadovConstants& constants, const SerretState* sets,
                               const TimesOfStates& times, std::size_t count, RotorState* results,
                               bool* usual);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
