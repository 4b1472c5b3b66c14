// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/verdict/named_directions.h"

#include <Eigen/SVD>
#include <array>
#include <cstdio>
#include <map>

namespace icpscape {
namespace {

using Basis = Eigen::Matrix<double, 6, Eigen::Dynamic>;

constexpr std::array<const char*, 6> kAxes = {"roll",    "pitch",   "yaw",
                                              "along x", "along y", "along z"};
// How much of an axis, squared, must lie in the subspace for its name to stand for it.
constexpr double kNamedShare = 0.9;
// From what share of a direction, squared, its rotation or translation is mentioned.
constexpr double kMentionedShare = 0.1;

std::string Components(const char* preposition, Vec3 direction) {
  direction.normalize();
  // One of the two signs: the largest component is positive.
  Eigen::Index largest = 0;
  direction.cwiseAbs().maxCoeff(&largest);
  direction *= direction[largest] < 0 ? -1 : 1;
  direction = (direction.array().abs() < 5e-3).select(0, direction);  // No "-0.00".
  char text[64];
  std::snprintf(text, sizeof text, "%s (%.2f, %.2f, %.2f)", preposition, direction.x(),
                direction.y(), direction.z());
  return text;
}

std::string InComponents(const Vec6& direction) {
  const Vec3 rotation = direction.head<3>();
  const Vec3 translation = direction.tail<3>();
  std::string words;
  if (rotation.squaredNorm() > kMentionedShare) {
    words = Components("about", rotation);
  }
  if (translation.squaredNorm() > kMentionedShare) {
    words += (words.empty() ? "" : " with ") + Components("along", translation);
  }
  return words;
}

// The subspace without one of its unit vectors.
Basis Without(const Basis& basis, const Vec6& held) {
  const Basis rest = basis - held * (held.transpose() * basis);
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(rest, Eigen::ComputeThinU);
  return svd.matrixU().leftCols(basis.cols() - 1);
}

}  // namespace

std::vector<NamedDirection> NameDirections(const Basis& basis) {
  std::map<Eigen::Index, NamedDirection> axes;
  Basis rest = basis;
  while (rest.cols() > 0) {
    Eigen::Index axis = 0;
    if (rest.rowwise().squaredNorm().maxCoeff(&axis) < kNamedShare) {
      break;
    }
    const Vec6 held = (rest * rest.row(axis).transpose()).normalized();
    axes[axis] = {held, kAxes[static_cast<std::size_t>(axis)]};
    rest = Without(rest, held);
  }
  std::vector<NamedDirection> directions;
  for (const auto& [axis, named] : axes) {
    directions.push_back(named);
  }
  for (Eigen::Index k = 0; k < rest.cols(); ++k) {
    directions.push_back({rest.col(k), InComponents(rest.col(k))});
  }
  return directions;
}

}  // namespace icpscape
