// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_TESTS_APPS_ODOMETRY_FIXTURE_H_
#define ICPSCAPE_TESTS_APPS_ODOMETRY_FIXTURE_H_

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "icpscape/io/transform.h"
#include "icpscape/resumable/frame_record.h"
#include "tests/support/drives.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

namespace icpscape::testing_support {

inline constexpr char kProgram[] = ICPSCAPE_BIN_DIR "/icpscape-odometry";
inline constexpr int kScans = 12;
// What must not depend on how often the run was interrupted.
inline constexpr const char* kResults[] = {"trajectory_kitti.txt", "trajectory_tum.txt",
                                           "frames.csv", "map.ply", "trajectory.csv"};

inline const SimulatedDrive& TheDrive() {
  static const SimulatedDrive drive = SimulateTownDrive(kScans);
  return drive;
}

inline std::string Bytes(const PointCloud& cloud) {
  std::string bytes;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const float record[] = {cloud.x[i], cloud.y[i], cloud.z[i], cloud.intensity[i]};
    bytes.append(reinterpret_cast<const char*>(record), sizeof record);
  }
  return bytes;
}

inline std::string ScanName(int i) {
  return (i < 10 ? "00000" : "0000") + std::to_string(i) + ".bin";
}

inline double DistanceM(const SE3d& a, const SE3d& b) { return (a.Inverse() * b).t().norm(); }

/// While it lives, Python finds no matplotlib: no time goes into figures.
class WithoutFigures {
 public:
  WithoutFigures() {
    folder_.Write("matplotlib.py", "raise ImportError\n");
    setenv("PYTHONPATH", folder_.path().c_str(), 1);
  }
  ~WithoutFigures() { unsetenv("PYTHONPATH"); }

 private:
  TemporaryFolder folder_;
};

/// A simulated drive as a KITTI sequence, whose camera looks forward.
class OdometryApp : public testing::Test {
 protected:
  OdometryApp() {
    std::string times, poses;
    for (int i = 0; i < kScans; ++i) {
      const auto k = static_cast<std::size_t>(i);
      folder_.Write(Scan(i), Bytes(TheDrive().scans[k]));
      times += std::to_string(times_s_[k]) + "\n";
      poses += FormatTransformRow(Tr_ * TheDrive().T_world_lidar[k] * Tr_.Inverse()) + "\n";
    }
    folder_.Write("kitti/sequences/05/times.txt", times);
    folder_.Write("kitti/sequences/05/calib.txt", "Tr: " + FormatTransformRow(Tr_) + "\n");
    folder_.Write("kitti/poses/05.txt", poses);
  }

  static std::string Scan(int i) { return "kitti/sequences/05/velodyne/" + ScanName(i); }
  std::string Path(const std::string& name) const { return (folder_.path() / name).string(); }

  std::vector<std::string> Kitti(std::vector<std::string> more = {},
                                 const std::string& out = "out") const {
    more.insert(more.begin(), {"--kitti_root=" + Path("kitti"), "--sequence=05",
                               "--out=" + Path(out), "--threads=2"});
    return more;
  }
  Outcome Run(std::vector<std::string> more = {}, const std::string& out = "out") const {
    return RunProgram("odometry", Kitti(std::move(more), out));
  }

  // The lines of the journal after its header.
  std::vector<FrameRecord> Journal(const std::string& out = "out") const {
    std::vector<FrameRecord> records;
    std::istringstream in(ReadFile(Path(out + "/journal.txt")));
    std::string line;
    std::getline(in, line);
    while (std::getline(in, line)) {
      records.push_back(ParseFrameRecord(line.substr(0, line.rfind(' ')), "journal"));
    }
    return records;
  }

  void ExpectSameResults(const std::string& a, const std::string& b) const {
    for (const std::string name : kResults) {
      const std::string text = ReadFile(Path(a + "/" + name));
      EXPECT_FALSE(text.empty()) << name;
      EXPECT_TRUE(text == ReadFile(Path(b + "/" + name))) << name;
    }
  }

  TemporaryFolder folder_;
  std::optional<WithoutFigures> without_figures_{std::in_place};
  const SE3d Tr_{(Mat3() << 0, -1, 0, 0, 0, -1, 1, 0, 0).finished(), Vec3(0.125, 0.25, 0.5)};
  const std::array<double, kScans> times_s_ = {0,    0.1,  0.21, 0.3,  0.42, 0.5,
                                               0.61, 0.72, 0.8,  0.93, 1,    1.125};
};

}  // namespace icpscape::testing_support

#endif  // ICPSCAPE_TESTS_APPS_ODOMETRY_FIXTURE_H_
