// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>
#include <gflags/gflags.h>
#include <glog/logging.h>

#include <cmath>
#include <functional>
#include <iostream>

#include "apps/flags/pair.h"
#include "icpscape/cloud/normals.h"
#include "icpscape/common/error.h"
#include "icpscape/common/text.h"
#include "icpscape/landscape/curve.h"
#include "icpscape/objective/objective_set.h"
#include "icpscape/simd/level.h"
#include "tests/benchmarks/closed_loops.h"
#include "tests/benchmarks/nanoflann_peer.h"
#include "tests/benchmarks/nearest.h"
#include "tests/benchmarks/peak_memory.h"

DEFINE_string(poses, "10", "Numbers of poses of the landscapes, with commas.");

namespace icpscape {
namespace {

// Times the work, and counts the memory that it needs beside the clouds.
void Add(const std::string& name, int threads, int poses, const std::function<void()>& work) {
  benchmark::RegisterBenchmark(name.c_str(),
                               [=](benchmark::State& state) {
                                 const PeakMemory memory;
                                 work();
                                 state.counters["peak_mb"] = memory.Mb();
                                 state.counters["threads"] = threads;
                                 state.counters["poses"] = poses;
                                 state.SetLabel(name);
                                 for (auto _ : state) {
                                   work();
                                 }
                               })
      ->UseRealTime()
      ->Unit(benchmark::kMillisecond);
}

std::vector<int> PosesFromFlags() {
  std::vector<int> poses;
  for (const std::string& text : Split(FLAGS_poses)) {
    const double value = ParseNumber(text);
    if (!(value >= 2 && value <= 1e6) || value != std::floor(value)) {
      throw UsageError("--poses=" + FLAGS_poses + ": expected whole numbers from 2 to 1e6.");
    }
    poses.push_back(static_cast<int>(value));
  }
  return poses;
}

void AddLandscape(const BenchmarkPair& pair, int poses, int threads) {
  Add("landscape", threads, poses, [&pair, poses, threads] {
    const ObjectiveSet set(Prepared(pair, threads),
                           {"point_to_point", "point_to_plane", "symmetric"},
                           ObjectiveSetOptions());
    CurveOptions options;
    options.samples = poses;
    options.threads = threads;
    EvaluateCurves(set.objectives(), Path(SE3d(), *pair.T_ground_truth, PathKind::kLerpSlerp),
                   options);
  });
}

void AddAll(const BenchmarkPair& pair) {
  const auto tree = std::make_shared<NeighborSearch>(pair.target.View());
  const auto nanoflann = std::make_shared<NanoflannTree>(pair.target);
  const auto queries = std::make_shared<PointCloud>(
      Reordered(pair.source, NeighborSearch(pair.source.View()).Order()));
  const auto result = std::make_shared<NearestResult>(queries->size());
  Add("tree", 1, 0, [&pair] { const NeighborSearch search(pair.target.View()); });
  for (const int threads : {1, 2}) {
    Add("nearest", threads, 0, [=] { NearestOfAll(*tree, *queries, threads, result.get()); });
    Add("nanoflann", threads, 0,
        [=, &pair] { nanoflann->Nearest(pair.source, threads, result.get()); });
    Add("normals", threads, 0, [&pair, threads] {
      PointCloud cloud = pair.target;
      EstimateNormals(NeighborhoodOptions(), threads, &cloud);
    });
    Add("register", threads, 0,
        [&pair, threads] { RegisterOurs(pair.source, pair.target, threads); });
    for (const int poses : PosesFromFlags()) {
      AddLandscape(pair, poses, threads);
    }
  }
}

void Run() {
  CheckPairFlags({"symmetric"}, true);
  PosesFromFlags();
  Manifest manifest("scaling");
  const BenchmarkPair pair = LoadPair({"symmetric"}, &manifest);
  benchmark::AddCustomContext("source_points", std::to_string(pair.source.size()));
  benchmark::AddCustomContext("target_points", std::to_string(pair.target.size()));
  benchmark::AddCustomContext("widest_simd", NameOf(ActiveSimdLevel()));
  benchmark::AddCustomContext("icpscape", Version());
  benchmark::AddCustomContext("compiler", std::string("g++ ") + __VERSION__);
  AddAll(pair);
  benchmark::RunSpecifiedBenchmarks();
}

}  // namespace
}  // namespace icpscape

int main(int argc, char** argv) {
  google::InitGoogleLogging(argv[0]);
  FLAGS_logtostderr = true;
  benchmark::Initialize(&argc, argv);
  gflags::SetUsageMessage(
      "times this library on one pair of scans on one and two threads, and counts its memory; "
      "takes "
      "Google Benchmark's flags as well. tools/benchmark.sh --scaling runs it on pairs of growing "
      "size.");
  gflags::ParseCommandLineFlags(&argc, &argv, true);
  try {
    icpscape::Run();
    return 0;
  } catch (const icpscape::UsageError& error) {
    std::cerr << "scaling: " << error.what() << "\n";
    return 1;
  } catch (const std::exception& error) {
    std::cerr << "scaling: " << error.what() << "\n";
    return 2;
  }
}
