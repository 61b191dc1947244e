// SPDX-License-Identifier: MIT
// spin_histories: the spin axes of many bodies on one orbit that changes over ages, an axis in each
// lane of the processor.
//
// Equations   those of SpinPrecession, each body with rates of its own.
// Units       any time; rates in rad per time.
// Domain      that of SpinPrecession by Splitting. Times run from the epoch away, in one direction.
// Accuracy    to the last bit that of SpinPrecession by the same method, one body at a time. It
//             does not depend on the other bodies, their number or the set of instructions.
// Errors      a body that fails, fails alone: its axes are NaN from there on, and how it ended is
//             in the list that is returned. DomainError for spans that do not fit together, for a
//             method that is out of range, and for a set that this processor lacks.
// Cost        3 ns a body for a turn, of which order 8 makes 18 a step, and 18 for a time between
//             two steps; 150 ns for the orbit, which up to 256 bodies share.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "polhode/dynamics/method.hpp"
#include "polhode/math/instruction_set.hpp"
#include "polhode/secular/orbit_history.hpp"
#include "polhode/secular/spin_precession.hpp"
#include "polhode/trajectory/progress.hpp"
#include "polhode/trajectory/save_at.hpp"
#include "polhode/trajectory/trajectory.hpp"

namespace polhode {
inline namespace v0 {

// A body that did not reach the last time.
struct LostSpin {
  std::size_t index;
  Outcome outcome;
};

// results[i times.size() + k] is the axis of body i at times[k], which was at starts[i] at the
// epoch. Rates and starts are as many as there are bodies, or one for all.
std::vector<LostSpin> spin_histories(const OrbitHistory& orbit,
                                     std::span<const PrecessionRates> rates,
                                     std::span<const SpinAxis> starts, double epoch,
                                     const SaveAt& times, const Splitting& method,
                                     std::span<SpinAxis> results, const Progress& progress = {},
                                     InstructionSet set = widest_instruction_set());

}  // namespace v0
}  // namespace polhode
