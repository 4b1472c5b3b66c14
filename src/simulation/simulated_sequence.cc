// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/simulation/simulated_sequence.h"

#include <functional>
#include <memory>
#include <mutex>
#include <utility>

#include "icpscape/simulation/drive.h"
#include "icpscape/simulation/random.h"
#include "icpscape/simulation/route.h"
#include "icpscape/simulation/scenes.h"
#include "icpscape/simulation/simulator.h"

namespace icpscape {
namespace {

// A simulator that is made with the first scan: a caller who asks only for poses does not pay for a
// world.
class LazySimulator {
 public:
  LazySimulator(std::function<World()> make_world, const LidarOptions& lidar, std::uint64_t seed)
      : make_world_(std::move(make_world)), lidar_(lidar), seed_(seed) {}

  const Simulator& Get() {
    std::call_once(once_, [this] {
      simulator_ = std::make_unique<const Simulator>(make_world_(), lidar_, seed_);
    });
    return *simulator_;
  }

 private:
  std::function<World()> make_world_;
  LidarOptions lidar_;
  std::uint64_t seed_;
  std::once_flag once_;
  std::unique_ptr<const Simulator> simulator_;
};

}  // namespace

ScanSequence SimulatedSequence(const std::string& scene, std::uint64_t seed,
                               const LidarOptions& lidar, int threads) {
  lidar.Check();
  ScanSequence sequence;
  sequence.title = "simulated " + scene + ", seed " + std::to_string(seed);
  sequence.place = scene;
  sequence.truth_is_exact = true;
  sequence.times_are_measured = true;
  sequence.times_from = "simulation";
  std::function<World()> make_world;
  double first_time_s = 0;
  if (scene == kTown) {
    sequence.T_world_lidar = ProjectToGround(TownRoute());
    make_world = [seed] { return MakeDrive(TownRoute(), MixKeys(seed, 1)).world; };
  } else {
    auto made = std::make_shared<Scene>(MakeScene(scene, seed));
    sequence.T_world_lidar.assign(made->T_world_lidar.begin(), made->T_world_lidar.end());
    make_world = [made] { return std::move(made->world); };
    first_time_s = -kScanPeriodS;
  }
  const auto simulator = std::make_shared<LazySimulator>(make_world, lidar, seed);
  const std::vector<LidarMotion> motions = MotionsThrough(sequence.T_world_lidar);
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const double since_start_s = static_cast<double>(i) * kScanPeriodS;
    const double time_s = first_time_s + since_start_s;  // Of the world, whose traffic moves.
    sequence.times_s.push_back(since_start_s);
    sequence.scans.push_back(
        {"scan " + std::to_string(i), "",
         [simulator, motion = motions[i], time_s, index = static_cast<int>(i), threads](
             DroppedPoints*) { return simulator->Get().Scan(motion, time_s, index, threads); }});
  }
  return sequence;
}

ScanPair SimulatePair(const std::string& scene, std::uint64_t seed, const LidarOptions& lidar,
                      int threads) {
  return SimulatedSequence(scene, seed, lidar, threads).Pair(2, 1);
}

}  // namespace icpscape
