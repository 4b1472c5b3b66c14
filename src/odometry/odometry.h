// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_ODOMETRY_ODOMETRY_H_
#define ICPSCAPE_SRC_ODOMETRY_ODOMETRY_H_

#include <optional>
#include <string>
#include <vector>

#include "icpscape/common/names.h"
#include "icpscape/filtering/filter_chain.h"
#include "icpscape/minimizer/minimizer.h"
#include "icpscape/objective/objective_set.h"
#include "icpscape/odometry/adaptive_gate.h"
#include "icpscape/odometry/local_map.h"
#include "icpscape/odometry/motion_model.h"
#include "icpscape/verdict/verdict.h"

namespace icpscape {

/// What a scan is registered to.
enum class OdometryMode {
  kScanToScan,  ///< The scan before it [paper sec. 1].
  kScanToMap,   ///< A map of the scans before it.
  kTwoStage,    ///< The scan before it, and every few scans that result to the map [LOAM].
};
template <>
struct Names<OdometryMode> {
  static constexpr const char* kWhat = "odometry mode";
  static constexpr const char* kNames[] = {"scan_to_scan", "scan_to_map", "two_stage"};
};

/// Which scans are de-skewed; see Deskew.
enum class Deskewing {
  kAuto,  ///< Those whose points have times.
  kOn,    ///< All; a scan without times is refused.
  kOff,
};
template <>
struct Names<Deskewing> {
  static constexpr const char* kWhat = "de-skewing";
  static constexpr const char* kNames[] = {"auto", "on", "off"};
};

struct OdometryOptions {
  OdometryMode mode = OdometryMode::kScanToMap;
  std::vector<std::string> metrics = {"point_to_plane"};
  std::vector<double> weights;  ///< One per metric; empty: 1 each.
  PreparationOptions preparation;
  FilterOptions filters;  ///< They use the predicted pose.
  ObjectiveSetOptions objective;
  MinimizerOptions minimizer;
  LocalMapOptions map;
  /// Tolerances of the verdicts; the rest of it is as the loop has it.
  VerdictOptions verdict;
  int map_every = 10;  ///< kTwoStage: a mapping step every so many scans.
  /// The predicted pose is the motion of the scan before, for the time since then (see
  /// MotionModel); else the identity.
  bool constant_velocity = true;
  /// If positive: the gate follows from the errors of the predicted poses, and this is the assumed
  /// error of the first (m); see AdaptiveGate.
  double adaptive_gate_m = 0;
  Deskewing deskew = Deskewing::kAuto;
  /// Whether the times of scans are seconds, as those of points are. Else they only count periods
  /// of kScanPeriodS, and the turn that a scan comes from is taken to last one.
  bool times_are_measured = true;
  int threads = 1;

