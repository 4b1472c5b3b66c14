# SPDX-License-Identifier: BSD-3-Clause
# icpscape_version.h with the release and the commit, brought up to date at every build.
add_custom_target(
  icpscape_version_file
  COMMAND ${CMAKE_COMMAND} -DSOURCE_DIR=${PROJECT_SOURCE_DIR} -DRELEASE=${PROJECT_VERSION}
          -DOUTPUT=${PROJECT_BINARY_DIR}/generated/icpscape_version.h -P
          ${PROJECT_SOURCE_DIR}/cmake/write_version.cmake
  BYPRODUCTS ${PROJECT_BINARY_DIR}/generated/icpscape_version.h
  COMMENT "Noting the version")
add_library(icpscape_version INTERFACE)
target_include_directories(icpscape_version INTERFACE ${PROJECT_BINARY_DIR}/generated)
add_dependencies(icpscape_version icpscape_version_file)
