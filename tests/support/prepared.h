// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_TESTS_SUPPORT_PREPARED_H_
#define ICPSCAPE_TESTS_SUPPORT_PREPARED_H_

#include <optional>
#include <utility>

#include "icpscape/preparation/prepared_pair.h"

namespace icpscape::testing_support {

/// Clouds whose normals are there as a pair that is ready to be registered.
inline PreparedPair AsPrepared(PointCloud source, PointCloud target,
                               std::optional<Features> features = std::nullopt) {
  return {PreparedScan(std::move(source), std::move(features)), PreparedScan(std::move(target))};
}

}  // namespace icpscape::testing_support

#endif  // ICPSCAPE_TESTS_SUPPORT_PREPARED_H_
