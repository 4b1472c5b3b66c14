// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_COVARIANCE_CONSISTENCY_H_
#define ICPSCAPE_SRC_COVARIANCE_CONSISTENCY_H_

#include <vector>

#include "icpscape/residuals/lie.h"

namespace icpscape {

/// Mean, spread and bias of errors xi_i, i = 1 .. N.
struct ErrorStatistics {
  long n = 0;
  Vec6 mean = Vec6::Zero();            ///< The bias, where the xi_i are errors about the truth.
  Mat6 covariance = Mat6::Zero();      ///< With N - 1.
  Vec6 deviation = Vec6::Zero();       ///< Roots of its diagonal.
  Vec6 standard_error = Vec6::Zero();  ///< Of the mean: deviation / sqrt(N).
};
/// Throws ComputationError for fewer than two errors.
ErrorStatistics StatisticsOf(const std::vector<Vec6>& errors);

/// A mean of normalised errors, and the bounds in which it should be.
struct Nees {
  double mean = 0;   ///< Ideally 6; above: over-confident.
  double lower = 0;  ///< Two-sided 95 % bounds of the mean for covariances that are right.
  double upper = 0;
  /// sqrt(mean / 6): by this factor the standard deviations are too small (below 1: too large).
  double Overconfidence() const;
  bool Consistent() const { return lower <= mean && mean <= upper; }
};

/// Average normalised estimation error squared about the truth [Bar-Shalom et al. 2001, sec.
/// 5.4.2]:
///   NEES = 1/N sum xi_i^T P_i^-1 xi_i,   N NEES ~ chi-square with 6 N degrees of freedom
/// where the P_i are right and there is no bias. One P_i per error. Throws UsageError for other
/// numbers of both, and where a P_i is not positive definite.
Nees NeesAboutTruth(const std::vector<Vec6>& errors, const std::vector<Mat6>& covariances);

/// The same about the errors' own mean m, so that a bias does not count:
///   NEES = 1/(N - 1) sum (xi_i - m)^T P_i^-1 (xi_i - m)
/// The mean takes away 6 of the 6 N degrees of freedom: hence N - 1, and chi-square with 6 (N - 1).
Nees NeesAboutMean(const std::vector<Vec6>& errors, const std::vector<Mat6>& covariances);

/// Predicted over actual standard deviation of each degree of freedom:
///   sqrt(1/N sum P_i,jj) / deviation_j.
Vec6 DeviationRatio(const ErrorStatistics& actual, const std::vector<Mat6>& covariances);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_COVARIANCE_CONSISTENCY_H_
