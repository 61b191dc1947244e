# SPDX-License-Identifier: MIT
# Settings of those who work on polhode itself. A project that adds polhode as a subdirectory, or
# finds it installed, gets none of them.

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_CXX_EXTENSIONS OFF)

# Paths below the checkout are relative for the cache, so that the build folder of a wheel, and other
# clones, share objects. Not with -g, for which ccache also hashes the folder.
find_program(CCACHE ccache)
if(CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE})
  if(NOT DEFINED ENV{CCACHE_BASEDIR})
    set(CMAKE_CXX_COMPILER_LAUNCHER
      ${CMAKE_COMMAND} -E env CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} ${CCACHE})
  endif()
endif()

add_compile_options(-Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion -Wshadow
  -Wdouble-promotion)

# A warning is an error with the two compilers that we promise to compile cleanly with. With a newer
# one it stays a warning, so that nobody's build breaks over an opinion that did not exist yet.
set(promised OFF)
if((CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION MATCHES "^12\\.")
    OR (CMAKE_CXX_COMPILER_ID STREQUAL "Clang" AND CMAKE_CXX_COMPILER_VERSION MATCHES "^16\\."))
  set(promised ON)
endif()
option(POLHODE_WERROR "Warnings are errors" ${promised})
if(POLHODE_WERROR)
  add_compile_options(-Werror)
endif()

# Who may include whom is part of the build: a forbidden include fails it.
find_program(PYTHON3 python3)
if(PYTHON3)
  file(GLOB_RECURSE checked CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/include/*.hpp
    ${PROJECT_SOURCE_DIR}/src/*.[ch]pp ${PROJECT_SOURCE_DIR}/cli/*.[ch]pp)
  add_custom_command(OUTPUT ${PROJECT_BINARY_DIR}/layers.stamp
    COMMAND ${PYTHON3} ${PROJECT_SOURCE_DIR}/tools/layers.py
    COMMAND ${CMAKE_COMMAND} -E touch ${PROJECT_BINARY_DIR}/layers.stamp
    DEPENDS ${checked} ${PROJECT_SOURCE_DIR}/tools/layers.py
    COMMENT "Layers: who includes whom")
  add_custom_target(layers ALL DEPENDS ${PROJECT_BINARY_DIR}/layers.stamp)
endif()
