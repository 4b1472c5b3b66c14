// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_REPORTS_ALIGNED_TABLE_H_
#define ICPSCAPE_APPS_REPORTS_ALIGNED_TABLE_H_

#include <string>
#include <vector>

namespace icpscape {

/// Prints rows of equally many texts, the first of them the header: columns aligned for a terminal,
/// or as a table of Markdown.
void PrintAligned(const std::vector<std::vector<std::string>>& rows, bool markdown);

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_REPORTS_ALIGNED_TABLE_H_
