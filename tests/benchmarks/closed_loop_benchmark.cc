// SPDX-License-Identifier: BSD-3-Clause
#include <functional>
#include <memory>

#include "icpscape/cloud/normals.h"
#include "tests/benchmarks/check.h"
#include "tests/benchmarks/closed_loops.h"
#include "tests/benchmarks/comparison.h"
#include "tests/benchmarks/open3d_peer.h"
#include "tests/benchmarks/pcl_peer.h"
#include "tests/benchmarks/rows.h"

namespace icpscape {
namespace {

constexpr int kNeighbors = 20;
// All stop at steps of 1 mm, so they end within about as much of each other.
constexpr double kLimitM = 2e-3;
constexpr double kLimitDeg = 0.02;

// One comparison of RegisterOurs, or of it with the normals before, with another registration.
class Rows {
 public:
  Rows(const BenchmarkPair& pair, int rounds) : pair_(pair), rounds_(rounds) {}

  using Registration = std::function<LoopResult()>;

  void Add(const std::string& name, const std::string& title, const Registration& ours,
           const std::string& peer, const Registration& theirs,
           std::function<void(const LoopResult&, const LoopResult&)> check = nullptr) const {
    const auto our_result = std::make_shared<LoopResult>();
    const auto their_result = std::make_shared<LoopResult>();
    if (!check) {
      check = [peer](const LoopResult& a, const LoopResult& b) {
        CheckPoses(peer, a.T_target_source, b.T_target_source, kLimitM, kLimitDeg);
      };
    }
    Register({"closed_loop/" + name,
              title,
              true,
              {"icpscape", [=] { *our_result = ours(); }},
              {peer, [=] { *their_result = theirs(); }},
              [=] { check(*our_result, *their_result); }},
             rounds_);
  }

  Registration Ours(int threads) const {
    return [this_pair = &pair_, threads] {
      return RegisterOurs(this_pair->source, this_pair->target, threads);
    };
  }

  // The target's normals are part of the work.
  Registration OursWhole(int threads) const {
    const auto target = std::make_shared<PointCloud>(pair_.target);
    return [this_pair = &pair_, target, threads] {
      NeighborhoodOptions options;
      options.num_neighbors = kNeighbors;
      EstimateNormals(options, threads, target.get());
      return RegisterOurs(this_pair->source, *target, threads);
    };
  }

 private:
  const BenchmarkPair& pair_;
  int rounds_;
};

std::string LoopTitle(int threads) {
  return "point-to-plane registration, " + ThreadsTitle(threads);
}
std::string WholeTitle(int threads) {
  return "point-to-plane registration with the target's normals, " + ThreadsTitle(threads);
}

void AddPcl(const BenchmarkPair& pair, const Rows& rows) {
  const PclCloud source = MakePclCloud(pair.source);
  const PclCloud target = MakePclCloud(pair.target);
  const auto loop = [source](const PclCloud& with_normals) {
    return LoopResult{
        PclPointToPlane(source, with_normals, kLoopGateM, kLoopMinStepM, kLoopMinStepRad)};
  };
  rows.Add("t1/pcl", LoopTitle(1), rows.Ours(1), "PCL point-to-plane LLS",
           [=] { return loop(target); });
  rows.Add("whole/t1/pcl", WholeTitle(1), rows.OursWhole(1), "PCL",
           [=] { return loop(WithPclNormals(target, kNeighbors, 1)); });
}

// Open3D has no limit on steps: it is given as many iterations as it needs to come below ours.
int Open3dIterations(const Open3dCloud& source, const Open3dCloud& target) {
  SE3d T;
  for (int iterations = 1; iterations < kLoopMaxIterations; ++iterations) {
    const SE3d next = Open3dPointToPlane(source, target, kLoopGateM, T, {1}, 2);
    const SE3d step = T.Inverse() * next;
    T = next;
    if (step.t().norm() < kLoopMinStepM && step.LogRotation().norm() < kLoopMinStepRad) {
      return iterations;
    }
  }
  return kLoopMaxIterations;
}

void AddOpen3d(const BenchmarkPair& pair, const Rows& rows) {
  const Open3dCloud source = MakeOpen3dCloud(pair.source);
  const Open3dCloud target = MakeOpen3dCloud(pair.target);
  const auto iterations = std::make_shared<int>(0);  // Counted when first needed.
  const auto loop = [=](const Open3dCloud& with_normals, int threads) {
    if (*iterations == 0) {
      *iterations = Open3dIterations(source, target);
    }
    return LoopResult{
        Open3dPointToPlane(source, with_normals, kLoopGateM, SE3d(), {*iterations}, threads)};
  };
  for (const int threads : {1, 2}) {
    rows.Add(ThreadsName(threads) + "/open3d", LoopTitle(threads), rows.Ours(threads),
             "Open3D point-to-plane", [=] { return loop(target, threads); });
    rows.Add("whole/" + ThreadsName(threads) + "/open3d", WholeTitle(threads),
             rows.OursWhole(threads), "Open3D",
             [=] { return loop(WithOpen3dNormals(target, kNeighbors, threads), threads); });
  }
}

void AddOwn(const BenchmarkPair& pair, const Rows& rows) {
  for (const int threads : {1, 2}) {
    rows.Add(
        ThreadsName(threads) + "/by_hand", LoopTitle(threads), rows.Ours(threads),
        "Gauss-Newton by hand, our matcher",
        [=, &pair] { return RegisterByHand(pair.source, pair.target, threads); },
        [](const LoopResult& ours, const LoopResult& by_hand) {
          CheckPoses("by hand", ours.T_target_source, by_hand.T_target_source, kLimitM, kLimitDeg);
          if (ours.matching_passes > by_hand.matching_passes) {
            throw Mismatch("by hand: " + std::to_string(by_hand.matching_passes) +
                           " matching passes, ours " + std::to_string(ours.matching_passes) + ".");
          }
        });
  }
  rows.Add("t1/aloam_style", LoopTitle(1), rows.Ours(1), "A-LOAM style Ceres autodiff",
           [&pair] { return RegisterALoamStyle(pair.source, pair.target); });
  rows.Add(
      "threads", LoopTitle(2), rows.Ours(2), "icpscape, 1 thread", rows.Ours(1),
      [](const LoopResult& two, const LoopResult& one) {
        if (two.T_target_source.Matrix() != one.T_target_source.Matrix() || two.cost != one.cost) {
          throw Mismatch("1 thread: another result than with 2.");
        }
      });
}

}  // namespace

void RegisterClosedLoop(const BenchmarkPair& pair, int rounds) {
  const Rows rows(pair, rounds);
  AddPcl(pair, rows);
  if (!Open3dVersion().empty()) {
    AddOpen3d(pair, rows);
  }
  AddOwn(pair, rows);
}

}  // namespace icpscape
