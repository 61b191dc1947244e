// SPDX-License-Identifier: MIT
// Free rotation and charts of many states at a time, on the threads of one machine.
//
// Equations   those of the functions of the same names without `threads`: free/propagate.hpp,
//             free/states_at.hpp, free/states_on_grid.hpp, rotor/many_states.hpp, free/sadov.hpp,
//             free/serret.hpp.
// Units       those of these.
// Domain      that of these. `threads` is how many parts are computed at a time, 1 a plain call.
// Accuracy    the bits of these, whatever the threads.
// Errors      those of these, with the same indices in the same order: of several states that fail
//             the first is named. DomainError for fewer than one thread.
// Cost        that of these over the number of processors, and tens of microseconds; fewer states
//             than a thread is worth are computed by one.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "polhode/detail/free/states_at.hpp"
#include "polhode/detail/free/states_on_grid.hpp"
#include "polhode/free/propagate.hpp"
#include "polhode/free/sadov.hpp"
#include "polhode/free/serret.hpp"
#include "polhode/rotor/many_states.hpp"

namespace polhode {
inline namespace v0 {
namespace ensemble {

std::vector<FailedBody> propagate(std::span<const Body> bodies, std::span<const RotorState> states,
                                  std::span<const double> times, double t0,
                                  std::span<RotorState> results, int threads,
                                  InstructionSet set = widest_instruction_set());
std::vector<FailedBody> propagate(const BodyRows& rows, std::span<RotorState> results, int threads,
                                  InstructionSet set = widest_instruction_set());

void states_at(const FreeKernel& kernel, std::span<const double> times,
               std::span<RotorState> states, int threads,
               InstructionSet set = widest_instruction_set());
void states_on_grid(const FreeKernel& kernel, const TimeGrid& grid, std::uint64_t first,
                    std::span<RotorState> states, int threads,
                    InstructionSet set = widest_instruction_set());

void to_andoyer(std::span<const RotorState> states, std::span<AndoyerState> results, int threads,
                InstructionSet set = widest_instruction_set());
void to_euler(std::span<const RotorState> states, std::span<EulerState> results, int threads,
              InstructionSet set = widest_instruction_set());
void to_rotor(std::span<const AndoyerState> states, std::span<RotorState> results, int threads,
              InstructionSet set = widest_instruction_set());
void to_rotor(std::span<const EulerState> states, std::span<RotorState> results, int threads,
              InstructionSet set = widest_instruction_set());
void to_poincare(std::span<const RotorState> states, Pole pole_J, Pole pole_I,
                 std::span<PoincareState> results, int threads,
                 InstructionSet set = widest_instruction_set());
void nearest_poincare(std::span<const RotorState> states, std::span<PoincareState> results,
                      int threads, InstructionSet set = widest_instruction_set());
void to_rotor(std::span<const PoincareState> states, std::span<RotorState> results, int threads,
              InstructionSet set = widest_instruction_set());
void to_sadov(const Body& body, std::span<const RotorState> states, std::span<SadovState> results,
              int threads, InstructionSet set = widest_instruction_set());
void to_rotor(const Body& body, std::span<const SadovState> states, std::span<RotorState> results,
              int threads, InstructionSet set = widest_instruction_set());
void to_serret(const Body& body, std::span<const RotorState> states, std::span<const double> times,
               std::span<SerretState> results, int threads,
               InstructionSet set = widest_instruction_set());
void to_rotor(const Body& body, std::span<const SerretState> states, std::span<const double> times,
              std::span<RotorState> results, int threads,
              InstructionSet set = widest_instruction_set());

}  // namespace ensemble
}  // namespace v0
}  // namespace polhode
