# SPDX-License-Identifier: BSD-3-Clause
# find_package(icpscape) gives icpscape::residuals (Eigen alone) and icpscape::core.
include(CMakePackageConfigHelpers)
install(TARGETS residuals core EXPORT icpscape_targets)
install(EXPORT icpscape_targets NAMESPACE icpscape:: FILE icpscape_targets.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/icpscape)
configure_package_config_file(
  cmake/icpscape-config.cmake.in ${CMAKE_BINARY_DIR}/icpscape-config.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/icpscape)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/icpscape-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/icpscape-config.cmake
              ${CMAKE_BINARY_DIR}/icpscape-config-version.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/icpscape)
install(DIRECTORY residuals src DESTINATION include/icpscape FILES_MATCHING PATTERN "*.h")
install(DIRECTORY tests/support DESTINATION include/icpscape/tests FILES_MATCHING
        PATTERN "residual_*.h")
install(DIRECTORY tools DESTINATION share/icpscape FILES_MATCHING PATTERN "plot_*.py")
