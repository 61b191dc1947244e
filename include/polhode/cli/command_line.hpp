// SPDX-License-Identifier: MIT
// command_line: the program `polhode`, with what a program of your own adds to it:
//
//     int main(int argc, char** argv) {
//       return polhode::command_line(argc, argv, polhode::default_kinds().with(my_torque()));
//     }
//
// Domain      the arguments of `polhode`; `polhode --help` lists them. Messages and help name the
//             program as argv[0] does, without its folder.
// Errors      none are thrown: a message on standard error, and exit status 2 for bad input, 1 for
//             a run that failed, 128 + signal for one that was stopped.
// Cost        that of the command.
#pragma once

#include <functional>
#include <memory>

#include "polhode/ensemble/executor.hpp"
#include "polhode/scenario/kinds.hpp"

namespace polhode {
inline namespace v0 {

// The processes that a command may use besides its own, each with this many threads; none: there
// are none. polhode::mpi_ranks is one.
using MakeRanks = std::function<std::unique_ptr<ensemble::Ranks>(int threads)>;

int command_line(int argc, const char* const* argv, const io::Kinds& kinds = io::default_kinds(),
                 const MakeRanks& ranks = {});

}  // namespace v0
}  // namespace polhode
