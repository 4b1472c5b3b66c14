# SPDX-License-Identifier: BSD-3-Clause
# Each part of the library asks for its own packages alone. tools/setup.sh installs all of these
# from Debian.
set(CMAKE_FIND_PACKAGE_TARGETS_GLOBAL ON)  # A parent project links them through our targets.
find_package(Eigen3 3.4 REQUIRED NO_MODULE)

if("core" IN_LIST ICPSCAPE_COMPONENTS)
  find_package(Ceres 2.1 REQUIRED)
  find_package(glog REQUIRED)
  find_package(TBB REQUIRED)
  find_package(Boost 1.74 REQUIRED)  # Chi-square quantiles; headers alone.
endif()

if("io" IN_LIST ICPSCAPE_COMPONENTS)
  find_package(OpenSSL REQUIRED COMPONENTS Crypto)
  find_package(nlohmann_json REQUIRED)
  find_package(liblzf REQUIRED)
endif()

if(ICPSCAPE_BUILD_TESTS OR ICPSCAPE_BUILD_BENCHMARKS)  # A peer.
  enable_language(C)  # PCL's package asks for it.
  find_package(PCL 1.12 REQUIRED COMPONENTS common io)
  # PCL's own target asks every user for SSE4 flags and for VTK; our tests need neither.
  add_library(icpscape_pcl INTERFACE)
  target_include_directories(icpscape_pcl SYSTEM INTERFACE ${PCL_INCLUDE_DIRS})
  target_link_libraries(icpscape_pcl INTERFACE pcl_common pcl_io)
endif()

if("simulation" IN_LIST ICPSCAPE_COMPONENTS)
  find_package(embree 3 REQUIRED)
endif()

if(ICPSCAPE_BUILD_APPS OR ICPSCAPE_BUILD_BENCHMARKS)
  find_package(gflags REQUIRED)
endif()
