# SPDX-License-Identifier: MIT
# What polhode::io links. Read by our own build and, installed, by find_package(polhode COMPONENTS
# io), because a static library hands its private libraries on to whoever links it.

include(CMakeFindDependencyMacro)
find_dependency(PkgConfig)
find_dependency(fmt)
find_dependency(ZLIB)
# Debian calls it hdf5-serial, beside those with MPI.
pkg_search_module(POLHODE_HDF5 REQUIRED IMPORTED_TARGET GLOBAL hdf5-serial hdf5)
pkg_search_module(POLHODE_UDUNITS REQUIRED IMPORTED_TARGET GLOBAL udunits udunits2)
