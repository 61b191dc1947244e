# SPDX-License-Identifier: MIT
# Most of the time that a compiler spends on a small source goes into headers: the standard library's,
# GoogleTest's, CLI11's, nanobind's. With POLHODE_JOINED up to eight sources of a folder are compiled
# as one.

option(POLHODE_JOINED "Compile sources in groups: much less work for a \
whole build, more after a change of one file" OFF)

# For sources that compute nothing themselves, commands and most bindings: -O1 compiles them in 0.75 of
# the time. With it GCC 12 takes the destructor of an optional variant for the use of an empty one.
set(polhode_thin "")
if(CMAKE_CXX_COMPILER_ID MATCHES "^(GNU|Clang|AppleClang)$")
  set(polhode_thin $<$<CONFIG:Release>:-O1>
    $<$<AND:$<CONFIG:Release>,$<CXX_COMPILER_ID:GNU>>:-Wno-maybe-uninitialized>)
endif()

# The sources of a target in groups, by CMake's unity builds. Those whose paths match `alone` ("^$" if
# none do), and those with compile options of their own, are compiled by themselves.
function(polhode_grouped target alone)
  if(NOT POLHODE_JOINED)
    return()
  endif()
  set(grouped ${ARGN})
  list(FILTER grouped EXCLUDE REGEX "TARGET_OBJECTS|${alone}")
  foreach(source IN LISTS grouped)
    cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
    cmake_path(GET source PARENT_PATH folder)
    cmake_path(RELATIVE_PATH folder BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
    string(MAKE_C_IDENTIFIER "${folder}" group)
    math(EXPR count_${group} "0${count_${group}} + 1")
    math(EXPR part "(${count_${group}} - 1) / 8")
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group}_${part})
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  # a name of one source may be a local name of another; the presets without groups have both warnings
  target_compile_options(${target} PRIVATE -Wno-shadow
    $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endfunction()

# The sources of a test in groups, each source in a namespace of its own, so that their names cannot
# clash. A group lies where every build tree of the checkout has it, so that a compiler cache knows it.
function(polhode_joined result name)
  set(${result} ${ARGN} PARENT_SCOPE)
  list(LENGTH ARGN count)
  if(NOT POLHODE_JOINED OR count LESS 2)
    return()
  endif()
  find_program(PYTHON3 python3 REQUIRED)
  math(EXPR groups "(${count} + 7) / 8")
  math(EXPR size "(${count} + ${groups} - 1) / ${groups}")
  set(written "")
  foreach(first RANGE 0 ${count} ${size})
    if(first EQUAL count)
      break()
    endif()
    list(SUBLIST ARGN ${first} ${size} group)
    set(file ${PROJECT_SOURCE_DIR}/build/joined/${name}_${first}.cpp)
    add_custom_command(OUTPUT ${file}
      COMMAND ${PYTHON3} ${PROJECT_SOURCE_DIR}/tools/joined.py ${file} ${group}
      DEPENDS ${group} ${PROJECT_SOURCE_DIR}/tools/joined.py
      COMMENT "Joining ${name}_${first}.cpp" VERBATIM)
    list(APPEND written ${file})
  endforeach()
  set(${result} ${written} PARENT_SCOPE)
endfunction()
