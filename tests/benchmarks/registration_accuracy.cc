// SPDX-License-Identifier: BSD-3-Clause
#include <gflags/gflags.h>
#include <glog/logging.h>

#include <chrono>
#include <cmath>
#include <iostream>
#include <utility>

#include "icpscape/cloud/displacement.h"
#include "icpscape/common/error.h"
#include "icpscape/common/parallel.h"
#include "icpscape/filtering/voxel_filter.h"
#include "icpscape/minimizer/random_starts.h"
#include "tests/benchmarks/accuracy_methods.h"
#include "tests/benchmarks/accuracy_pairs.h"
#include "tests/benchmarks/accuracy_table.h"

DEFINE_string(kitti_root, "", "KITTI's odometry data; without it its pairs are left out.");
DEFINE_string(small_gicp, "", "Folder of small_gicp's pair; without it the pair is left out.");
DEFINE_int32(wide, 20, "Number of wide pairs of the simulated town.");
DEFINE_int32(starts, 200, "Number of random starts on each of some pairs.");
DEFINE_int32(peer_starts, 20, "How many of them the peers get.");
DEFINE_int32(seed, 1, "Of the town, the drawn pairs and the starts.");
DEFINE_int32(jobs, 2, "How many registrations run at a time, each on one thread.");

namespace icpscape {
namespace {

// Users of PCL and Open3D thin lidar scans to about this.
constexpr double kVoxelM = 0.25;
constexpr double kStartM = 2, kStartRad = 20 * M_PI / 180;
constexpr double kMostWideM = 0.03;

// One registration that every method tries.
struct Task {
  const AccuracyPair* pair;
  SE3d T_start;
};

std::vector<AccuracyPair> Thinned(std::vector<AccuracyPair> pairs) {
  for (AccuracyPair& pair : pairs) {
    pair.source = VoxelFilter(pair.source, kVoxelM);
    pair.target = VoxelFilter(pair.target, kVoxelM);
  }
  return pairs;
}

Attempt Try(const AccuracyMethod& method, const Task& task) {
  const AccuracyPair& pair = *task.pair;
  const auto start = std::chrono::steady_clock::now();
  const SE3d T = method.run(pair.source, pair.target, task.T_start);
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  const Displacement off = DisplacementAt(CentroidOf(pair.source), pair.T_truth.Inverse() * T);
  return {off.m, off.rad * 180 / M_PI, time.count()};
}

void Add(const std::vector<AccuracyMethod>& methods, bool ours, const std::vector<Task>& tasks,
         std::size_t count, AccuracySet* set) {
  for (const AccuracyMethod& method : methods) {
    MethodAttempts result = {method.name, ours, {}};
    result.attempts.resize(std::min(count, tasks.size()));
    ParallelFor(result.attempts.size(), FLAGS_jobs,
                [&](std::size_t i) { result.attempts[i] = Try(method, tasks[i]); });
    set->methods.push_back(std::move(result));
  }
}

// From the identity.
std::vector<Task> OnceEach(const std::vector<AccuracyPair>& pairs, AccuracySet* set) {
  std::vector<Task> tasks;
  for (const AccuracyPair& pair : pairs) {
    tasks.push_back({&pair, SE3d()});
    set->truth_m = std::max(set->truth_m, pair.truth_m);
    set->truth_deg = std::max(set->truth_deg, pair.truth_deg);
  }
  return tasks;
}

// All points for ours; fewer for ours and the peers.
bool CompareOnPairs(const std::string& title, const std::vector<AccuracyPair>& pairs, bool list,
                    double most_m) {
  bool met = true;
  for (const bool thin : {false, true}) {
    AccuracySet set;
    set.title = title + (thin ? ", voxels of 0.25 m" : ", all points");
    set.most_m = most_m;
    const std::vector<AccuracyPair> clouds = thin ? Thinned(pairs) : pairs;
    const std::vector<Task> tasks = OnceEach(clouds, &set);
    for (const AccuracyPair& pair : clouds) {
      if (list) {
        set.names.push_back(pair.name);
      }
    }
    Add(OurMethods(), true, tasks, tasks.size(), &set);
    if (thin) {
      Add(PeerMethods(), false, tasks, tasks.size(), &set);
    }
    met = PrintAccuracy(set) && met;
  }
  return met;
}

bool CompareFromStarts(const AccuracyPair& pair) {
  const std::vector<AccuracyPair> clouds = Thinned({pair});
  RandomStartOptions options;
  options.count = FLAGS_starts;
  options.translation_m = kStartM;
  options.rotation_rad = kStartRad;
  options.seed = static_cast<unsigned>(FLAGS_seed);
  AccuracySet set;
  set.title = std::to_string(FLAGS_starts) + " random starts on " + pair.name;
  set.truth_m = pair.truth_m;
  set.truth_deg = pair.truth_deg;
  std::vector<Task> tasks;
  for (const SE3d& T : RandomStarts(pair.T_truth, CentroidOf(clouds[0].source), options)) {
    tasks.push_back({&clouds[0], T});
  }
  Add(OurMethods(), true, tasks, tasks.size(), &set);
  Add(PeerMethods(), false, tasks, static_cast<std::size_t>(FLAGS_peer_starts), &set);
  return PrintAccuracy(set);
}

bool Compare() {
  const auto seed = static_cast<unsigned>(FLAGS_seed);
  std::vector<AccuracyPair> real;
  if (!FLAGS_small_gicp.empty()) {
    real.push_back(SmallGicpPair(FLAGS_small_gicp));
  }
  if (!FLAGS_kitti_root.empty()) {
    for (AccuracyPair& pair : KittiPairs(FLAGS_kitti_root, FLAGS_jobs)) {
      real.push_back(std::move(pair));
    }
  }
  bool met = true;
  if (!real.empty()) {
    met = CompareOnPairs("Pairs of real scans", real, true, 0) && met;
  }
  if (FLAGS_wide > 0) {
    met = CompareOnPairs("Wide pairs of the simulated town",
                         WideTownPairs(FLAGS_wide, seed, FLAGS_jobs), false, kMostWideM) &&
          met;
  }
  if (FLAGS_starts > 0) {
    met = CompareFromStarts(TownStep(seed, FLAGS_jobs)) && met;
    for (const AccuracyPair& pair : real) {
      if (pair.name == "small_gicp" || pair.name == "KITTI 00/95") {
        met = CompareFromStarts(pair) && met;
      }
    }
  }
  return met;
}

void CheckFlags() {
  if (FLAGS_wide < 0 || FLAGS_starts < 0 || FLAGS_peer_starts < 1 || FLAGS_seed < 0 ||
      FLAGS_jobs < 1) {
    throw UsageError(
        "--wide, --starts and --seed are 0 or more, --peer_starts and --jobs 1 or more.");
  }
}

}  // namespace
}  // namespace icpscape

int main(int argc, char** argv) {
  google::InitGoogleLogging(argv[0]);
  FLAGS_logtostderr = true;
  gflags::SetUsageMessage(
      "compares --preset=robust with other settings of ours, and with ICP and GICP of PCL and "
      "Open3D, on pairs of scans whose motion is known. Exit code 3: robust misses a bar.");
  gflags::ParseCommandLineFlags(&argc, &argv, true);
  try {
    icpscape::CheckFlags();
    return icpscape::Compare() ? 0 : 3;
  } catch (const icpscape::UsageError& error) {
    std::cerr << "registration_accuracy: " << error.what() << "\n";
    return 1;
  } catch (const std::exception& error) {
    std::cerr << "registration_accuracy: " << error.what() << "\n";
    return 2;
  }
}
