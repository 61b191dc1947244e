# SPDX-License-Identifier: MIT
# Toolchain of the presets clang and fuzz: the oldest clang from 16 on, the closest to the
# version of our tests. `tools/install-deps --clang` installs one.

foreach(version RANGE 16 40)
  list(APPEND polhode_clang_names clang++-${version})
endforeach()
find_program(POLHODE_CLANG NAMES ${polhode_clang_names} clang++ REQUIRED)
set(CMAKE_CXX_COMPILER "${POLHODE_CLANG}")
