# SPDX-License-Identifier: MIT
# What polhode is built with. All of it is looked for before anything is built, so that one message
# names all that is missing. docs/start/install.md shows the packages of this file; tests/install
# compares the two.

include(CheckLanguage)

set(polhode_missing "")
set(polhode_missing_packages "")

# Without a compiler or pkg-config the finders cannot tell, but a header can.
function(polhode_need found what package header)
  if(found)
    return()
  endif()
  if(NOT CMAKE_CXX_COMPILER OR NOT PKG_CONFIG_FOUND)
    find_path(POLHODE_HEADER_OF_${package} NAMES ${header} PATH_SUFFIXES eigen3 hdf5/serial)
    mark_as_advanced(POLHODE_HEADER_OF_${package})
    if(POLHODE_HEADER_OF_${package})
      return()
    endif()
  endif()
  list(APPEND polhode_missing "  ${what}: ${package}")
  list(APPEND polhode_missing_packages ${package})
  set(polhode_missing ${polhode_missing} PARENT_SCOPE)
  set(polhode_missing_packages ${polhode_missing_packages} PARENT_SCOPE)
endfunction()

get_property(languages GLOBAL PROPERTY ENABLED_LANGUAGES)
if(NOT "CXX" IN_LIST languages)
  check_language(CXX)
  if(CMAKE_CXX_COMPILER)
    enable_language(CXX)
  else()
    list(APPEND polhode_missing "  a C++20 compiler: g++")
    list(APPEND polhode_missing_packages g++)
  endif()
endif()

if(CMAKE_CXX_COMPILER)
  find_package(Eigen3 3.4 QUIET)
  find_package(Boost 1.74 QUIET)
endif()
polhode_need("${Eigen3_FOUND}" "Eigen 3.4" libeigen3-dev Eigen/Core)
polhode_need("${Boost_FOUND}" "Boost 1.74, headers" libboost-dev boost/version.hpp)

if(POLHODE_IO OR POLHODE_EPHEMERIS OR POLHODE_PYTHON)
  find_package(PkgConfig QUIET)
  if(PKG_CONFIG_FOUND)
    pkg_check_modules(POLHODE_HAS_ERFA QUIET erfa)
  else()
    list(APPEND polhode_missing "  pkg-config: pkg-config")
    list(APPEND polhode_missing_packages pkg-config)
  endif()
  polhode_need("${POLHODE_HAS_ERFA_FOUND}" "ERFA" liberfa-dev erfa.h)
endif()

if(POLHODE_IO OR POLHODE_ENSEMBLE OR POLHODE_PYTHON)
  if(CMAKE_CXX_COMPILER)
    find_package(TBB QUIET)
    find_path(RANDOM123_INCLUDE_DIR Random123/philox.h)
  endif()
  polhode_need("${TBB_FOUND}" "oneTBB" libtbb-dev tbb/version.h)
  polhode_need("${RANDOM123_INCLUDE_DIR}" "Random123, headers" librandom123-dev Random123/philox.h)
endif()

if(POLHODE_IO OR POLHODE_PYTHON)
  if(CMAKE_CXX_COMPILER)
    find_package(fmt QUIET)
    find_package(ZLIB QUIET)
    find_path(TOMLPLUSPLUS_INCLUDE_DIR toml++/toml.h)
    if(PKG_CONFIG_FOUND)
      pkg_search_module(POLHODE_HAS_HDF5 QUIET hdf5-serial hdf5)
      pkg_search_module(POLHODE_HAS_UDUNITS QUIET udunits udunits2)
    endif()
  endif()
  polhode_need("${fmt_FOUND}" "fmt" libfmt-dev fmt/core.h)
  polhode_need("${ZLIB_FOUND}" "zlib" zlib1g-dev zlib.h)
  polhode_need("${TOMLPLUSPLUS_INCLUDE_DIR}" "toml++" libtomlplusplus-dev toml++/toml.h)
  polhode_need("${POLHODE_HAS_HDF5_FOUND}" "HDF5" libhdf5-dev hdf5.h)
  polhode_need("${POLHODE_HAS_UDUNITS_FOUND}" "UDUNITS-2" libudunits2-dev udunits2.h)
endif()

if(POLHODE_CLI OR POLHODE_PYTHON)
  if(CMAKE_CXX_COMPILER)
    find_package(CLI11 QUIET)
  endif()
  polhode_need("${CLI11_FOUND}" "CLI11" libcli11-dev CLI/CLI.hpp)
endif()

if(POLHODE_PYTHON)
  if(CMAKE_CXX_COMPILER)
    find_package(Python 3.9 QUIET COMPONENTS Interpreter Development.Module)
  endif()
  polhode_need("${Python_Development.Module_FOUND}" "headers of Python 3.9 or later" python3-dev
    python3/Python.h)
endif()

if(polhode_missing)
  list(LENGTH polhode_missing count)
  list(JOIN polhode_missing "\n" polhode_missing)
  list(JOIN polhode_missing_packages " " polhode_missing_packages)
  # one line each, which CMake would fold otherwise
  message(NOTICE "polhode: ${count} missing, with the packages of Debian and Ubuntu:\n"
    "${polhode_missing}\n"
    "To install: sudo apt-get install ${polhode_missing_packages}\n"
    "or, in a checkout, with all that the tests need: make deps")
  message(FATAL_ERROR "polhode cannot be built: see what is missing above")
endif()
