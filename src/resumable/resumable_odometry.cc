// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/resumable/resumable_odometry.h"

#include <chrono>
#include <utility>

#include "icpscape/cloud/origin.h"
#include "icpscape/common/error.h"
#include "icpscape/io/sha256.h"

namespace icpscape {
namespace {

using Clock = std::chrono::steady_clock;

// Of all files that the scan comes from.
std::string HashOf(const Scan& scan, const PointCloud& cloud) {
  const std::string hash = Sha256OfScan(scan.file, cloud);
  return scan.times_file.empty() ? hash : Sha256OfText(hash + Sha256(scan.times_file));
}

OdometryOptions WithTimesOf(const ScanSequence& sequence, OdometryOptions options) {
  options.times_are_measured = sequence.times_are_measured;
  return options;
}

double SecondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace

ResumableOdometry::ResumableOdometry(ScanSequence sequence, OdometryOptions options,
                                     double map_voxel_m, Journal* journal)
    : sequence_(std::move(sequence)),
      journal_(*journal),
      num_known_(journal->records().size()),
      odometry_(WithTimesOf(sequence_, std::move(options))) {
  if (map_voxel_m > 0) {
    map_.emplace(map_voxel_m);
  }
}

void ResumableOdometry::Replay(const Progress& progress) {
  ForScans(
      0, num_known_, [this](std::size_t i) { ReplayScan(i); }, progress);
}

void ResumableOdometry::Register(const Progress& progress) {
  ForScans(
      num_known_, sequence_.scans.size(), [this](std::size_t i) { RegisterScan(i); }, progress);
}

void ResumableOdometry::ForScans(std::size_t begin, std::size_t end,
                                 const std::function<void(std::size_t)>& take,
                                 const Progress& progress) {
  for (std::size_t i = begin; i < end; ++i) {
    take(i);
    const FrameResult& result = records_.back().result;
    // The first scan of several is de-skewed only when the second has been registered.
    const bool is_first = i == 0 && (!result.deskewed || sequence_.scans.size() == 1);
    if (map_ && (is_first || result.registered)) {
      NamingTheScan(i, [&] {
        map_->Insert(odometry_.last_scan()->cloud(), result.T_world_lidar, static_cast<int>(i));
      });
    }
    if (progress) {
      progress(static_cast<int>(i + 1 - begin));
    }
  }
}

// Scans of one world stay within one: all have the origin of the first.
PointCloud ResumableOdometry::Read(std::size_t i) {
  DroppedPoints dropped;
  PointCloud scan = sequence_.scans[i].read(&dropped);
  if (i == 0) {
    origin_ = scan.origin;
  }
  MoveOrigin(origin_, &scan);
  return scan;
}

// Errors of the odometry do not know which file a scan comes from.
void ResumableOdometry::NamingTheScan(std::size_t i, const std::function<void()>& use) const {
  try {
    use();
  } catch (const InputError& error) {
    throw InputError(sequence_.scans[i].Place() + ": " + error.what());
  }
}

void ResumableOdometry::ReplayScan(std::size_t i) {
  const FrameRecord record =
      ParseFrameRecord(journal_.records()[i], "journal, scan " + sequence_.scans[i].name);
  PointCloud scan = Read(i);
  if (record.scan_sha256 != HashOf(sequence_.scans[i], scan)) {
    throw InputError(sequence_.scans[i].Place() +
                     ": is not the scan of the journal; expected it unchanged, or a restart.");
  }
  NamingTheScan(i, [&] { odometry_.Replay(std::move(scan), record.result, sequence_.times_s[i]); });
  records_.push_back(record);
}

void ResumableOdometry::RegisterScan(std::size_t i) {
  FrameRecord record;
  const Clock::time_point start = Clock::now();
  PointCloud scan = Read(i);
  record.scan_sha256 = HashOf(sequence_.scans[i], scan);
  record.read_s = SecondsSince(start);
  const Clock::time_point read = Clock::now();
  NamingTheScan(i, [&] { record.result = odometry_.Add(std::move(scan), sequence_.times_s[i]); });
  record.odometry_s = SecondsSince(read);
  journal_.Append(FormatFrameRecord(record));
  records_.push_back(record);
}

}  // namespace icpscape
