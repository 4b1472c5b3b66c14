// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_PREPARATION_PREPARED_PAIR_H_
#define ICPSCAPE_SRC_PREPARATION_PREPARED_PAIR_H_

#include <utility>

#include "icpscape/filtering/kept_points.h"
#include "icpscape/preparation/prepared_scan.h"
#include "icpscape/residuals/correspondence.h"

namespace icpscape {

/// The two scans of a pair, prepared: what an ObjectiveSet is made of.
struct PreparedPair {
  PreparedScan source;
  PreparedScan target;

  /// What a filter keeps; see PreparedScan::Select.
  PreparedPair Select(const KeptPoints& kept, int threads) const {
    return {source.Select(kept.source, threads), target.Select(kept.target, threads)};
  }
};

/// Each scan with what it needs: features are extracted only of the source, since metrics of lines
/// and patches fit to all points of the target.
inline PreparedPair PreparePair(PointCloud source, PointCloud target, unsigned needs,
                                const PreparationOptions& options, int threads) {
  return {
      Prepare(std::move(source), needs & ~static_cast<unsigned>(kTargetNormal), options, threads),
      Prepare(std::move(target), needs & kTargetNormal, options, threads)};
}

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_PREPARATION_PREPARED_PAIR_H_
