// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/simulation/street_network.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "icpscape/simulation/random.h"

namespace icpscape {
namespace {

constexpr double kKerbM = 0.12;
constexpr double kFall = 0.025;  // Of carriageway and pavement.
constexpr double kUnevennessM = 0.006;
constexpr double kGardenM = 18;
constexpr double kGrassM = 0.04;
constexpr double kStepM = 0.5;

}  // namespace

double DistanceToPolyline(const Vec2& p, const std::vector<Vec2>& polyline) {
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < polyline.size(); ++i) {
    const Vec2 edge = polyline[i + 1] - polyline[i];
    const double along = std::clamp((p - polyline[i]).dot(edge) / edge.squaredNorm(), 0., 1.);
    best = std::min(best, (p - polyline[i] - along * edge).squaredNorm());
  }
  return std::sqrt(best);
}

StreetNetwork::StreetNetwork(std::vector<Street> streets, std::uint64_t key)
    : streets_(std::move(streets)), key_(key) {}

std::vector<StreetSample> StreetNetwork::Sample(std::size_t street, double step_m) const {
  const std::vector<Vec2>& line = streets_[street].centre;
  std::vector<StreetSample> samples;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const double length = (line[i + 1] - line[i]).norm();
    const int count = std::max(1, static_cast<int>(std::ceil(length / step_m)));
    const bool last = i + 2 == line.size();
    for (int j = 0; j < count + (last ? 1 : 0); ++j) {
      const Vec2 tangent = (line[i + 1] - line[i]) / length;
      samples.push_back({line[i] + (length * j / count) * tangent, tangent});
      if (j == 0 && i > 0) {  // At a bend, the direction between both.
        samples.back().tangent = (tangent + (line[i] - line[i - 1]).normalized()).normalized();
      }
    }
  }
  return samples;
}

double StreetNetwork::DistanceToKerb(const Vec2& p, std::size_t except) const {
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < streets_.size(); ++i) {
    if (i != except) {
      best = std::min(best, DistanceToPolyline(p, streets_[i].centre) - streets_[i].half_width_m);
    }
  }
  return best;
}

double StreetNetwork::RoadHeight(const Vec2& p) const {
  return kFall * std::max(0., -DistanceToKerb(p)) +
         kUnevennessM * LatticeNoise(p.x() / 3, p.y() / 3, key_);
}

void StreetNetwork::AddStreet(std::size_t street, Mesh* mesh) const {
  const Street& s = streets_[street];
  const std::vector<StreetSample> samples = Sample(street, kStepM);
  const int rows = static_cast<int>(samples.size()) - 1;
  const auto at = [&](int i, double offset) -> Vec2 {
    const StreetSample& sample = samples[static_cast<std::size_t>(i)];
    return sample.position + offset * Vec2(-sample.tangent.y(), sample.tangent.x());
  };
  // A strip between two offsets from the centre; cells nearer than `keep_off_m` to the kerb of
  // another street give way to it.
  const auto strip = [&](double from, double to, int columns, const Surface& surface,
                         double keep_off_m, const auto& height) {
    const auto offset = [&](int j) { return from + (to - from) * j / columns; };
    AddPatch(
        rows, columns,
        [&](int i, int j) -> Vec3 {
          const Vec2 p = at(i, offset(j));
          return {p.x(), p.y(), height(p, j)};
        },
        surface, mesh,
        [&](int i, int j) {
          const Vec2 p = 0.5 * (at(i, offset(j)) + at(i + 1, offset(j + 1)));
          return DistanceToKerb(p, street) < keep_off_m;
        });
  };
  const double half = s.half_width_m;
  strip(-half, half, 10, {Label::kRoad, Material::kAsphalt}, -1e9,
        [&](const Vec2& p, int) { return RoadHeight(p); });
  for (const double side : {-1., 1.}) {
    strip(side * half, side * half, 1, {Label::kPavement, Material::kConcrete}, 0,
          [&](const Vec2&, int j) { return j == 0 ? -0.02 : kKerbM; });
    strip(side * half, side * (half + s.pavement_m), 2, {Label::kPavement, Material::kConcrete}, 0,
          [&](const Vec2& p, int j) {
            return kKerbM + kFall * s.pavement_m * j / 2 +
                   0.5 * kUnevennessM * LatticeNoise(p.x(), p.y(), key_);
          });
    strip(side * (half + s.pavement_m), side * (half + s.pavement_m + kGardenM), 30,
          {Label::kTerrain, Material::kGrass}, s.pavement_m, [&](const Vec2& p, int) {
            return kKerbM + 0.06 + kGrassM * LatticeNoise(p.x() / 0.6, p.y() / 0.6, key_ + 1);
          });
  }
}

void StreetNetwork::AddGround(Mesh* mesh) const {
  Vec2 low = streets_[0].centre[0];
  Vec2 high = low;
  for (std::size_t i = 0; i < streets_.size(); ++i) {
    AddStreet(i, mesh);
    for (const Vec2& p : streets_[i].centre) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  }
  // Below and beyond everything.
  constexpr double kMarginM = 130;
  constexpr double kBelowM = -0.1;
  mesh->AddQuad(Vec3(low.x() - kMarginM, low.y() - kMarginM, kBelowM),
                Vec3(high.x() + kMarginM, low.y() - kMarginM, kBelowM),
                Vec3(high.x() + kMarginM, high.y() + kMarginM, kBelowM),
                Vec3(low.x() - kMarginM, high.y() + kMarginM, kBelowM),
                {Label::kTerrain, Material::kGrass});
}

}  // namespace icpscape
