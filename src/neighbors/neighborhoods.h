// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_NEIGHBORS_NEIGHBORHOODS_H_
#define ICPSCAPE_SRC_NEIGHBORS_NEIGHBORHOODS_H_

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace icpscape {

/// What the neighbours of many queries look like, one array entry per query.
///
/// Coordinates are relative to the query and rounded to about 2^-24 of its neighbourhood's radius
/// (for up to 31 neighbours, one bit more for every four times as many);
/// beyond that nothing is rounded, so that the moments do not depend on the order in which
/// neighbours are found.
struct Neighborhoods {
  std::vector<std::int32_t> count;               ///< Neighbours.
  std::vector<std::int32_t> nearest;             ///< The nearest one's index, or -1.
  std::vector<float> farthest_squared_distance;  ///< Of all neighbours (m^2); 0 without any.
  std::vector<double> x, y, z;                   ///< Sums of the coordinates (m).
  std::vector<double> xx, xy, xz, yy, yz, zz;    ///< Sums of their products (m^2).

  std::size_t size() const { return count.size(); }
  void Resize(std::size_t size);

  /// From the query to the neighbours' mean (m).
  Eigen::Vector3d Mean(std::size_t i) const;
  /// Turns the sums of products into those about the mean: the scatter, count times covariance.
  void CenterProducts();
  Eigen::Matrix3d Products(std::size_t i) const;
};

/// Eigenvalues (m^2, ascending) of many matrices, and the unit eigenvectors of the first and last.
struct PrincipalAxes {
  std::vector<double> smallest, middle, largest;
  std::vector<double> smallest_x, smallest_y, smallest_z;
  std::vector<double> largest_x, largest_y, largest_z;

  /// Of neighborhoods.Products(i), by Jacobi rotations: accurate to a few ulp of the largest.
  void Compute(const Neighborhoods& neighborhoods);

  Eigen::Vector3d Smallest(std::size_t i) const {
    return {smallest_x[i], smallest_y[i], smallest_z[i]};
  }
  Eigen::Vector3d Largest(std::size_t i) const {
    return {largest_x[i], largest_y[i], largest_z[i]};
  }
};

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_NEIGHBORS_NEIGHBORHOODS_H_
