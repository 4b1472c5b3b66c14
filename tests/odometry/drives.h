// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_TESTS_ODOMETRY_DRIVES_H_
#define ICPSCAPE_TESTS_ODOMETRY_DRIVES_H_

#include <cmath>
#include <string>
#include <vector>

#include "icpscape/objective/loss.h"
#include "icpscape/odometry/odometry.h"
#include "icpscape/resumable/frame_record.h"
#include "tests/support/drives.h"

namespace icpscape::testing_support {

using Metrics = std::vector<std::string>;

inline constexpr OdometryMode kModes[] = {OdometryMode::kScanToScan, OdometryMode::kScanToMap,
                                          OdometryMode::kTwoStage};
inline const char* const kNames[] = {"scan_to_scan", "scan_to_map", "two_stage"};
inline const Metrics kPlanes = {"point_to_plane"};
inline const Metrics kSymmetric = {"symmetric"};
inline const Metrics kLoam = {"edge_to_line", "planar_to_plane"};

inline OdometryOptions Options(OdometryMode mode, const Metrics& metrics = kPlanes) {
  OdometryOptions options;
  options.mode = mode;
  options.metrics = metrics;
  options.preparation.voxel_m = metrics == kLoam ? 0 : 0.25;
  options.objective.loss = MakeLoss("huber", 0.1);
  options.adaptive_gate_m = 2;
  options.map_every = 2;
  options.threads = 2;
  return options;
}

inline std::vector<PointCloud> FirstScans(std::size_t count) {
  const std::vector<PointCloud>& scans = TownDrive().scans;
  return {scans.begin(), scans.begin() + static_cast<std::ptrdiff_t>(count)};
}

inline std::vector<FrameResult> RunAll(const OdometryOptions& options,
                                       const std::vector<PointCloud>& scans) {
  Odometry odometry(options);
  std::vector<FrameResult> results;
  for (const PointCloud& scan : scans) {
    results.push_back(odometry.Add(scan));
  }
  return results;
}

inline double DistanceM(const SE3d& a, const SE3d& b) { return (a.Inverse() * b).t().norm(); }
inline double AngleDeg(const SE3d& a, const SE3d& b) {
  return (a.Inverse() * b).LogRotation().norm() * 180 / M_PI;
}

// All that there is in a result, bit for bit: FrameRecord's text is exact.
inline std::string Bits(const FrameResult& result) {
  FrameRecord record;
  record.result = result;
  return FormatFrameRecord(record);
}
inline std::vector<std::string> Bits(const std::vector<FrameResult>& results) {
  std::vector<std::string> bits;
  for (const FrameResult& result : results) {
    bits.push_back(Bits(result));
  }
  return bits;
}

}  // namespace icpscape::testing_support

#endif  // ICPSCAPE_TESTS_ODOMETRY_DRIVES_H_
