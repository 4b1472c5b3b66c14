// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_MATCHING_METRIC_CLOUDS_H_
#define ICPSCAPE_SRC_MATCHING_METRIC_CLOUDS_H_

#include <optional>

#include "icpscape/cloud/searchable_cloud.h"

namespace icpscape {

/// The clouds that metrics of each kind work on: of a source those whose points are matched, of a
/// target those that are searched. Only what the metrics need must be there.
struct MetricClouds {
  std::optional<SearchableCloud> points;  ///< Closest-point metrics.
  std::optional<SearchableCloud> edges;   ///< Edge metrics.
  std::optional<SearchableCloud> planar;  ///< Planar metrics.
};

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_MATCHING_METRIC_CLOUDS_H_
