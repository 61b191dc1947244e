# SPDX-License-Identifier: MIT
# Most of the time that a compiler spends on a test, a command or a binding goes into the headers of
# GoogleTest, CLI11 or nanobind. With POLHODE_JOINED up to eight of them are compiled as one source.
# The library has CMake's unity builds instead (polhode_grouped in src/CMakeLists.txt): its sources
# need no namespaces of their own.

option(POLHODE_JOINED "Compile sources in groups: much less work for a \
whole build, more after a change of one file" OFF)

# The sources of a target, as they are or in groups. TOGETHER: as if in one file. APART: each in a
# namespace of its own, so that their names cannot clash. A group lies where every build tree of the
# checkout has it, so that a compiler cache knows it.
function(polhode_joined result name how)
  set(${result} ${ARGN} PARENT_SCOPE)
  list(LENGTH ARGN count)
  if(NOT POLHODE_JOINED OR count LESS 2)
    return()
  endif()
  find_program(PYTHON3 python3 REQUIRED)
  set(apart "")
  if(how STREQUAL "APART")
    set(apart --apart)
  endif()
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
      COMMAND ${PYTHON3} ${PROJECT_SOURCE_DIR}/tools/joined.py ${apart} ${file} ${group}
      DEPENDS ${group} ${PROJECT_SOURCE_DIR}/tools/joined.py
      COMMENT "Joining ${name}_${first}.cpp" VERBATIM)
    list(APPEND written ${file})
  endforeach()
  set(${result} ${written} PARENT_SCOPE)
endfunction()
