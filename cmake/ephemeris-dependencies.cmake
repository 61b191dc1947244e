# SPDX-License-Identifier: MIT
# What polhode::ephemeris links. Read by our own build and, installed, by find_package(polhode
# COMPONENTS ephemeris), because a static library hands its private libraries on to whoever links it.

include(CMakeFindDependencyMacro)
find_dependency(PkgConfig)
pkg_check_modules(POLHODE_ERFA REQUIRED IMPORTED_TARGET GLOBAL erfa)
