// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_REPORTS_PAPER_FIGURES_H_
#define ICPSCAPE_APPS_REPORTS_PAPER_FIGURES_H_

#include <map>
#include <string>
#include <vector>

#include "apps/run/run.h"
#include "icpscape/paper/claims.h"
#include "icpscape/paper/figures.h"
#include "icpscape/paper/paper_curves.h"

namespace icpscape {

/// Writes the curves under the paper's file names (data/), LaTeX documents that draw them, and the
/// tables figures.csv, minima.csv and pulls.csv. `titles` are those of the figures, by name.
void WritePaperTables(const std::vector<Figure>& figures,
                      const std::map<std::string, std::string>& titles,
                      const std::map<std::string, PaperCurve>& curves, Run* run);

/// Prints, records and writes (claims.csv, claims.md) which of the paper's claims hold for what was
/// drawn. `source` names the scans.
void ReportClaims(const std::vector<Claim>& claims, const std::string& source, Run* run);

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_REPORTS_PAPER_FIGURES_H_
