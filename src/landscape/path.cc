// SPDX-License-Identifier: BSD-3-Clause
#include "src/landscape/path.h"

#include "src/common/error.h"
#include "src/common/text.h"

namespace icpscape {

const std::vector<std::string>& PathKindNames() {
  static const std::vector<std::string> names = {"lerp_slerp", "geodesic"};
  return names;
}

PathKind PathKindFromName(const std::string& name) {
  for (std::size_t i = 0; i < PathKindNames().size(); ++i) {
    if (name == PathKindNames()[i]) {
      return static_cast<PathKind>(i);
    }
  }
  throw UsageError("unknown path \"" + name + "\": expected one of " + Join(PathKindNames()) + ".");
}

Path::Path(const SE3d& T_0, const SE3d& T_1, PathKind kind)
    : kind_(kind), T_0_(T_0), T_1_(T_1), twist_((T_0.Inverse() * T_1).Log()) {}

SE3d Path::Pose(double u) const {
  if (kind_ == PathKind::kGeodesic) {
    return T_0_ * SE3d::Exp(u * twist_);
  }
  Vec6 rotation = Vec6::Zero();
  rotation.head<3>() = u * twist_.head<3>();
  return SE3d(T_0_.R() * SE3d::Exp(rotation).R(), (1 - u) * T_0_.t() + u * T_1_.t());
}

Vec6 Path::BodyTwist(double u) const {
  Vec6 xi = twist_;
  if (kind_ == PathKind::kLerpSlerp) {
    // omega is constant; the translation's velocity is constant in the target frame.
    xi.tail<3>() = Pose(u).R().transpose() * (T_1_.t() - T_0_.t());
  }
  return xi;
}

}  // namespace icpscape
