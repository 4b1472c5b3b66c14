// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/covariance/consistency.h"

#include <Eigen/Cholesky>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>

#include "icpscape/common/error.h"

namespace icpscape {
namespace {

constexpr double kTail = 0.025;

// `count` is how many independent errors there are.
Nees NeesOf(const std::vector<Vec6>& errors, const Vec6& center,
            const std::vector<Mat6>& covariances, double count) {
  if (errors.empty() || errors.size() != covariances.size()) {
    throw UsageError(std::to_string(errors.size()) + " errors and " +
                     std::to_string(covariances.size()) +
                     " covariances; expected as many of both, at least one.");
  }
  double sum = 0;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const Eigen::LLT<Mat6> factor(covariances[i]);
    if (factor.info() != Eigen::Success) {
      throw UsageError("Covariance " + std::to_string(i) +
                       " is not positive definite; expected all of them to be.");
    }
    sum += factor.matrixL().solve(errors[i] - center).squaredNorm();
  }
  const boost::math::chi_squared distribution(6 * count);
  return {sum / count, quantile(distribution, kTail) / count,
          quantile(complement(distribution, kTail)) / count};
}

}  // namespace

double Nees::Overconfidence() const { return std::sqrt(mean / 6); }

ErrorStatistics StatisticsOf(const std::vector<Vec6>& errors) {
  if (errors.size() < 2) {
    throw ComputationError("only " + std::to_string(errors.size()) +
                           " draws have an answer; expected at least 2.");
  }
  ErrorStatistics statistics;
  statistics.n = static_cast<long>(errors.size());
  const auto n = static_cast<double>(errors.size());
  for (const Vec6& error : errors) {
    statistics.mean += error / n;
  }
  for (const Vec6& error : errors) {
    const Vec6 difference = error - statistics.mean;
    statistics.covariance += difference * difference.transpose() / (n - 1);
  }
  statistics.deviation = statistics.covariance.diagonal().cwiseSqrt();
  statistics.standard_error = statistics.deviation / std::sqrt(n);
  return statistics;
}

Nees NeesAboutTruth(const std::vector<Vec6>& errors, const std::vector<Mat6>& covariances) {
  return NeesOf(errors, Vec6::Zero(), covariances, static_cast<double>(errors.size()));
}

Nees NeesAboutMean(const std::vector<Vec6>& errors, const std::vector<Mat6>& covariances) {
  return NeesOf(errors, StatisticsOf(errors).mean, covariances,
                static_cast<double>(errors.size()) - 1);
}

Vec6 DeviationRatio(const ErrorStatistics& actual, const std::vector<Mat6>& covariances) {
  Vec6 variance = Vec6::Zero();
  for (const Mat6& covariance : covariances) {
    variance += covariance.diagonal() / static_cast<double>(covariances.size());
  }
  return variance.cwiseSqrt().cwiseQuotient(actual.deviation);
}

}  // namespace icpscape
