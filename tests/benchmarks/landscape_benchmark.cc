// SPDX-License-Identifier: BSD-3-Clause
#include <gflags/gflags.h>

#include <memory>

#include "icpscape/landscape/curve.h"
#include "icpscape/objective/objective_set.h"
#include "tests/benchmarks/check.h"
#include "tests/benchmarks/comparison.h"
#include "tests/benchmarks/landscape_by_hand.h"
#include "tests/benchmarks/pcl_peer.h"
#include "tests/benchmarks/rows.h"

DEFINE_int32(naive_poses, 4,
             "Of the 100 poses of a landscape, how many the naive PCL loop is run at; its time is "
             "scaled up.");
DEFINE_int32(by_hand_poses, 20, "The same for the nanoflann loop.");

namespace icpscape {
namespace {

constexpr int kPoses = 100;

const std::vector<std::string> kClosestPoint = {"point_to_point", "point_to_plane", "symmetric"};
const std::vector<std::string> kFive = {"point_to_point", "point_to_plane", "symmetric",
                                        "edge_to_line", "planar_to_patch"};

// Curves of the metrics at all poses: trees, matches, values and slopes.
std::vector<Curve> OurCurves(const BenchmarkPair& pair, const std::vector<std::string>& metrics,
                             int threads) {
  const ObjectiveSet set(Prepared(pair, threads), metrics, ObjectiveSetOptions());
  CurveOptions options;
  options.samples = kPoses;
  options.threads = threads;
  return EvaluateCurves(set.objectives(), Path(SE3d(), *pair.T_ground_truth, PathKind::kLerpSlerp),
                        options);
}

// Some of those poses, in the middle of equal parts of the path.
struct Poses {
  Poses(const BenchmarkPair& pair, int count) {
    CurveOptions options;
    options.samples = kPoses;
    const Path path(SE3d(), *pair.T_ground_truth, PathKind::kLerpSlerp);
    for (int i = 0; i < count; ++i) {
      index.push_back((2 * i + 1) * kPoses / (2 * count));
      T.push_back(path.Pose(options.U(index.back())));
    }
  }

  // The curve's values there.
  std::vector<double> Rmse(const Curve& curve) const {
    std::vector<double> out;
    for (const int i : index) {
      out.push_back(curve.points[static_cast<std::size_t>(i)].rmse);
    }
    return out;
  }
  double Share() const { return static_cast<double>(index.size()) / kPoses; }
  std::string Title(const std::string& peer) const {
    return peer + " (at " + std::to_string(index.size()) + " of the poses, scaled)";
  }

  std::vector<int> index;
  std::vector<SE3d> T;
};

// The naive loop: PCL, one thread, one search per metric, point and pose.
void AddNaive(const BenchmarkPair& pair, const std::string& name, const std::string& title,
              const std::vector<std::string>& metrics, int rounds) {
  const auto curves = std::make_shared<std::vector<Curve>>();
  const auto theirs = std::make_shared<std::vector<std::vector<double>>>();
  const Poses poses(pair, FLAGS_naive_poses);
  const PclCloud target = MakePclCloud(pair.target);
  std::vector<PclCloud> sources;
  for (const std::string& metric : metrics) {
    sources.push_back(MakePclCloud(metric == "edge_to_line" ? pair.source.Select(pair.features.edge)
                                   : metric == "planar_to_patch"
                                       ? pair.source.Select(pair.features.planar)
                                       : pair.source));
  }
  Register({"landscape/" + name + "/t2/pcl_naive",
            title,
            true,
            {"icpscape", [=, &pair] { *curves = OurCurves(pair, metrics, 2); }},
            {poses.Title("PCL naive, 1 thread"),
             [=] {
               theirs->clear();
               for (std::size_t m = 0; m < metrics.size(); ++m) {
                 theirs->push_back(PclLandscape(metrics[m], sources[m], target, poses.T));
               }
             },
             poses.Share()},
            [=] {
              for (std::size_t m = 0; m < metrics.size(); ++m) {
                // Its clouds are moved in float, which lets a few fits change sides.
                const double tolerance = m < 3 ? 1e-5 : 1e-3;
                CheckValues("PCL naive, " + metrics[m], poses.Rmse((*curves)[m]), (*theirs)[m],
                            tolerance);
              }
            }},
           rounds);
}

void AddByHand(const BenchmarkPair& pair, int threads, int rounds) {
  const auto curves = std::make_shared<std::vector<Curve>>();
  const auto theirs = std::make_shared<std::vector<std::array<double, 3>>>();
  const Poses poses(pair, FLAGS_by_hand_poses);
  Register({"landscape/closest_point/" + ThreadsName(threads) + "/nanoflann_by_hand",
            "landscape, 3 closest-point metrics, 100 poses, " + ThreadsTitle(threads),
            threads == 2,
            {"icpscape", [=, &pair] { *curves = OurCurves(pair, kClosestPoint, threads); }},
            {poses.Title("nanoflann by hand, as many threads"),
             [=, &pair] { *theirs = LandscapeByHand(pair.source, pair.target, poses.T, threads); },
             poses.Share()},
            [=] {
              for (std::size_t m = 0; m < kClosestPoint.size(); ++m) {
                std::vector<double> values;
                for (const std::array<double, 3>& rmse : *theirs) {
                  values.push_back(rmse[m]);
                }
                // Of two equally near points nanoflann may take the other: as far, but with a
                // normal of its own.
                const double tolerance = kClosestPoint[m] == "point_to_point" ? 1e-9 : 1e-6;
                CheckValues("nanoflann by hand, " + kClosestPoint[m], poses.Rmse((*curves)[m]),
                            values, tolerance);
              }
            }},
           rounds);
}

void AddThreads(const BenchmarkPair& pair, const std::string& name, const std::string& title,
                const std::vector<std::string>& metrics, int rounds) {
  const auto two = std::make_shared<std::vector<Curve>>();
  const auto one = std::make_shared<std::vector<Curve>>();
  Register({"landscape/" + name + "/threads",
            title,
            true,
            {"icpscape", [=, &pair] { *two = OurCurves(pair, metrics, 2); }},
            {"icpscape, 1 thread", [=, &pair] { *one = OurCurves(pair, metrics, 1); }},
            [=, &pair] {
              for (std::size_t m = 0; m < metrics.size(); ++m) {
                const Poses all(pair, kPoses);
                CheckValues(metrics[m] + " on 1 thread", all.Rmse((*two)[m]), all.Rmse((*one)[m]),
                            0);
              }
            }},
           rounds);
}

}  // namespace

void RegisterLandscape(const BenchmarkPair& pair, int rounds) {
  const std::string three = "landscape, 3 closest-point metrics, 100 poses, 2 threads";
  const std::string five = "landscape, all five metrics of the paper, 100 poses, 2 threads";
  AddNaive(pair, "closest_point", three, kClosestPoint, rounds);
  AddByHand(pair, 2, rounds);
  AddByHand(pair, 1, rounds);
  AddNaive(pair, "five", five, kFive, rounds);
  AddThreads(pair, "closest_point", three, kClosestPoint, rounds);
  AddThreads(pair, "five", five, kFive, rounds);
}

}  // namespace icpscape
