// SPDX-License-Identifier: MIT
// Checks that two machines compute the same bits. Kernels of polhode do; sines and logarithms
// are those of the C library, which has several of each and takes one that the processor can run.
#pragma once

#include <string>

#include "run/detail/checkpointed_outputs.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

// A mark of the values of sines and logarithms at some arguments.
IdentityPart elementary_functions();
// Makes theirs those of ours, for a comparison in which they do not matter; if they differ, also
// the numbers of orbits and torques, which are made with them.
void take_elementary_functions(Identity& theirs, const Identity& ours);
// True for a difference() in this part.
bool differs_in_elementary_functions(const std::string& difference);

// A checkpoint of a machine that computes other last digits is rejected, unless the options allow
// any machine.
CheckpointSetup with_machine(CheckpointSetup setup, const RunOptions& options);

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
