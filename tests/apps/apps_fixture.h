// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_TESTS_APPS_APPS_FIXTURE_H_
#define ICPSCAPE_TESTS_APPS_APPS_FIXTURE_H_

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "icpscape/io/point_files.h"
#include "icpscape/io/transform.h"
#include "tests/support/run_program.h"
#include "tests/support/scenes.h"
#include "tests/support/temporary_folder.h"

namespace icpscape::testing_support {

/// A room seen twice, 0.3 m apart, as files; and a small KITTI folder.
class AppsFixture : public testing::Test {
 protected:
  AppsFixture() {
    const SE3d T = SE3d::Exp((Vec6() << 0, 0, 0.03, 0.3, 0.05, 0).finished());
    const PointCloud target = testing_support::Room(3000, 1, SE3d(), 0.005);
    const PointCloud source = testing_support::Room(3000, 2, T.Inverse(), 0.005);
    WritePly(folder_.path() / "target.ply", target);
    WritePly(folder_.path() / "source.ply", source);
    folder_.Write("truth.txt", FormatTransform(T));
    WriteBin("kitti/sequences/00/velodyne/000000.bin", target);
    WriteBin("kitti/sequences/00/velodyne/000001.bin", source);
    folder_.Write("kitti/sequences/00/calib.txt", "Tr: 1 0 0 0 0 1 0 0 0 0 1 0\n");
    std::string row = FormatTransform(T).substr(0, FormatTransform(T).find("\n0 0 0 1"));
    std::replace(row.begin(), row.end(), '\n', ' ');
    folder_.Write("kitti/poses/00.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n" + row + "\n");
  }

  void WriteBin(const std::string& name, const PointCloud& cloud) const {
    std::string bytes;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const float record[] = {cloud.x[i], cloud.y[i], cloud.z[i], 0.5F};
      bytes.append(reinterpret_cast<const char*>(record), sizeof record);
    }
    folder_.Write(name, bytes);
  }

  std::string Path(const std::string& name) const { return (folder_.path() / name).string(); }

  std::vector<std::string> Files(std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"--source=" + Path("source.ply"), "--target=" + Path("target.ply"),
                               "--ground_truth=" + Path("truth.txt"), "--out=" + Path("out")});
    return more;
  }
  std::vector<std::string> Kitti(std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"--kitti_root=" + Path("kitti"), "--frame=1", "--out=" + Path("out"),
                               "--samples=4"});
    return more;
  }

  TemporaryFolder folder_;
};

}  // namespace icpscape::testing_support

#endif  // ICPSCAPE_TESTS_APPS_APPS_FIXTURE_H_
