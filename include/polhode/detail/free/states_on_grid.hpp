// SPDX-License-Identifier: MIT
// states_on_grid: the states of one free arc at evenly spaced times, in the lanes of the processor.
//
// Equations   those of evaluate(kernel, t), polhode/detail/free/free_kernel.hpp. The angles of
//             every 64th
//             state are reduced as there; between them sines follow by addition of angles
//             (docs/design/0033-grids-and-charts-in-lanes.md).
// Units       those of the kernel.
// Domain      any kernel; state i of the grid is at the time start + i step without rounding, which
//             need not be a double. i below 2^53. NaN where start, step or a time is not finite.
// Accuracy    budget free_state in tests/budgets.hpp, as evaluate(kernel, t). The bits of a state
//             depend on the kernel, the grid and i alone: not on the first state asked for, on how
//             many, or on the set of instructions. They are not those of evaluate(kernel, t), from
//             which they differ by rounding.
// Errors      DomainError for a set that this processor lacks, and for an index beyond 2^53.
// Cost        docs/accuracy/benchmarks.md; no allocation. From 2 MiB on, results go past the caches
//             into memory.
#pragma once

#include <cstdint>
#include <span>

#include "polhode/detail/free/free_kernel.hpp"
#include "polhode/math/instruction_set.hpp"

namespace polhode {
inline namespace v0 {

// Times start, start + step, start + 2 step, ...
struct TimeGrid {
  double start = 0.0;
  double step = 0.0;
};

// states[i] is state first + i of the grid.
void states_on_grid(const FreeKernel& kernel, const TimeGrid& grid, std::uint64_t first,
                    std::span<RotorState> states, InstructionSet set = widest_instruction_set());

}  // namespace v0
}  // namespace polhode
