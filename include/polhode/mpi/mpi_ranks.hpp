// SPDX-License-Identifier: MIT
// mpi_ranks: the processes that mpirun has started, as an executor; rank 0 leads and also computes.
//
// Domain      once in a program, and from its main thread, which is the only one that calls MPI.
//             Any number of ranks on any number of machines with the same kind of processor and
//             the same build of polhode; each rank reads files for itself.
// Accuracy    bytes pass unchanged.
// Errors      ExecutorError with the rank and its message for what a rank throws. A rank that dies
//             ends the job, as mpirun does; an error of MPI also ends it, with its message.
// Cost        MPI_Init, a tenth of a second. Then a message to and from a rank for each cell, and a
//             look for messages at least every millisecond. A rank has one cell in store, so that
//             it does not wait for the next.
#pragma once

#include <memory>

#include "polhode/ensemble/executor.hpp"

namespace polhode {
inline namespace v0 {
namespace ensemble {

// None in a process that was not started together with others. `threads` cells at a time in each.
std::unique_ptr<Ranks> mpi_ranks(int threads = 1);

}  // namespace ensemble
}  // namespace v0
}  // namespace polhode
