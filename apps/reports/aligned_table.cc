// SPDX-License-Identifier: BSD-3-Clause
#include "apps/reports/aligned_table.h"

#include <algorithm>
#include <iomanip>
#include <iostream>

namespace icpscape {

void PrintAligned(const std::vector<std::vector<std::string>>& rows, bool markdown) {
  std::vector<std::size_t> widths(rows[0].size());
  for (const std::vector<std::string>& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      widths[i] = std::max(widths[i], row[i].size());
    }
  }
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (std::size_t i = 0; i < rows[r].size(); ++i) {
      if (markdown) {
        std::cout << (i == 0 ? "| " : " | ") << rows[r][i];
      } else {
        std::cout << std::left << std::setw(static_cast<int>(widths[i]) + 2) << rows[r][i];
      }
    }
    std::cout << (markdown ? " |\n" : "\n");
    if (r == 0 && markdown) {
      for (std::size_t i = 0; i < widths.size(); ++i) {
        std::cout << "|---";
      }
      std::cout << "|\n";
    }
  }
}

}  // namespace icpscape
