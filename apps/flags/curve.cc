// SPDX-License-Identifier: BSD-3-Clause
#include "apps/flags/curve.h"

#include <gflags/gflags.h>

#include <cmath>

#include "apps/run/flag.h"
#include "apps/run/run_flags.h"
#include "icpscape/common/text.h"

static const icpscape::FlagGroup group(__FILE__, "Curve along the path");

DEFINE_double(u_min, -1, "First u: 0 is the start (--initial), 1 the reference (--reference).");
static const icpscape::FlagMark u_min_mark(&FLAGS_u_min, icpscape::kShown);
DEFINE_double(u_max, 2, "Last u.");
static const icpscape::FlagMark u_max_mark(&FLAGS_u_max, icpscape::kShown);
DEFINE_int32(samples, 100, "Poses along the path, both ends included.");
static const icpscape::FlagMark samples_mark(&FLAGS_samples, icpscape::kShown);
DEFINE_string(path, "lerp_slerp",
              "Path from start to reference: lerp_slerp (paper sec. 3.1), geodesic (constant twist "
              "in SE(3)) or bicycle (constant speed and steering).");
DEFINE_string(
    column, "rmse",
    "Column of the table that is drawn and whose minimum is printed: rmse "
    "(sqrt(eps / n), the paper's), rms_residual (sqrt(sum |r|^2 / n)), rmse_fixed_n (n of "
    "u = 1), epsilon, cost or inlier_ratio.");
static const icpscape::FlagMark column_mark(&FLAGS_column, icpscape::kShown);
DEFINE_string(patch_offset, "per_term",
              "Ones subtracted from planar_to_patch's sum: per_term, total (one) or none (paper "
              "sec. 4.2 allows the first two).");
DEFINE_string(
    association, "reassociate",
    "Pairs: reassociate (matched at every pose, as in ICP) or frozen (those of --frozen_u).");
static const icpscape::FlagMark association_mark(&FLAGS_association, icpscape::kShown);
DEFINE_double(frozen_u, 1, "With --association=frozen: u of the pose at which pairs are matched.");
static const icpscape::FlagMark frozen_u_mark(&FLAGS_frozen_u, icpscape::kShown);

namespace icpscape {
namespace {

bool IsFrozen() { return FLAGS_association == "frozen"; }

}  // namespace

CurveOptions CurveFromFlags() {
  RequireFlag(std::isfinite(FLAGS_frozen_u) && std::abs(FLAGS_frozen_u) <= 1e6, "frozen_u",
              Number(FLAGS_frozen_u), "a number of at most 1e6");
  RequireFlag(IsFrozen() || FLAGS_association == "reassociate", "association", FLAGS_association,
              "reassociate or frozen");
  CurveOptions options;
  options.u_min = FLAGS_u_min;
  options.u_max = FLAGS_u_max;
  options.samples = FLAGS_samples;
  options.threads = ThreadsFromFlags();
  options.patch_offset = FromName<PatchOffset>(FLAGS_patch_offset);
  if (IsFrozen()) {
    options.frozen_u = FLAGS_frozen_u;
  }
  options.Check();
  return options;
}

PathKind PathKindFromFlags() { return FromName<PathKind>(FLAGS_path); }

CurveColumn ColumnFromFlags() { return CurveColumnFromName(FLAGS_column); }

std::string AssociationText() {
  return IsFrozen() ? "matches frozen at u = " + Number(FLAGS_frozen_u)
                    : "re-associated at every pose";
}

void CheckCurveOfIterates() {
  RequireFlag(FLAGS_column == "rmse" || FLAGS_column == "cost", "column", FLAGS_column,
              "rmse or cost with --iterates");
  RequireFlag(!IsFrozen(), "association", FLAGS_association, "reassociate with --iterates");
  RequireFlag(FLAGS_patch_offset == "per_term", "patch_offset", FLAGS_patch_offset,
              "per_term with --iterates");
}

}  // namespace icpscape
