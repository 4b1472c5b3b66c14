// SPDX-License-Identifier: BSD-3-Clause
// Register, Landscape and Covariance against the programs of the same names, bit for bit.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "icpscape/api/covariance.h"
#include "icpscape/api/landscape.h"
#include "icpscape/api/register.h"
#include "icpscape/common/text.h"
#include "icpscape/io/kitti_writer.h"
#include "icpscape/io/point_files.h"
#include "icpscape/io/transform.h"
#include "icpscape/objective/loss.h"
#include "icpscape/simulation/simulated_sequence.h"
#include "tests/support/message_of.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

namespace icpscape {
namespace {

using testing::HasSubstr;
using testing_support::MessageOf;
using testing_support::ReadCsv;
using testing_support::ReadFile;
using testing_support::RunProgram;

// A turn of simulated scans, as files that the programs read, and as the clouds in them.
class Api : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    LidarOptions lidar;
    lidar.azimuth_step_deg = 0.72;
    const ScanPair pair = SimulatePair("right_turn", 3, lidar, 2);
    folder_ = new testing_support::TemporaryFolder;
    WriteVelodyne(Path("source.bin"), pair.source);
    WriteVelodyne(Path("target.bin"), pair.target);
    folder_->Write("truth.txt", FormatTransform(*pair.T_ground_truth));
    truth_ = new SE3d(ReadTransform(Path("truth.txt")));
    DroppedPoints dropped;
    source_ = new PointCloud(ReadPointFile(Path("source.bin"), &dropped));
    target_ = new PointCloud(ReadPointFile(Path("target.bin"), &dropped));
  }
  static void TearDownTestSuite() {
    delete folder_;
    delete truth_;
    delete source_;
    delete target_;
  }

  static std::string Path(const std::string& name) { return (folder_->path() / name).string(); }

  // Runs the program on the files, and returns its folder.
  static std::filesystem::path Run(const std::string& app, std::vector<std::string> more) {
    static int number = 0;
    const std::string out = Path(app + std::to_string(++number));
    more.insert(more.end(), {"--source=" + Path("source.bin"), "--target=" + Path("target.bin"),
                             "--out=" + out});
    const testing_support::Outcome outcome = RunProgram(app, more);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return out;
  }

  static void ExpectSameRegistration(const RegisterResult& result,
                                     const std::filesystem::path& folder) {
    ASSERT_TRUE(result.Usable()) << result.message;
    EXPECT_EQ(FormatTransform(result.T_target_source), ReadFile(folder / "T_target_source.txt"));
    const auto rows = ReadCsv((folder / "iterates.csv").string());
    ASSERT_EQ(rows.size(), result.iterates.size());
    EXPECT_GT(rows.size(), 2U);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      EXPECT_EQ(rows[i].at("cost"), Number(result.iterates[i].cost));
    }
    EXPECT_EQ(rows.back().at("cost"), Number(result.cost));
    EXPECT_EQ(rows.back().at("rmse"), Number(result.rmse));
    EXPECT_EQ(rows.back().at("n"), std::to_string(result.num_pairs));
  }

  static testing_support::TemporaryFolder* folder_;
  static SE3d* truth_;
  static PointCloud *source_, *target_;
};
testing_support::TemporaryFolder* Api::folder_ = nullptr;
SE3d* Api::truth_ = nullptr;
PointCloud* Api::source_ = nullptr;
PointCloud* Api::target_ = nullptr;

TEST_F(Api, RegistersAsTheProgramDoes) {
  const RegisterResult result = Register(*source_, *target_);
  ExpectSameRegistration(result, Run("register", {}));
  EXPECT_EQ(result.termination, Termination::kConverged);
  EXPECT_LT((truth_->Inverse() * result.T_target_source).t().norm(), 0.02);
}

