// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/simulation/drive.h"

#include <algorithm>
#include <cmath>

#include "icpscape/simulation/lidar.h"
#include "icpscape/simulation/town.h"

namespace icpscape {
namespace {

constexpr double kLaneOffsetM = 1.25;  // Of the route from the centre of its street.
constexpr double kToleranceM = 1.0;    // Of the straight pieces from the route.
constexpr double kCornerRad = 0.45;    // Sharper turns are crossings of two streets.
constexpr double kSideRoadM = 60;      // How far a street goes on beyond a crossing.
constexpr double kSameStreetM = 7;     // Nearer parallel pieces belong to one street.

Vec2 LeftOf(const Vec2& v) { return {-v.y(), v.x()}; }

double Angle(const Vec2& a, const Vec2& b) {
  return std::abs(std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b)));
}

// Douglas and Peucker: the fewest corners that keep the line within the tolerance.
void Simplify(const std::vector<Vec2>& line, std::size_t first, std::size_t last,
              std::vector<Vec2>* corners) {
  std::size_t farthest = first;
  double distance = kToleranceM;
  for (std::size_t i = first + 1; i < last; ++i) {
    const double d = DistanceToPolyline(line[i], {line[first], line[last]});
    if (d > distance) {
      distance = d;
      farthest = i;
    }
  }
  if (farthest == first) {
    corners->push_back(line[last]);
    return;
  }
  Simplify(line, first, farthest, corners);
  Simplify(line, farthest, last, corners);
}

// Route points at least 1 m apart: KITTI's car stands still at times.
std::vector<Vec2> Thin(const std::vector<Vec2>& route) {
  std::vector<Vec2> thin;
  for (const Vec2& p : route) {
    if (thin.empty() || (p - thin.back()).norm() >= 1) {
      thin.push_back(p);
    }
  }
  return thin;
}

// Whether an earlier street runs here in about this direction.
bool Covered(const Vec2& p, const Vec2& direction, const std::vector<Street>& streets) {
  return std::any_of(streets.begin(), streets.end(), [&](const Street& street) {
    if (DistanceToPolyline(p, street.centre) > kSameStreetM) {
      return false;
    }
    for (std::size_t i = 0; i + 1 < street.centre.size(); ++i) {
      const Vec2 along = street.centre[i + 1] - street.centre[i];
      const double turn = Angle(along, direction);
      if (std::min(turn, M_PI - turn) < kCornerRad &&
          DistanceToPolyline(p, {street.centre[i], street.centre[i + 1]}) < kSameStreetM) {
        return true;
      }
    }
    return false;
  });
}

// The parts of a line that no earlier street covers become streets.
void AddNew(const std::vector<Vec2>& line, std::vector<Street>* streets) {
  std::vector<Street> added;
  std::vector<Vec2> run;
  const auto finish = [&] {
    if (run.size() >= 2 && (run.back() - run.front()).norm() > 8) {
      run.front() -= kSideRoadM * (run[1] - run[0]).normalized();
      run.back() += kSideRoadM * (run.back() - run[run.size() - 2]).normalized();
      added.push_back(Street{run});
    }
    run.clear();
  };
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Vec2 edge = line[i + 1] - line[i];
    const int pieces = std::max(1, static_cast<int>(edge.norm() / 4));
    for (int j = 0; j < pieces; ++j) {
      const Vec2 a = line[i] + (j * 1. / pieces) * edge;
      const Vec2 b = line[i] + ((j + 1.) / pieces) * edge;
      if (Covered(0.5 * (a + b), edge, *streets)) {
        finish();
        continue;
      }
      if (run.empty()) {
        run.push_back(a);
      }
      run.push_back(b);
    }
  }
  finish();
  streets->insert(streets->end(), added.begin(), added.end());
}

}  // namespace

std::vector<SE3d> ProjectToGround(const std::vector<SE3d>& T_world_lidar) {
  std::vector<SE3d> projected;
  for (const SE3d& T : T_world_lidar) {
    projected.push_back(
        Placement(T.t().x(), T.t().y(), kLidarHeightM, std::atan2(T.R()(1, 0), T.R()(0, 0))));
  }
  return projected;
}

std::vector<Street> StreetsAlong(const std::vector<Vec2>& route) {
  // Where the car hardly moves: along x, so that there is something to see.
  const std::vector<Street> standing = {
      Street{{route[0] - Vec2(60, -kLaneOffsetM), route[0] + Vec2(60, kLaneOffsetM)}}};
  const std::vector<Vec2> thin = Thin(route);
  if (thin.size() < 2) {
    return standing;
  }
  std::vector<Vec2> corners = {thin[0]};
  Simplify(thin, 0, thin.size() - 1, &corners);
  std::vector<Street> streets;
  std::vector<Vec2> line;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    const Vec2 direction = (corners[i + 1] - corners[i]).normalized();
    if (line.empty()) {
      line.push_back(corners[i] + kLaneOffsetM * LeftOf(direction));
    }
    line.push_back(corners[i + 1] + kLaneOffsetM * LeftOf(direction));
    const bool last = i + 2 == corners.size();
    if (last || Angle(direction, corners[i + 2] - corners[i + 1]) > kCornerRad) {
      AddNew(line, &streets);
      line.clear();
    }
  }
  return streets.empty() ? standing : streets;
}

Drive MakeDrive(const std::vector<SE3d>& T_world_lidar, std::uint64_t key) {
  Drive drive;
  drive.T_world_lidar = ProjectToGround(T_world_lidar);
  std::vector<Vec2> route;
  for (const SE3d& T : drive.T_world_lidar) {
    route.push_back(T.t().head<2>());
  }
  const StreetNetwork network(StreetsAlong(route), key);
  drive.world = MakeTown(network, Thin(route), key);
  return drive;
}

}  // namespace icpscape
