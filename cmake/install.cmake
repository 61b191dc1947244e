# SPDX-License-Identifier: MIT
# cmake --install, and the package that find_package(polhode [COMPONENTS ephemeris io]) finds.

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/polhode)

install(TARGETS polhode_core EXPORT polhode-core
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
  FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT polhode-core NAMESPACE polhode:: DESTINATION ${package_dir})

if(TARGET polhode_ephemeris)
  install(TARGETS polhode_ephemeris EXPORT polhode-ephemeris
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
    FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(EXPORT polhode-ephemeris NAMESPACE polhode:: DESTINATION ${package_dir})
  install(FILES ${PROJECT_SOURCE_DIR}/cmake/ephemeris-dependencies.cmake
    DESTINATION ${package_dir})
endif()
if(TARGET polhode_io)
  install(TARGETS polhode_io EXPORT polhode-io
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
    FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(EXPORT polhode-io NAMESPACE polhode:: DESTINATION ${package_dir})
  install(FILES ${PROJECT_SOURCE_DIR}/cmake/io-dependencies.cmake DESTINATION ${package_dir})
endif()
if(TARGET polhode_ensemble)
  install(TARGETS polhode_ensemble EXPORT polhode-ensemble
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
    FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(EXPORT polhode-ensemble NAMESPACE polhode:: DESTINATION ${package_dir})
  install(FILES ${PROJECT_SOURCE_DIR}/cmake/ensemble-dependencies.cmake DESTINATION ${package_dir})
endif()
if(TARGET polhode_mpi)
  install(TARGETS polhode_mpi EXPORT polhode-mpi
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
    FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(EXPORT polhode-mpi NAMESPACE polhode:: DESTINATION ${package_dir})
  install(FILES ${PROJECT_SOURCE_DIR}/cmake/mpi-dependencies.cmake DESTINATION ${package_dir})
endif()
if(TARGET polhode_commands)
  install(TARGETS polhode_commands EXPORT polhode-cli
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
    FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(EXPORT polhode-cli NAMESPACE polhode:: DESTINATION ${package_dir})
endif()
if(TARGET polhode)
  install(TARGETS polhode RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  if(NOT CMAKE_CROSSCOMPILING)
    install(FILES ${PROJECT_BINARY_DIR}/cli/polhode.bash
      DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME polhode)
    install(FILES ${PROJECT_BINARY_DIR}/cli/polhode.zsh
      DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions RENAME _polhode)
  endif()
endif()

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/polhode-config.cmake.in
  ${PROJECT_BINARY_DIR}/polhode-config.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/polhode-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES
  ${PROJECT_BINARY_DIR}/polhode-config.cmake
  ${PROJECT_BINARY_DIR}/polhode-config-version.cmake
  DESTINATION ${package_dir})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/CITATION.cff
  DESTINATION ${CMAKE_INSTALL_DOCDIR})
