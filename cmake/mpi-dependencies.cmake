# SPDX-License-Identifier: MIT
# What polhode::mpi links. Read by our own build and, installed, by find_package(polhode COMPONENTS
# mpi).

include(CMakeFindDependencyMacro)
find_dependency(TBB)
find_dependency(MPI COMPONENTS CXX)
