# SPDX-License-Identifier: BSD-3-Clause
# find_package(icpscape COMPONENTS ...) gives icpscape::residuals and the parts that are named, each
# from a file of its own: who asks for core hears of no package of io's or simulation's.
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/icpscape)
foreach(component residuals ${ICPSCAPE_COMPONENTS})
  install(TARGETS icpscape_${component} EXPORT icpscape_${component}_targets)
  install(EXPORT icpscape_${component}_targets NAMESPACE icpscape:: DESTINATION ${package_dir})
endforeach()
foreach(component ${ICPSCAPE_COMPONENTS})
  get_target_property(folders icpscape_${component} FOLDERS)
  list(TRANSFORM folders PREPEND src/)
  install(DIRECTORY ${folders} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/icpscape
          FILES_MATCHING PATTERN "*.h")
endforeach()
# The test suite of the residuals is for metrics of other projects as well.
install(DIRECTORY residuals tests/testing DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/icpscape
        FILES_MATCHING PATTERN "*.h")
configure_package_config_file(
  cmake/icpscape-config.cmake.in ${PROJECT_BINARY_DIR}/icpscape-config.cmake
  INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/icpscape-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/icpscape-config.cmake
              ${PROJECT_BINARY_DIR}/icpscape-config-version.cmake
        DESTINATION ${package_dir})
install(DIRECTORY tools DESTINATION share/icpscape FILES_MATCHING PATTERN "plot_*.py")
