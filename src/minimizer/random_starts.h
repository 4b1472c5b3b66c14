// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_MINIMIZER_RANDOM_STARTS_H_
#define ICPSCAPE_SRC_MINIMIZER_RANDOM_STARTS_H_

#include <cmath>
#include <functional>
#include <vector>

#include "icpscape/minimizer/minimizer.h"

namespace icpscape {

/// A registration succeeds when it ends this close to the reference, in metres of the source's
/// centroid.
inline constexpr double kSuccessM = 0.05;
inline constexpr double kSuccessRad = 0.25 * M_PI / 180;

struct RandomStartOptions {
  int count = 100;
  double translation_m = 0.5;  ///< Longest translation of a start.
  double rotation_rad = 0.05;  ///< Largest rotation of a start.
  unsigned seed = 1;
  MinimizerOptions minimizer;
};

struct StartResult {
  /// Distances of the start and of the result from the reference; metres of the source's centroid.
  double start_m = 0, start_rad = 0;
  double end_m = 0, end_rad = 0;
  int iterations = 0;
  Termination termination = Termination::kFailure;
  bool success = false;
};

/// The start poses: T_reference Exp([omega; v - omega x c]), which turns about the point c of the
/// source's frame, with directions of omega and v uniform on the sphere and lengths uniform up to
/// the limits, without the directions that minimizer.free excludes; the same for the same seed on
/// every machine.
std::vector<SE3d> RandomStarts(const SE3d& T_reference, const Vec3& c,
                               const RandomStartOptions& options);

/// A closed loop from this start: Minimize, or Registration::Run.
using LoopFrom =
    std::function<MinimizerSummary(const SE3d& T_start, const MinimizerOptions& options)>;

/// Runs the loop from every start about the point c of the source's frame, in parallel over starts,
/// each on one thread; results in the order of RandomStarts. `progress` (if any) is called with the
/// number done, one call at a time.
std::vector<StartResult> RunRandomStarts(const LoopFrom& loop, const SE3d& T_reference,
                                         const Vec3& c, const RandomStartOptions& options,
                                         const std::function<void(int)>& progress = nullptr);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_MINIMIZER_RANDOM_STARTS_H_