TEST_F(Api, RegistersAsTheProgramDoesWithEveryKindOfOption) {
  RegisterOptions options;
  options.metrics = {"edge_to_line", "planar_to_plane"};
  options.weights = {0.5, 2};
  options.objective.matching.max_distance_m = 2;
  options.objective.line.max_neighbor_distance_m = 1;
  options.objective.patch.max_neighbor_distance_m = 1;
  options.objective.loss = MakeLoss("huber", 0.2);
  options.preparation.normals.num_neighbors = 12;
  options.minimizer.max_iterations = 6;
  options.T_initial = SE3d(Mat3::Identity(), Vec3(0.25, 0, 0));
  options.threads = 2;
  folder_->Write("initial.txt", FormatTransform(options.T_initial));
  const std::vector<std::string> common = {
      "--max_distance_m=2", "--fit_max_neighbor_distance_m=1", "--loss=huber",
      "--loss_scale_m=0.2", "--normal_neighbors=12",           "--max_iterations=6",
      "--accept=limit",     "--initial=" + Path("initial.txt")};
  std::vector<std::string> features = common;
  features.insert(features.end(), {"--metrics=edge_to_line,planar_to_plane", "--weights=0.5,2"});
  ExpectSameRegistration(Register(*source_, *target_, options), Run("register", features));
  options.metrics = {"symmetric"};
  options.weights = {};
  options.preparation.voxel_m = 0.25;
  options.objective.matching.kept_fraction = 0.9;
  std::vector<std::string> voxels = common;
  voxels.insert(voxels.end(), {"--metrics=symmetric", "--voxel_m=0.25", "--kept_fraction=0.9"});
  ExpectSameRegistration(Register(*source_, *target_, options), Run("register", voxels));
}

TEST_F(Api, RegistersRobustlyAsTheProgramDoes) {
  const auto folder = Run("register", {"--preset=robust"});
  const RegisterResult result = Register(*source_, *target_, RegisterOptions::Robust());
  ExpectSameRegistration(result, folder);
  const auto stages = ReadCsv((folder / "stages.csv").string());
  ASSERT_EQ(stages.size(), result.stages.size());
  EXPECT_GT(stages.size(), 2U);
  for (std::size_t i = 0; i < stages.size(); ++i) {
    EXPECT_EQ(stages[i].at("first_iterate"), std::to_string(result.stages[i].first_iterate));
    EXPECT_EQ(stages[i].at("max_distance_m"), Number(result.stages[i].max_distance_m));
  }
}

TEST_F(Api, LandscapesAreThoseOfTheProgram) {
  LandscapeOptions options;
  options.curve.samples = 7;
  options.path = PathKind::kBicycle;
  const LandscapeResult result = Landscape(*source_, *target_, *truth_, options);
  const auto rows = ReadCsv(
      (Run("landscape", {"--ground_truth=" + Path("truth.txt"), "--samples=7", "--path=bicycle"}) /
       "curves.csv")
          .string());
  ASSERT_EQ(result.curves.size(), 3U);
  ASSERT_EQ(rows.size(), 21U);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Curve& curve = result.curves[i / 7];
    const CurvePoint& point = curve.points[i % 7];
    EXPECT_EQ(rows[i].at("metric"), curve.metric);
    EXPECT_EQ(rows[i].at("u"), Number(point.u));
    EXPECT_EQ(rows[i].at("rmse"), Number(point.rmse));
    EXPECT_EQ(rows[i].at("cost"), Number(point.cost));
    EXPECT_EQ(rows[i].at("n"), Number(point.n));
    EXPECT_EQ(rows[i].at("slope_analytic"), Number(point.slope_analytic));
  }
  EXPECT_LT((result.path.Pose(1).Inverse() * *truth_).Log().norm(), 1e-12);
}

TEST_F(Api, CovariancesAreThoseOfTheProgram) {
  PairCovarianceOptions options;
  options.estimators.cluster_m = 2;
  const std::vector<CovarianceResult> results = Covariance(*source_, *target_, options);
  const std::filesystem::path folder = Run("covariance", {"--cluster_m=2", "--draws=0"});
  const auto rows = ReadCsv((folder / "covariance.csv").string());
  const std::size_t estimators = AllOf<Estimator>().size();
  ASSERT_EQ(results.size(), 3U);
  ASSERT_EQ(rows.size(), 3 * estimators);
  int there = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const CovarianceResult& result = results[i / estimators];
    const Estimator estimator = AllOf<Estimator>()[i % estimators];
    EXPECT_EQ(rows[i].at("metric"), result.metric);
    EXPECT_EQ(rows[i].at("estimator"), NameOf(estimator));
    const std::optional<Mat6>& covariance = result.Of(estimator);
    EXPECT_EQ(rows[i].at("cov_rx_rx_rad_rad"), Number(covariance ? (*covariance)(0, 0) : NAN));
    EXPECT_EQ(rows[i].at("cov_rz_tx_rad_m"), Number(covariance ? (*covariance)(2, 3) : NAN));
    EXPECT_EQ(rows[i].at("cov_tz_tz_m_m"), Number(covariance ? (*covariance)(5, 5) : NAN));
    there += covariance ? 1 : 0;
  }
  EXPECT_GE(there, 12);  // Files have no rings: all but censi_ring_bias.
  const auto directions = ReadCsv((folder / "directions.csv").string());
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const EigenDirections& eigen = results[i / 6].directions;
    EXPECT_EQ(directions[i].at("eigenvalue"),
              Number(eigen.eigenvalues[static_cast<Eigen::Index>(i % 6)]));
  }
  const auto judgements = ReadCsv((folder / "degeneracy.csv").string());
  std::size_t judged = 0;
  for (const CovarianceResult& result : results) {
    for (const Judgement& judgement : result.degeneracy) {
      ASSERT_LT(judged, judgements.size());
      EXPECT_EQ(judgements[judged].at("rule"), judgement.rule);
      EXPECT_EQ(judgements[judged++].at("value"), Number(judgement.value));
    }
  }
  EXPECT_EQ(judged, judgements.size());
}

