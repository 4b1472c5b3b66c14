// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_REPORTS_VERDICT_H_
#define ICPSCAPE_APPS_REPORTS_VERDICT_H_

#include <string>
#include <utility>
#include <vector>

#include "apps/run/run.h"
#include "icpscape/verdict/verdict.h"

namespace icpscape {

/// The verdict of what has this name.
using NamedVerdict = std::pair<std::string, Verdict>;

/// Prints one verdict, in a line or two.
void PrintVerdict(const Verdict& verdict);

/// Writes verdict.csv, with a row for each direction, and records the verdicts in the manifest:
/// "verdict" for one, "verdict_NAME" for each of several.
void WriteVerdicts(const std::vector<NamedVerdict>& verdicts, Run* run);

/// Which doubtful poses do not end a program with exit code 4.
struct AcceptedVerdicts {
  bool undetermined = false;
  bool limit = false;
  bool cycle = false;

  bool Accept(const Verdict& verdict) const;
};

/// Throws DoubtfulPose for verdicts that are not accepted.
void RequireAccepted(const std::vector<NamedVerdict>& verdicts, const AcceptedVerdicts& accepted);

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_REPORTS_VERDICT_H_
