// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_RUN_FIGURES_H_
#define ICPSCAPE_APPS_RUN_FIGURES_H_

#include <string>
#include <vector>

namespace icpscape {

/// Runs tools/SCRIPT (Python with matplotlib) on the arguments. Where that fails there is one
/// warning, and the answer is false.
bool RunPlotScript(const std::string& script, const std::vector<std::string>& arguments);

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_RUN_FIGURES_H_
