# SPDX-License-Identifier: MIT
# What polhode::ensemble links. Read by our own build and, installed, by find_package(polhode
# COMPONENTS ensemble).

include(CMakeFindDependencyMacro)
find_dependency(TBB)
