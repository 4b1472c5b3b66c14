// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/cloud/normals.h"

#include <cstdint>
#include <limits>

#include "icpscape/common/parallel.h"

namespace icpscape {
namespace {

// Calls use(order, neighborhoods) for part after part of the cloud, from many threads: entry k of
// the neighbourhoods, with centred products, is that of point order[k].
template <class Use>
void ForEachNeighborhoods(const NeighborSearch& search, const NeighborhoodOptions& options,
                          int threads, const Use& use) {
  ForEachPart(search.Order().size(), threads, [&](std::size_t begin, std::size_t end) {
    thread_local Neighborhoods neighborhoods;
    const PointsView queries = search.OrderedPoints().Slice(begin, end);
    if (options.radius_m > 0) {
      search.WithinRadius(queries, static_cast<float>(options.radius_m), &neighborhoods);
    } else {
      search.KNearest(queries, options.num_neighbors, &neighborhoods);
    }
    neighborhoods.CenterProducts();
    use(search.Order().data() + begin, neighborhoods);
  });
}

constexpr int kFewestNeighbors = 3;

}  // namespace

std::vector<Eigen::Matrix3d> EstimateCovariances(const PointCloud& cloud,
                                                 const NeighborhoodOptions& options, int threads) {
  std::vector<Eigen::Matrix3d> covariances(
      cloud.size(), Mat3::Constant(std::numeric_limits<double>::quiet_NaN()));
  ForEachNeighborhoods(NeighborSearch(cloud.View(), threads), options, threads,
                       [&](const std::int32_t* order, const Neighborhoods& neighborhoods) {
                         for (std::size_t k = 0; k < neighborhoods.size(); ++k) {
                           if (neighborhoods.count[k] >= kFewestNeighbors) {
                             covariances[static_cast<std::size_t>(order[k])] =
                                 neighborhoods.Products(k) / neighborhoods.count[k];
                           }
                         }
                       });
  return covariances;
}

std::size_t EstimateNormals(const NeighborhoodOptions& options, int threads, PointCloud* cloud) {
  return EstimateNormals(NeighborSearch(cloud->View(), threads), options, threads, cloud);
}

std::size_t EstimateNormals(const NeighborSearch& search, const NeighborhoodOptions& options,
                            int threads, PointCloud* cloud) {
  const std::size_t size = cloud->size();
  std::vector<float> nx(size), ny(size), nz(size);
  ForEachNeighborhoods(search, options, threads,
                       [&](const std::int32_t* order, const Neighborhoods& neighborhoods) {
                         thread_local PrincipalAxes axes;
                         axes.Compute(neighborhoods);
                         for (std::size_t k = 0; k < neighborhoods.size(); ++k) {
                           // On a line every direction across it is as good: no normal. A line 1 m
                           // long and 0.3 mm thick is still one.
                           if (neighborhoods.count[k] < kFewestNeighbors ||
                               !(axes.middle[k] > 1e-7 * axes.largest[k])) {
                             continue;
                           }
                           const auto i = static_cast<std::size_t>(order[k]);
                           Vec3 n = axes.Smallest(k);
                           if (n.dot(cloud->Point(i) - cloud->sensor) > 0) {
                             n = -n;
                           }
                           nx[i] = static_cast<float>(n.x());
                           ny[i] = static_cast<float>(n.y());
                           nz[i] = static_cast<float>(n.z());
                         }
                       });
  cloud->nx = std::move(nx);
  cloud->ny = std::move(ny);
  cloud->nz = std::move(nz);
  std::size_t without = 0;
  for (std::size_t i = 0; i < size; ++i) {
    without += cloud->NormalIsValid(i) ? 0 : 1;
  }
  return without;
}

}  // namespace icpscape
