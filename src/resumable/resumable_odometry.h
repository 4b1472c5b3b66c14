// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_RESUMABLE_RESUMABLE_ODOMETRY_H_
#define ICPSCAPE_SRC_RESUMABLE_RESUMABLE_ODOMETRY_H_

#include <functional>
#include <optional>
#include <vector>

#include "icpscape/io/journal.h"
#include "icpscape/io/sequences.h"
#include "icpscape/odometry/odometry.h"
#include "icpscape/odometry/voxel_map.h"
#include "icpscape/resumable/frame_record.h"

namespace icpscape {

/// An odometry over a drive that goes on after a stop: the journal has a record of every scan that
/// is done. Replay and then Register go through the whole drive; the results are bit for bit those
/// of a run that was never stopped.
class ResumableOdometry {
 public:
  /// Called with the number of scans done, after each.
  using Progress = std::function<void(int)>;

  /// Keeps a map of the whole drive with one point per voxel of `map_voxel_m`; 0: no map. The
  /// journal must live as long as this object. Throws UsageError.
  ResumableOdometry(ScanSequence sequence, OdometryOptions options, double map_voxel_m,
                    Journal* journal);

  /// Scans that the journal has from earlier runs, and those that are left.
  int num_known() const { return static_cast<int>(num_known_); }
  int num_left() const { return static_cast<int>(sequence_.scans.size() - num_known_); }

  /// Takes over what the journal has. Throws InputError where a scan is not the journal's.
  void Replay(const Progress& progress);

  /// Registers the scans that are left, and writes each into the journal. Throws InputError that
  /// names the scan that cannot be read or used.
  void Register(const Progress& progress);

  const ScanSequence& sequence() const { return sequence_; }
  /// What was taken out of all scans: the origin of the first. Poses and map are without it.
  const Vec3& origin() const { return origin_; }
  /// One for each scan so far.
  const std::vector<FrameRecord>& records() const { return records_; }
  const std::optional<VoxelMap>& map() const { return map_; }

 private:
  void ForScans(std::size_t begin, std::size_t end, const std::function<void(std::size_t)>& take,
                const Progress& progress);
  PointCloud Read(std::size_t i);
  void NamingTheScan(std::size_t i, const std::function<void()>& use) const;
  void ReplayScan(std::size_t i);
  void RegisterScan(std::size_t i);

  ScanSequence sequence_;
  Vec3 origin_ = Vec3::Zero();
  Journal& journal_;
  std::size_t num_known_;
  Odometry odometry_;
  std::vector<FrameRecord> records_;
  std::optional<VoxelMap> map_;
};

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_RESUMABLE_RESUMABLE_ODOMETRY_H_