TEST_F(Api, DropsPointsThatNoRegistrationCanUse) {
  PointCloud source = *source_;
  for (const float bad : {NAN, INFINITY, 0.F, 2e6F}) {
    source.x.push_back(bad), source.y.push_back(0), source.z.push_back(0);
    source.intensity.push_back(0);
  }
  const RegisterResult clean = Register(*source_, *target_);
  const RegisterResult result = Register(source, *target_);
  EXPECT_EQ(result.T_target_source.Matrix(), clean.T_target_source.Matrix());
  EXPECT_EQ(result.num_pairs, clean.num_pairs);
}

TEST_F(Api, RefusesCloudsThatAreMalformed) {
  PointCloud bad = *source_;
  bad.y.pop_back();
  const std::string x = std::to_string(bad.size());
  const std::string y = std::to_string(bad.y.size());
  EXPECT_EQ(MessageOf([&] { Register(bad, *target_); }),
            "the source has " + x + " x and " + y + " y; expected as many of both.");
  bad = *target_;
  bad.ring = {1, 2};
  EXPECT_THAT(MessageOf([&] { Landscape(*source_, bad, *truth_); }),
              HasSubstr("the target has " + std::to_string(bad.size()) +
                        " x and 2 ring; expected as many of both, or none."));
  EXPECT_THAT(MessageOf<ComputationError>([&] { Register(PointCloud(), *target_); }),
              HasSubstr("no source point is left"));
}

TEST_F(Api, ARegistrationWithoutPairsHasNoResultAndSaysSo) {
  RegisterOptions options;
  options.T_initial = SE3d(Mat3::Identity(), Vec3(1, 2, 3));
  const RegisterResult result = Register(*source_, PointCloud(), options);
  EXPECT_EQ(result.termination, Termination::kNoCorrespondences);
  EXPECT_FALSE(result.Usable());
  EXPECT_EQ(result.T_target_source.Matrix(), options.T_initial.Matrix());
  EXPECT_THROW(Landscape(*source_, PointCloud(), *truth_), ComputationError);
  EXPECT_THROW(Covariance(*source_, PointCloud()), ComputationError);
}

