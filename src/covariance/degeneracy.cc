// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/covariance/degeneracy.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "icpscape/cloud/displacement.h"
#include "icpscape/common/error.h"
#include "icpscape/common/text.h"
#include "icpscape/objective/pairs.h"

namespace icpscape {
namespace {

// X-ICP's numbers.
const double kNoise = std::cos(80 * M_PI / 180);
const double kStrong = std::cos(45 * M_PI / 180);
constexpr double kFullCombined = 250;  // kappa_1
constexpr double kFullStrong = 180;    // kappa_2, and of partial, combined.
constexpr double kPartialStrong = 35;  // kappa_3

constexpr double kDcregCondition = 10;

// A direction of only rotation or only translation.
Vec6 Embed(const Vec3& direction, bool rotation) {
  Vec6 embedded = Vec6::Zero();
  embedded.segment<3>(rotation ? 0 : 3) = direction;
  return embedded;
}

Mat3 PseudoInverse(const Mat3& symmetric) {
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(symmetric);
  Vec3 inverse = Vec3::Zero();
  for (int i = 0; i < 3; ++i) {
    if (solver.eigenvalues()[i] > 1e-12 * solver.eigenvalues()[2]) {
      inverse[i] = 1 / solver.eigenvalues()[i];
    }
  }
  return solver.eigenvectors() * inverse.asDiagonal() * solver.eigenvectors().transpose();
}

}  // namespace

Mat6 HessianAbout(const Vec3& c, double lever_m, const Mat6& hessian) {
  const Mat6 from = AboutPoint(c, lever_m).inverse();
  return from.transpose() * hessian * from;
}

EigenDirections EigenDirectionsOf(const Mat6& hessian, const Vec3& c, double length_scale_m) {
  if (!(length_scale_m > 0) || !std::isfinite(length_scale_m)) {
    throw UsageError("length_scale_m=" + Number(length_scale_m) + ": expected a positive length.");
  }
  const Eigen::SelfAdjointEigenSolver<Mat6> solver(HessianAbout(c, length_scale_m, hessian));
  return {length_scale_m, solver.eigenvalues(), solver.eigenvectors()};
}

std::vector<PlaneConstraint> PlaneConstraintsOf(const Objective& objective, const SE3d& T,
                                                const Matches& matches) {
  const bool normals = (objective.needs() & kTargetNormal) != 0;
  const bool patches = (objective.needs() & kTargetPatch) != 0;
  std::vector<PlaneConstraint> constraints;
  if (normals || patches) {
    const Mat3 R_source_target = T.R().transpose();
    ForEachPair(objective, matches, [&](std::size_t, std::size_t, const Correspondence& pair) {
      constraints.push_back(
          {pair.p_source, R_source_target * (normals ? pair.n_target : pair.n_patch)});
    });
  }
  return constraints;
}

std::vector<Judgement> JudgeEigenvalues(const std::string& rule, const std::string& source,
                                        const Mat6& hessian, double threshold) {
  const EigenDirections eigen = EigenDirectionsOf(hessian, Vec3::Zero(), 1);
  std::vector<Judgement> judgements;
  for (int j = 0; j < 6; ++j) {
    const double value = eigen.eigenvalues[j];
    judgements.push_back({rule, source, eigen.directions.col(j), value, threshold,
                          value < threshold ? Localizability::kNone : Localizability::kFull});
  }
  return judgements;
}

std::vector<Judgement> JudgeXicp(const Mat6& hessian, const std::vector<PlaneConstraint>& pairs) {
  Vec3 centroid = Vec3::Zero();
  for (const PlaneConstraint& pair : pairs) {
    centroid += pair.p_source / static_cast<double>(pairs.size());
  }
  std::vector<Judgement> judgements;
  for (const bool rotation : {true, false}) {
    const int corner = rotation ? 0 : 3;
    const Eigen::SelfAdjointEigenSolver<Mat3> solver(Mat3(hessian.block<3, 3>(corner, corner)));
    Vec3 combined = Vec3::Zero();
    Vec3 strong = Vec3::Zero();
    for (const PlaneConstraint& pair : pairs) {
      const Vec3 f = rotation ? (pair.p_source - centroid).cross(pair.n_source).normalized().eval()
                              : pair.n_source;
      for (int j = 0; j < 3; ++j) {
        const double contribution = std::abs(f.dot(solver.eigenvectors().col(j)));
        combined[j] += contribution >= kNoise ? contribution : 0;
        strong[j] += contribution >= kStrong ? contribution : 0;
      }
    }
    for (int j = 0; j < 3; ++j) {
      Localizability category = Localizability::kNone;
      if (combined[j] >= kFullCombined || strong[j] >= kFullStrong) {
        category = Localizability::kFull;
      } else if (combined[j] >= kFullStrong || strong[j] >= kPartialStrong) {
        category = Localizability::kPartial;
      }
      judgements.push_back({"x_icp", "Tuna et al. 2024",
                            Embed(solver.eigenvectors().col(j), rotation), combined[j], kFullStrong,
                            category});
    }
  }
  return judgements;
}

std::vector<Judgement> JudgeDcreg(const Mat6& hessian) {
  std::vector<Judgement> judgements;
  for (const bool rotation : {true, false}) {
    const int own = rotation ? 0 : 3;
    const int other = 3 - own;
    const Mat3 coupling = hessian.block<3, 3>(own, other);
    const Mat3 schur =
        hessian.block<3, 3>(own, own) -
        coupling * PseudoInverse(hessian.block<3, 3>(other, other)) * coupling.transpose();
    const Eigen::SelfAdjointEigenSolver<Mat3> solver(schur);
    for (int j = 0; j < 3; ++j) {
      // Rounding can make a 0 negative.
      const double eigenvalue = std::max(solver.eigenvalues()[j], 0.0);
      const double condition = eigenvalue > 0 ? solver.eigenvalues()[2] / eigenvalue
                                              : std::numeric_limits<double>::infinity();
      judgements.push_back(
          {"dcreg", "Hu et al. 2025", Embed(solver.eigenvectors().col(j), rotation), condition,
           kDcregCondition,
           condition > kDcregCondition ? Localizability::kNone : Localizability::kFull});
    }
  }
  return judgements;
}

std::vector<Judgement> JudgeDegeneracy(const Mat6& hessian,
                                       const std::vector<PlaneConstraint>& pairs) {
  std::vector<Judgement> all =
      JudgeEigenvalues("loam_odometry", "Zhang et al. 2016; loam_velodyne; LeGO-LOAM", hessian,
                       kLoamOdometryThreshold);
  const auto append = [&](const std::vector<Judgement>& judgements) {
    all.insert(all.end(), judgements.begin(), judgements.end());
  };
  append(JudgeEigenvalues("loam_mapping", "Zhang et al. 2016; loam_velodyne; LIO-SAM", hessian,
                          kLoamMappingThreshold));
  if (!pairs.empty()) {
    append(JudgeXicp(hessian, pairs));
  }
  append(JudgeDcreg(hessian));
  return all;
}

}  // namespace icpscape
