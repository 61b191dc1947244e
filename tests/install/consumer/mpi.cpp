// SPDX-License-Identifier: MIT
#include <cstdio>

#include "polhode/mpi/mpi_ranks.hpp"

int main() { std::puts(polhode::ensemble::mpi_ranks(2) ? "several processes" : "one process"); }
