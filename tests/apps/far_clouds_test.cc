// SPDX-License-Identifier: BSD-3-Clause
// Results do not hang on where the user's origin is.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/apps/apps_fixture.h"
#include "tests/support/far_clouds.h"

namespace icpscape {
namespace {

using testing::HasSubstr;
using testing_support::CentroidOf;
using testing_support::FarAway;
using testing_support::MovedAsPly;
using testing_support::Outcome;
using testing_support::ReadCsv;
using testing_support::RunProgram;

class FarClouds : public testing_support::AppsFixture {
 protected:
  static PointCloud Read(const std::string& path) {
    DroppedPoints dropped;
    return ReadPointFile(path, &dropped);
  }

  // The pose that register finds, with its own folder.
  SE3d Register(const std::string& name, std::vector<std::string> arguments) {
    arguments.push_back("--out=" + Path(name));
    const Outcome outcome = RunProgram("register", arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    out_ = outcome.out;
    return ReadTransform(Path(name + "/T_target_source.txt"));
  }

  std::vector<std::string> Clouds(const std::string& source, const std::string& target) {
    return {"--source=" + Path(source), "--target=" + Path(target)};
  }

  // To 0.1 mm about the centroid, and 1e-4 degrees.
  static void ExpectSamePose(const SE3d& T, const SE3d& expected, const Vec3& centroid) {
    EXPECT_LT((T * centroid - expected * centroid).norm(), 1e-4);
    EXPECT_LT((T.Inverse() * expected).LogRotation().norm() * 180 / M_PI, 1e-4);
  }

  std::string out_;
};

TEST_F(FarClouds, MovedAndTurnedPairsGiveTheConjugatedPose) {
  const PointCloud source = Read(Path("source.ply")), target = Read(Path("target.ply"));
  const SE3d T_near = Register("near", Clouds("source.ply", "target.ply"));
  const SE3d G = FarAway(1);
  folder_.Write("far_source.ply", MovedAsPly(source, G));
  folder_.Write("far_target.ply", MovedAsPly(target, G));
  const SE3d T_far = Register("far", Clouds("far_source.ply", "far_target.ply"));
  EXPECT_THAT(out_, HasSubstr("source: lies far out, and is registered less its origin"));
  const Vec3 centroid = G * CentroidOf(source);
  ExpectSamePose(T_far, G * T_near * G.Inverse(), centroid);
  // The last iterate is that pose, and the aligned cloud lies on the target.
  const auto last = ReadCsv(Path("far/iterates.csv")).back();
  EXPECT_NEAR(std::stod(last.at("tx_m")), T_far.t().x(), 1e-6);
  EXPECT_NEAR(std::stod(last.at("tz_m")), T_far.t().z(), 1e-6);
  const PointCloud aligned = Read(Path("far/aligned.ply"));
  EXPECT_GT(aligned.origin.norm(), 9e5);
  for (const std::size_t i : {0U, 1234U, 2999U}) {
    const Vec3 expected = G * (T_near * source.Point(i));
    EXPECT_LT((aligned.origin + aligned.Point(i) - expected).norm(), 1e-3) << i;
  }
}

// Floats have steps of 3 cm at 400 km: what counts are their differences.
TEST_F(FarClouds, FloatsFarOutGiveThePoseOfTheirDifferences) {
  const Vec3 offset(400000, 400000, 100);
  const PointCloud near = Read(Path("source.ply"));
  for (const char* name : {"source", "target"}) {
    PointCloud cloud = Read(Path(std::string(name) + ".ply")), differences;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      cloud.x[i] = static_cast<float>(cloud.x[i] + offset.x());
      cloud.y[i] = static_cast<float>(cloud.y[i] + offset.y());
      cloud.z[i] = static_cast<float>(cloud.z[i] + offset.z());
      testing_support::AddPoint(cloud.Point(i) - offset, &differences);
    }
    WritePly(Path(std::string(name) + "_far.ply"), cloud);
    WritePly(Path(std::string(name) + "_less.ply"), differences);
  }
  const SE3d T_less = Register("less", Clouds("source_less.ply", "target_less.ply"));
  const SE3d T_far = Register("far", Clouds("source_far.ply", "target_far.ply"));
  const SE3d G(Mat3::Identity(), offset);
  ExpectSamePose(T_far, G * T_less * G.Inverse(), G * CentroidOf(near));
  const SE3d off = ReadTransform(Path("truth.txt")).Inverse() * T_less;
  EXPECT_LT(off.LogRotation().norm() * 180 / M_PI, 0.2);
}

TEST_F(FarClouds, AScanFindsItsPlaceInAMapFarAway) {
  const SE3d G = FarAway(2);
  folder_.Write("map.ply", MovedAsPly(Read(Path("target.ply")), G));
  folder_.Write("start.txt", FormatTransform(G));
  const SE3d T_near = Register("near", Clouds("source.ply", "target.ply"));
  auto arguments = Clouds("source.ply", "map.ply");
  arguments.push_back("--initial=" + Path("start.txt"));
  const SE3d T_map = Register("in_map", arguments);
  EXPECT_THAT(out_, HasSubstr("target: lies far out"));
  EXPECT_EQ(out_.find("source: lies far out"), std::string::npos);
  ExpectSamePose(T_map, G * T_near, CentroidOf(Read(Path("source.ply"))));
}

TEST_F(FarClouds, CurvesAreTheSame) {
  const SE3d G = FarAway(3);
  folder_.Write("far_source.ply", MovedAsPly(Read(Path("source.ply")), G));
  folder_.Write("far_target.ply", MovedAsPly(Read(Path("target.ply")), G));
  folder_.Write("far_truth.txt",
                FormatTransform(G * ReadTransform(Path("truth.txt")) * G.Inverse()));
  const std::vector<std::string> curve = {"--path=geodesic", "--samples=5",
                                          "--metrics=point_to_point,point_to_plane"};
  auto near = Files(curve);
  auto far = curve;
  far.insert(far.end(), {"--source=" + Path("far_source.ply"), "--target=" + Path("far_target.ply"),
                         "--ground_truth=" + Path("far_truth.txt"), "--out=" + Path("far")});
  ASSERT_EQ(RunProgram("landscape", near).code, 0);
  const Outcome outcome = RunProgram("landscape", far);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto rows = ReadCsv(Path("out/curves.csv")), far_rows = ReadCsv(Path("far/curves.csv"));
  ASSERT_EQ(rows.size(), far_rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double tolerance = rows[i].at("metric") == "point_to_point" ? 1e-6 : 1e-4;
    EXPECT_NEAR(std::stod(far_rows[i].at("rmse")), std::stod(rows[i].at("rmse")), tolerance) << i;
  }
}

TEST_F(FarClouds, UnitsAreSaid) {
  for (const char* name : {"source", "target"}) {
    PointCloud cloud = Read(Path(std::string(name) + ".ply"));
    for (std::vector<float>* values : {&cloud.x, &cloud.y, &cloud.z}) {
      for (float& value : *values) {
        value *= 1000;
      }
    }
    WritePly(Path(std::string(name) + "_mm.ply"), cloud);
  }
  auto arguments = Clouds("source_mm.ply", "target.ply");
  arguments.push_back("--out=" + Path("out"));
  testing_support::ExpectRefusal(RunProgram("register", arguments), 2,
                                 "times as large as the target");
  arguments[0] = "--source=" + Path("source.ply");
  arguments[1] = "--target=" + Path("target_mm.ply");
  testing_support::ExpectRefusal(RunProgram("register", arguments), 2,
                                 "times smaller than the target");
  arguments[0] = "--source=" + Path("source_mm.ply");
  arguments.push_back("--accept=limit,cycle,undetermined");
  const Outcome outcome = RunProgram("register", arguments);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("warning: the source looks like millimetres"));
  EXPECT_THAT(outcome.err, HasSubstr("warning: the target looks like millimetres"));
}

}  // namespace
}  // namespace icpscape
