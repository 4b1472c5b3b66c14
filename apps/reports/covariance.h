// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_REPORTS_COVARIANCE_H_
#define ICPSCAPE_APPS_REPORTS_COVARIANCE_H_

#include <filesystem>
#include <string>
#include <vector>

#include "src/covariance/monte_carlo.h"
#include "src/io/manifest.h"
#include "src/io/output.h"

namespace icpscape {

/// What icpscape-covariance prints, records and writes, metric by metric.
class CovarianceReport {
 public:
  CovarianceReport(const CovarianceOptions& options, double length_scale_m);

  /// Registers the pair and says how sure that is: covariances, eigenvalues and verdicts. Throws
  /// ComputationError where the registration has no result.
  void AddPair(const Objective& objective, const SE3d& T_initial, int threads, Manifest* manifest);

  /// Bias, spread and NEES of Monte-Carlo draws. Throws ComputationError where fewer than two have
  /// a result.
  void AddDraws(const std::string& metric, const std::vector<DrawResult>& draws,
                Manifest* manifest);

  /// covariance.csv, directions.csv, verdicts.csv.
  void WritePair(const std::filesystem::path& out) const;
  /// draws.csv, calibration.csv, bias.csv.
  void WriteDraws(const std::filesystem::path& out) const;

 private:
  CovarianceOptions options_;
  double length_scale_m_;
  Table covariances_, directions_, verdicts_;  // Of pairs.
  Table draws_, calibration_;
  Table bias_ = Table({"metric", "component", "unit", "bias", "standard_error", "deviation"});
};

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_REPORTS_COVARIANCE_H_
