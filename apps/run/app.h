// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_RUN_APP_H_
#define ICPSCAPE_APPS_RUN_APP_H_

#include <functional>
#include <string>

#include "apps/run/flag.h"

namespace icpscape {

/// main() of every program: parses the flags (all must be --flag=value; --flagfile works), answers
/// --help with this program's own flags, group by group, refuses stray arguments and turns errors
/// into one sentence on stderr. Exit codes: 0 done, 1 the command line is wrong, 2 the data are
/// wrong, 3 the computation has no answer, 4 a pose is doubtful (see DoubtfulPose), 130 and 143
/// interrupted (see EndOnSignals).
int RunApp(int argc, char** argv, const std::string& summary, const std::function<void()>& run);

/// Name of the running program, as in "icpscape-landscape".
const std::string& AppName();

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_RUN_APP_H_
