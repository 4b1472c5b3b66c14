// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_SIMULATION_LIDAR_H_
#define ICPSCAPE_SRC_SIMULATION_LIDAR_H_

#include <cstdint>

#include "icpscape/cloud/point_cloud.h"
#include "icpscape/simulation/lidar_motion.h"
#include "icpscape/simulation/ray_caster.h"

namespace icpscape {

/// The spinning lidar of KITTI: a Velodyne HDL-64E on the roof of a car.
///
/// "measured" means by tools/measure_lidar.py on KITTI's scans; docs/simulation.md has the numbers.
struct LidarOptions {
  /// Angle between two firings, at 10 turns a second; measured 0.1794 (data sheet: 0.09 to 0.18).
  double azimuth_step_deg = 0.1794;
  /// Standard deviation of a range between one laser's firings; measured on road and walls.
  double range_noise_m = 0.009;
  /// Standard deviation between the lasers' own constant range errors. Measured 0.022 on walls; the
  /// data sheet gives 0.02 for both errors together.
  double ring_bias_m = 0.02;
  /// Share of returns lost for no visible reason: measured as single gaps on smooth surfaces.
  double dropout = 0.004;
  /// Data sheet: nothing nearer is measured, ...
  double min_range_m = 0.9;
  /// ... and a surface of 0.80 reflectivity up to here.
  double max_range_m = 120;
  /// Whether all moves while the lidar turns, itself included: then each point is seen from where
  /// the lidar is at its time, and the points have times. Else a scan is a snapshot.
  bool skewed = false;

  /// Throws UsageError naming the value that no lidar can have.
  void Check() const;
  int AzimuthSteps() const;
};

constexpr int kLidarRings = 64;
/// Height of the sensor's origin above the road [Geiger et al. 2013, fig. 3].
constexpr double kLidarHeightM = 1.73;

/// Elevation of a ring's beam (rad), 0 the uppermost: two blocks of 32 lasers, steps of about 1/3
/// and 1/2 degree.
double RingElevation(int ring);
/// Height above the sensor's origin from which a ring's beam leaves (m).
double RingHeight(int ring);
/// The last ring that passes the car's own body at an azimuth (rad, 0 forward): the rays of the
/// rings below end on roof and bonnet and bring nothing back.
int LastRingPastCar(double azimuth_rad);

/// The scan of the world, in the lidar's frame, with intensity, rings and labels; ring by ring from
/// the uppermost, counter-clockwise from forward.
///
/// KITTI's scans are de-skewed by the car's own motion. In a snapshot all rays belong to the
/// instant of the motion's pose. For everything at rest that is the same; what moves is not smeared
/// (at 6 m/s relative to the lidar, abeam and seen within a quarter of a turn, by up to 15 cm). In
/// a skewed scan each ray has its time and leaves from the pose at that time; coordinates are those
/// that the lidar measures then. The span of `moving` is the turn.
///
/// Random numbers depend on `key` (one per scan), ring and azimuth only, and the lasers' constant
/// errors on `sensor_key`: the scan is the same for any number of threads.
PointCloud ScanWorld(const RayCaster& standing, const RayCaster* moving, const LidarMotion& motion,
                     const LidarOptions& options, std::uint64_t sensor_key, std::uint64_t key,
                     int threads);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_SIMULATION_LIDAR_H_
