# SPDX-License-Identifier: MIT
# cmake --install, and the package that find_package(polhode [COMPONENTS ephemeris io]) finds.

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/polhode)

# The component and what else it links, where it is built.
foreach(component IN ITEMS core ephemeris ensemble fit mpi io cli)
  set(target polhode_${component})
  if(component STREQUAL "cli")
    set(target polhode_commands)
  endif()
  if(NOT TARGET ${target})
    continue()
  endif()
  install(TARGETS ${target} EXPORT polhode-${component}
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
    FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(EXPORT polhode-${component} NAMESPACE polhode:: DESTINATION ${package_dir})
  set(dependencies ${PROJECT_SOURCE_DIR}/cmake/${component}-dependencies.cmake)
  if(EXISTS ${dependencies})
    install(FILES ${dependencies} DESTINATION ${package_dir})
  endif()
endforeach()
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
