// SPDX-License-Identifier: MIT
#include "polhode/mpi/mpi_ranks.hpp"

#include <cstdio>

int main() { std::puts(polhode::mpi_ranks(2) ? "several processes" : "one process"); }
