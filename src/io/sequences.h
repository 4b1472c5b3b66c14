// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_IO_SEQUENCES_H_
#define ICPSCAPE_SRC_IO_SEQUENCES_H_

#include <filesystem>
#include <string>
#include <vector>

#include "icpscape/cloud/scan_sequence.h"

namespace icpscape {

/// A sequence of the KITTI odometry benchmark, or one that icpscape-simulate wrote:
///   ROOT/sequences/SS/velodyne/NNNNNN.bin, ROOT/sequences/SS/calib.txt, ROOT/poses/SS.txt.
/// Frames are the numbers of the scans, up to the last one that is there; scans between may be
/// missing until they are read. Times, poses and calibration come from their files where those are
/// there, and the times of a scan's points from times/NNNNNN.time. Throws InputError where a file
/// is malformed or ROOT/sequences/SS is no folder.
ScanSequence OpenKittiSequence(const std::filesystem::path& root, const std::string& sequence);

/// A folder of .bin, .pcd, .ply or .npy files, by number where all names are numbers, else in
/// natural order (see ComesBefore); hidden files, which begin with a dot, are no scans. Or a raw
/// drive of KITTI's, with velodyne_points/data and, where it is there,
/// velodyne_points/timestamps.txt. Frames count the scans that are there from 0. The time of a raw
/// scan is the line of its number (drives can lack scans); a folder has timestamps.txt or times.txt
/// in it, with a line for each scan, or the times that the names spell (see TimesFromNames). Throws
/// InputError where there is no scan, more than one kind of file, or a malformed time.
ScanSequence OpenScanFolder(const std::filesystem::path& folder);

/// Takes the times of the scans from a file with one for each; see ReadTimesOfScans. Throws
/// InputError.
void SetTimesFromFile(const std::filesystem::path& path, ScanSequence* sequence);

/// Two files: frame 0 is the target, frame 1 the source. The files are looked at when they are
/// read.
ScanSequence OpenTwoScans(const std::filesystem::path& source, const std::filesystem::path& target);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_IO_SEQUENCES_H_
