// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>
#include <gflags/gflags.h>
#include <glog/logging.h>

#include <iostream>

#include "apps/flags/pair.h"
#include "icpscape/common/error.h"
#include "icpscape/simd/level.h"
#include "tests/benchmarks/comparison.h"
#include "tests/benchmarks/rows.h"

DEFINE_int32(rounds, 7, "How often the sides of a comparison are timed in turn.");

namespace icpscape {
namespace {

// What the table needs to know besides the times.
void AddContext(const BenchmarkPair& pair) {
  benchmark::AddCustomContext("pair", pair.title);
  benchmark::AddCustomContext("source_points", std::to_string(pair.source.size()));
  benchmark::AddCustomContext("target_points", std::to_string(pair.target.size()));
  benchmark::AddCustomContext("simd", NameOf(ActiveSimdLevel()));
  benchmark::AddCustomContext("widest_simd", NameOf(SupportedSimdLevels().back()));
  benchmark::AddCustomContext("rounds", std::to_string(FLAGS_rounds));
  benchmark::AddCustomContext("icpscape", Version());
  benchmark::AddCustomContext("compiler", std::string("g++ ") + __VERSION__);
}

int Run() {
  const std::vector<std::string> metrics = {"symmetric", "edge_to_line", "planar_to_patch"};
  CheckPairFlags(metrics, true);
  Manifest manifest("benchmarks");
  const BenchmarkPair pair = LoadPair(metrics, &manifest);
  AddContext(pair);
  RegisterNeighborSearch(pair, FLAGS_rounds);
  RegisterNormals(pair, FLAGS_rounds);
  RegisterLandscape(pair, FLAGS_rounds);
  RegisterClosedLoop(pair, FLAGS_rounds);
  RegisterVoxelFilter(pair, FLAGS_rounds);
  benchmark::RunSpecifiedBenchmarks();
  if (AnyMismatch()) {
    std::cerr << "benchmarks: a comparison failed its check; see the errors above.\n";
    return 3;
  }
  return 0;
}

}  // namespace
}  // namespace icpscape

int main(int argc, char** argv) {
  google::InitGoogleLogging(argv[0]);
  FLAGS_logtostderr = true;
  benchmark::Initialize(&argc, argv);
  gflags::SetUsageMessage(
      "compares this library with its peers on one pair of scans, named as icpscape-landscape "
      "names it (--scene, or --kitti_root --sequence --frame --target_frame); takes Google "
      "Benchmark's flags as well. tools/benchmark.sh runs it on several.");
  gflags::ParseCommandLineFlags(&argc, &argv, true);
  try {
    return icpscape::Run();
  } catch (const icpscape::UsageError& error) {
    std::cerr << "benchmarks: " << error.what() << "\n";
    return 1;
  } catch (const std::exception& error) {
    std::cerr << "benchmarks: " << error.what() << "\n";
    return 2;
  }
}