  /// Throws UsageError where options cannot go together.
  void Check() const;
};

/// What became of one scan.
struct FrameResult {
  SE3d T_world_lidar;  ///< The world is the first scan's frame.
  /// Motion since the scan before, T_previous_current, as the predictor takes it: in kTwoStage
  /// before the map's correction.
  SE3d motion;
  /// Whether a stage had an answer. False for the first scan, and where the predicted motion was
  /// taken.
  bool registered = false;
  /// Whether it was lost from the predicted pose, and found from another start.
  bool recovered = false;
  bool deskewed = false;  ///< Whether its points had times by which they were moved.
  Termination termination = Termination::kFailure;
  bool converged = false;  ///< Of the last stage; see Verdict.
  /// Directions that the objective does not see, whatever the tolerance: there the predicted motion
  /// was taken. Of the last stage, as the next.
  int predicted_directions = 0;
  int uncertain_directions = 0;  ///< Directions whose predicted deviation is beyond the tolerance.
  int iterations = 0;            ///< Of all stages.
  long n = 0;                    ///< Pairs of the last stage, at its end.
  double rmse = 0;               ///< Of the last stage, at its end.
  double gate_m = 0;             ///< Longest distance of a pair; 0 is no limit.
  std::size_t points = 0;        ///< After preparation.
  std::size_t map_points = 0;    ///< Of the map that it was registered to; 0 without one.
};

/// Lidar odometry: feeds scans one after the other through preparation, filters and the closed
/// loop [paper fig. 1], starting each registration from the motion before. A scan that cannot be
/// registered (no pair is left, fewer rows than directions, the loss is flat) gets the predicted
/// motion and is left out of the map, and the next scan is not registered to it. Directions that a
/// registration does not see (JudgePose over at most kJudgedPoints points) get the predicted
/// motion. A scan that ended at the limit of steps is left out of the map as well.
///
/// A scan is lost where it has no pose, or an RMSE beyond five times that of the last scan that
/// converged, or beyond twice that where it ended at the limit. It is then registered again from
/// another start (FindStart; not with metrics of edge and planar points), and that pose is taken
/// where it converges. Bit-identical for any number of threads.
///
/// Scans whose points have times are de-skewed by the velocity of the motion before. The first two
/// have none before them: they are registered as they are, and once more after both were de-skewed
/// by the velocity that this gave; for the map, by the one that was found then.
class Odometry {
 public:
  /// Throws UsageError.
  explicit Odometry(OdometryOptions options);
  ~Odometry();

  /// Registers the next scan, which was taken at `time_s`; the time of scans that have none is
  /// taken to pass evenly. Throws InputError where the first scan cannot be prepared (see Prepare),
  /// since then no other will be. A later one that cannot counts as empty. Throws UsageError where
  /// the time is not after that of the scan before.
  FrameResult Add(PointCloud scan, std::optional<double> time_s = std::nullopt);

  /// Takes over what Add returned for the next scan in an earlier run, without registering it:
  /// afterwards the state is bit for bit the one after Add.
  void Replay(PointCloud scan, const FrameResult& result,
              std::optional<double> time_s = std::nullopt);

  /// Number of scans so far.
  int size() const { return size_; }
  /// The last scan that was registered, as it was; null before the first.
  const PreparedScan* last_scan() const { return last_ ? &*last_ : nullptr; }

 private:
  PreparedScan PrepareOrEmpty(PointCloud scan, const Vec6& velocity) const;
  bool IsSkewed(const PointCloud& scan) const;
  Vec6 SweepVelocity(const PointCloud& scan, const SE3d& motion, double span_s) const;
  void DeskewFirst(const SE3d& motion, double span_s);
  struct Registration;
  Registration Register(const MetricClouds& source, const MetricClouds& target,
                        const SE3d& T_predicted, const SE3d& T_still) const;
  Registration Register(const PreparedPair& scans, const SE3d& T_predicted,
                        const SE3d& T_still) const;
  bool IsLost(const MinimizerSummary& summary) const;
  Registration RegisterToMap(const PreparedScan& source, const SE3d& T_predicted,
                             FrameResult* result) const;
  ObjectiveSetOptions ObjectiveOptions() const;
  bool MapsNow() const;
  FrameResult RegisterNext(const PreparedScan& current, const SE3d& predicted_motion) const;
  SE3d PredictedMotion(std::optional<double> time_s) const;
  void Finish(PreparedScan scan, const FrameResult& result, std::optional<double> time_s);

  OdometryOptions options_;
  unsigned needs_ = 0;
  int size_ = 0;
  std::optional<PreparedScan> last_;  // The last that was registered.
  SE3d T_last_previous_;              // From it to the last of all.
  SE3d T_world_last_;                 // Of the last of all, as the next.
  MotionModel motion_;
  std::optional<PointCloud> first_;   // Until the second, if its points have times.
  std::optional<double> usual_rmse_;  // Of the last scan that converged, at most doubled.
  AdaptiveGate gate_;
  LocalMap map_;
};

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_ODOMETRY_ODOMETRY_H_
