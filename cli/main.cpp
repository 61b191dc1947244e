// SPDX-License-Identifier: MIT
#include "polhode/cli/command_line.hpp"

#ifdef POLHODE_HAS_MPI
#include <cstdlib>

#include "polhode/mpi/mpi_ranks.hpp"

namespace {

// MPI_Init takes a tenth of a second, of which a program alone has no need: what starts several
// tells each (Open MPI; PMIx, by which Slurm does; MPICH and its kin).
std::unique_ptr<polhode::ensemble::Ranks> ranks(int threads) {
  for (const char* const name : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK"})
    if (std::getenv(name) != nullptr) return polhode::ensemble::mpi_ranks(threads);
  return nullptr;
}

}  // namespace

int main(int argc, char** argv) {
  return polhode::command_line(argc, argv, polhode::io::default_kinds(), ranks);
}
#else
int main(int argc, char** argv) { return polhode::command_line(argc, argv); }
#endif