TEST_F(Api, RefusesOptionsThatAreOutOfRange) {
  const auto message = [](auto change) {
    return MessageOf<UsageError>([&] {
      RegisterOptions options;
      change(&options);
      Register(*source_, *target_, options);
    });
  };
  using Options = RegisterOptions*;
  EXPECT_THAT(message([](Options o) { o->metrics = {}; }), HasSubstr("No metric is named"));
  EXPECT_THAT(message([](Options o) { o->metrics = {"plane"}; }), HasSubstr("\"plane\""));
  EXPECT_THAT(message([](Options o) {
                o->metrics = {"symmetric", "symmetric"};
              }),
              HasSubstr("symmetric is named twice"));
  EXPECT_THAT(message([](Options o) {
                o->weights = {1, 2};
              }),
              HasSubstr("2 weights for 1 objectives"));
  EXPECT_THAT(message([](Options o) { o->preparation.voxel_m = NAN; }),
              HasSubstr("voxel_m is nan"));
  EXPECT_THAT(message([](Options o) {
                o->metrics = {"edge_to_line"};
                o->preparation.voxel_m = 0.1;
              }),
              HasSubstr("voxel_m is 0.1; expected 0 with edge_to_line"));
  EXPECT_THAT(message([](Options o) { o->preparation.normals.num_neighbors = 2; }),
              HasSubstr("num_neighbors is 2; expected at least 3"));
  EXPECT_THAT(message([](Options o) { o->preparation.normals.radius_m = -1; }),
              HasSubstr("radius_m is -1"));
  EXPECT_THAT(message([](Options o) { o->preparation.elevation_correction_deg = INFINITY; }),
              HasSubstr("elevation_correction_deg is inf"));
  EXPECT_THAT(message([](Options o) { o->objective.matching.max_distance_m = -0.5; }),
              HasSubstr("max_distance_m is -0.5"));
  EXPECT_THAT(message([](Options o) { o->objective.matching.max_normal_angle_rad = 4; }),
              HasSubstr("max_normal_angle_rad is 4"));
  EXPECT_THAT(message([](Options o) { o->objective.matching.max_median_factor = -2; }),
              HasSubstr("max_median_factor is -2"));
  EXPECT_THAT(message([](Options o) { o->objective.matching.kept_fraction = 0; }),
              HasSubstr("kept_fraction is 0"));
  EXPECT_THAT(message([](Options o) { o->T_initial = SE3d(Mat3::Identity(), Vec3(NAN, 0, 0)); }),
              HasSubstr("T_initial"));
  EXPECT_THAT(message([](Options o) { o->threads = 0; }), HasSubstr("threads is 0"));
  EXPECT_THAT(message([](Options o) { o->minimizer.free = {}; }), HasSubstr("No direction"));
  EXPECT_THAT(MessageOf<UsageError>(
                  [&] { Landscape(*source_, *target_, SE3d(Mat3::Identity(), Vec3(NAN, 0, 0))); }),
              HasSubstr("T_reference"));
}

// Clouds with an origin, and ones that lie far out without: poses are the user's.
TEST_F(Api, PosesAreInTheCoordinatesOfTheUser) {
  const Vec3 origin(458000, 5429000, 100);
  const SE3d G(Mat3::Identity(), origin);
  const RegisterResult near = Register(*source_, *target_);
  PointCloud source = *source_, target = *target_;
  source.origin = target.origin = origin;
  const RegisterResult far = Register(source, target);
  const SE3d expected = G * near.T_target_source * G.Inverse();
  const auto distance = [&](const SE3d& T) { return (T * origin - expected * origin).norm(); };
  EXPECT_LT(distance(far.T_target_source), 1e-7);
  EXPECT_LT(distance(far.iterates.back().T_target_source), 1e-7);
  EXPECT_EQ(far.cost, near.cost);
  RegisterOptions again;
  again.T_initial = expected;
  again.minimizer.max_iterations = 1;
  EXPECT_LT(distance(Register(source, target, again).iterates.front().T_target_source), 1e-7);
  // Whole multiples of 1/16 m do not change at 8 km.
  for (PointCloud* cloud : {&source, &target}) {
    cloud->origin = Vec3::Zero();
    for (float& x : cloud->x) {
      x = std::round(16 * x) / 16;
    }
  }
  const RegisterResult rounded = Register(source, target);
  for (PointCloud* cloud : {&source, &target}) {
    for (float& x : cloud->x) {
      x += 8192;
    }
  }
  const RegisterResult moved = Register(source, target);
  const SE3d by(Mat3::Identity(), Vec3(8192, 0, 0));
  const Vec3 there = by * Vec3(0, 0, 0);
  const SE3d conjugated = by * rounded.T_target_source * by.Inverse();
  EXPECT_LT((moved.T_target_source * there - conjugated * there).norm(), 1e-4);
  LandscapeOptions options;
  options.metrics = {"point_to_plane"};
  options.curve.samples = 2;
  const LandscapeResult curve = Landscape(source, target, conjugated, options);
  EXPECT_LT((curve.Pose(1) * there - conjugated * there).norm(), 1e-7);
  EXPECT_LT((curve.Pose(0) * there - there).norm(), 1e-7);
  PairCovarianceOptions covariance;
  covariance.metrics = {"point_to_plane"};
  const SE3d T = Covariance(source, target, covariance)[0].T_target_source;
  EXPECT_LT((T * there - conjugated * there).norm(), 1e-2);
}

}  // namespace
}  // namespace icpscape
