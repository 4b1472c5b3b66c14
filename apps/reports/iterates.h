// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_REPORTS_ITERATES_H_
#define ICPSCAPE_APPS_REPORTS_ITERATES_H_

#include <optional>
#include <vector>

#include "apps/run/run.h"
#include "icpscape/cloud/origin.h"
#include "icpscape/landscape/path.h"
#include "icpscape/minimizer/minimize_each.h"

namespace icpscape {

/// The part of a path along which iterates have their places.
struct PathSection {
  Path path;
  double u_min = 0;
  double u_max = 1;
};

/// Writes iterates.csv, every iterate of every metric: its nearest u on the section and its
/// distance from the path there (see PathProjection; rotations count kRotationLength_m; nan without
/// a section), the objective's values, the step before it, and its pose in the coordinates of the
/// user.
void WriteIterates(const std::vector<MetricIterates>& all,
                   const std::optional<PathSection>& section, const PairOrigins& origins, Run* run);

/// Prints the iterates of one minimisation, one a line.
void PrintIterates(const MinimizerSummary& summary);

/// Prints and records where on the section each metric's iterates end.
void ReportEnds(const std::vector<MetricIterates>& all, const PathSection& section,
                Manifest* manifest);

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_REPORTS_ITERATES_H_
