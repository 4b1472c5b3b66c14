// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_REPORTS_COVARIANCE_H_
#define ICPSCAPE_APPS_REPORTS_COVARIANCE_H_

#include <string>
#include <vector>

#include "apps/reports/verdict.h"
#include "apps/run/run.h"
#include "icpscape/io/output.h"
#include "icpscape/monte_carlo/monte_carlo.h"

namespace icpscape {

/// What icpscape-covariance prints, records and writes, metric by metric.
class CovarianceReport {
 public:
  CovarianceReport();

  /// How sure the registration of a pair is: covariances, eigenvalues and judgements.
  /// The verdict decides along which axes deviations are given.
  void AddPair(const NamedVerdict& verdict, const RegistrationUncertainty& result, double cluster_m,
               Manifest* manifest);

  /// Bias, spread and NEES of Monte-Carlo draws. Throws ComputationError where fewer than two have
  /// a result.
  void AddDraws(const std::string& metric, const std::vector<DrawResult>& draws,
                Manifest* manifest);

  /// covariance.csv, directions.csv, degeneracy.csv.
  void WritePair(Run* run) const;
  /// draws.csv, calibration.csv, bias.csv.
  void WriteDraws(Run* run) const;

 private:
  Table covariances_, directions_, judgements_;  // Of pairs.
  Table draws_, calibration_;
  Table bias_ = Table({"metric", "component", "unit", "bias", "standard_error", "deviation"});
};

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_REPORTS_COVARIANCE_H_
