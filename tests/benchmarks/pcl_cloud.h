// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_TESTS_BENCHMARKS_PCL_CLOUD_H_
#define ICPSCAPE_TESTS_BENCHMARKS_PCL_CLOUD_H_

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include "tests/benchmarks/pcl_peer.h"

namespace icpscape {

/// The same points in the two types that PCL's algorithms want.
struct PclCloudData {
  pcl::PointCloud<pcl::PointXYZ>::Ptr points{new pcl::PointCloud<pcl::PointXYZ>};
  pcl::PointCloud<pcl::PointNormal>::Ptr with_normals{new pcl::PointCloud<pcl::PointNormal>};
};

}  // namespace icpscape

#endif  // ICPSCAPE_TESTS_BENCHMARKS_PCL_CLOUD_H_
