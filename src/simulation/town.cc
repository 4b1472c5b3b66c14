// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/simulation/town.h"

#include <algorithm>
#include <cmath>

#include "icpscape/simulation/buildings.h"
#include "icpscape/simulation/footprint.h"
#include "icpscape/simulation/random.h"
#include "icpscape/simulation/roadside.h"
#include "icpscape/simulation/vegetation.h"
#include "icpscape/simulation/vehicles.h"

namespace icpscape {
namespace {

constexpr double kPavementM = 0.12;       // Height of pavements,
constexpr double kGardenM = 0.18;         // and of gardens.
constexpr double kRouteClearanceM = 1.5;  // Half the car's width (0.91 m) and a margin.

class TownBuilder {
 public:
  TownBuilder(const StreetNetwork& network, const std::vector<Vec2>& route, std::uint64_t key)
      : network_(network), route_(route), key_(key) {}

  World Build() {
    network_.AddGround(&world_.standing);
    for (std::size_t street = 0; street < network_.streets().size(); ++street) {
      for (const int side : {-1, 1}) {
        LineWithHouses(street, side);
      }
    }
    for (std::size_t street = 0; street < network_.streets().size(); ++street) {
      for (const int side : {-1, 1}) {
        Random random(MixKeys(key_, 2, street, side));
        ParkCars(street, side, &random);
        CloseBackGardens(street, side, &random);
        Furnish(street, side, &random);
      }
    }
    return std::move(world_);
  }

 private:
  // A place beside a street: `offset_m` outwards from its centre on that side.
  struct Place {
    Vec2 position;
    double yaw;  // x along the street (left side) or against it (right side), y outwards.
  };

  Place Beside(const StreetSample& sample, int side, double offset_m) const {
    const Vec2 normal(-sample.tangent.y(), sample.tangent.x());
    const double yaw = std::atan2(sample.tangent.y(), sample.tangent.x());
    return {sample.position + side * offset_m * normal, side > 0 ? yaw : yaw + M_PI};
  }

  static Vec3 At(const Vec2& p, double z) { return {p.x(), p.y(), z}; }

  bool ClearOfRoute(const Vec2& p, double radius_m) const {
    return DistanceToPolyline(p, route_) > kRouteClearanceM + radius_m;
  }

  bool InHouse(const Vec2& p, double margin_m) const {
    return std::any_of(houses_.begin(), houses_.end(),
                       [&](const Footprint& f) { return f.Contains(p, margin_m); });
  }

  bool TryHouse(const Footprint& f) {
    for (int i = 0; i <= 8; ++i) {
      for (int j = 0; j <= 8; ++j) {
        const Vec2 p = f.origin + i / 8. * f.along + j / 8. * f.back;
        if (network_.DistanceToKerb(p) < 2.3) {
          return false;
        }
      }
    }
    if (std::any_of(houses_.begin(), houses_.end(),
                    [&](const Footprint& other) { return f.Overlaps(other); })) {
      return false;
    }
    houses_.push_back(f);
    return true;
  }

  void LineWithHouses(std::size_t street, int side) {
    Random random(MixKeys(key_, 1, street, side));
    const std::vector<StreetSample> samples = network_.Sample(street, 1);
    const Street& s = network_.streets()[street];
    const double front = s.half_width_m + s.pavement_m;
    double setback = random.Uniform(1, 6);
    const int count = static_cast<int>(samples.size());
    for (int i = 0; i < count;) {
      if (random.Chance(0.3)) {
        setback = random.Chance(0.2) ? 0.15 : random.Uniform(2.5, 8);
      }
      House house;
      house.width_m = random.Uniform(9, 18);
      house.depth_m = random.Uniform(9, 12);
      house.floors = 2 + random.Index(3);
      const int width = static_cast<int>(std::ceil(house.width_m));
      const int middle = std::min(i + width / 2, count - 1);
      const Place place = Beside(samples[static_cast<std::size_t>(middle)], side, front + setback);
      const Vec2 x(std::cos(place.yaw), std::sin(place.yaw));
      const Vec2 y(-x.y(), x.x());
      const Footprint f{place.position - 0.5 * house.width_m * x, house.width_m * x,
                        house.depth_m * y};
      if (!TryHouse(f)) {
        i += 1;
        continue;
      }
      const SE3d T = Placement(f.origin.x(), f.origin.y(), kPavementM, place.yaw);
      AddHouse(house, T, world_.NextInstance(), &random, &world_.standing);
      if (setback > 1.2) {
        AddFrontGarden(T, house.width_m, setback, &random);
      }
      const bool terrace = random.Chance(0.5);
      const double gap = terrace ? 0 : random.Uniform(3, 7);
      if (!terrace) {
        AddGap(T * Placement(house.width_m, 0, 0, 0), gap, setback, &random);
      }
      i += width + static_cast<int>(gap);
    }
  }

  // Between pavement and house: x along the front, the pavement's edge at y = -setback.
  void AddFrontGarden(const SE3d& T, double width, double setback, Random* random) {
    const double y = -setback + 0.25;
    const double gate = random->Uniform(0.3, 0.7) * width;
    AddBoundary(T, {0.1, y}, {gate - 0.6, y}, random);
    AddBoundary(T, {gate + 0.6, y}, {width - 0.1, y}, random);
    const int bushes = random->Index(1 + static_cast<int>(width * setback / 5));
    for (int i = 0; i < bushes && setback > 2; ++i) {
      const Vec3 foot = T * Vec3(random->Uniform(0.8, width - 0.8),
                                 -random->Uniform(0.6, setback - 1), kGardenM - kPavementM);
      AddBush(foot, random->Uniform(0.3, 0.9), world_.NextInstance(), random, &world_.standing);
    }
    if (setback > 3.5 && random->Chance(0.7)) {
      AddTree(T * Vec3(random->Uniform(2, width - 2), -0.5 * setback, 0.06), random->Uniform(5, 8),
              world_.NextInstance(), random, &world_.standing);
    }
  }

  // A hedge, a fence or a low wall; which, is up to the owner.
  void AddBoundary(const SE3d& T, const Vec2& a, const Vec2& b, Random* random) {
    const Vec3 from = T * Vec3(a.x(), a.y(), 0);
    const Vec3 to = T * Vec3(b.x(), b.y(), 0);
    if ((to - from).norm() < 0.5 || network_.DistanceToKerb(from.head<2>()) < 2.2 ||
        network_.DistanceToKerb(to.head<2>()) < 2.2) {
      return;
    }
    const std::uint16_t instance = world_.NextInstance();
    const double kind = random->Uniform();
    if (kind < 0.55) {
      AddHedge(from, to, 0.5, random->Uniform(0.8, 1.7), instance, random->Bits(),
               &world_.standing);
    } else if (kind < 0.8) {
      AddPicketFence(from, to, random->Uniform(0.9, 1.3), instance, &world_.standing);
    } else {
      AddLowWall(from, to, random->Uniform(0.4, 1.0), instance, &world_.standing);
    }
  }

  // Where the gardens of two streets meet: hedges, fences and sheds between trees. It bounds what
  // is seen past the houses.
  void CloseBackGardens(std::size_t street, int side, Random* random) {
    const Street& s = network_.streets()[street];
    const std::vector<StreetSample> samples = network_.Sample(street, 1);
    for (std::size_t i = 0; i + 12 < samples.size(); i += 11) {
      const double offset = s.half_width_m + s.pavement_m + random->Uniform(18, 26);
      const Place from = Beside(samples[i], side, offset);
      const Place to = Beside(samples[i + 11], side, offset);
      const Vec2 middle = 0.5 * (from.position + to.position);
      const auto clear = [&](const Vec2& p) {
        return !InHouse(p, 0.5) && network_.DistanceToKerb(p) > 4;
      };
      if (!clear(from.position) || !clear(to.position) || !clear(middle)) {
        continue;
      }
      const std::uint16_t instance = world_.NextInstance();
      if (random->Chance(0.25)) {  // A shed or a garage.
        const SE3d T = Placement(middle.x(), middle.y(), kGardenM, from.yaw);
        AddBox(T, Vec3(-2, -1.5, 0), Vec3(2, 1.5, 2.4),
               {Label::kBuilding, Material::kWood, instance}, &world_.standing);
      }
      AddHedge(At(from.position, kGardenM), At(to.position, kGardenM), 0.8,
               random->Uniform(1.4, 2.6), world_.NextInstance(), random->Bits(), &world_.standing);
      for (const double t : {random->Uniform(0, 0.4), random->Uniform(0.6, 1)}) {
        const Vec2 foot = from.position + t * (to.position - from.position);
        AddTree(At(foot, kGardenM), random->Uniform(5, 11), world_.NextInstance(), random,
                &world_.standing);
      }
    }
  }

  // The way between two houses: a boundary with a drive beside it, a tree behind.
  void AddGap(const SE3d& T, double width, double setback, Random* random) {
    AddBoundary(T, {0.2, -setback + 0.25}, {width - 2.7, -setback + 0.25}, random);
    const Vec3 foot = T * Vec3(0.5 * width, random->Uniform(3, 8), 0.06);
    if (random->Chance(0.6) && network_.DistanceToKerb(foot.head<2>()) > 4) {
      AddTree(foot, random->Uniform(5, 9), world_.NextInstance(), random, &world_.standing);
    }
  }

  void ParkCars(std::size_t street, int side, Random* random) {
    const Street& s = network_.streets()[street];
    const std::vector<StreetSample> samples = network_.Sample(street, 1);
    // Bays of 5.5 to 6.5 m, half of them taken, none near a crossing (5 m, StVO section 12).
    for (double along = random->Uniform(2, 6); along + 2 < static_cast<double>(samples.size()) - 1;
         along += random->Uniform(5.5, 6.5)) {
      const Place place = Beside(samples[static_cast<std::size_t>(along)], side,
                                 s.half_width_m - 1.05 + random->Uniform(-0.1, 0.1));
      const double yaw = place.yaw + M_PI + random->Uniform(-0.02, 0.02);
      if (!random->Chance(0.5) || network_.DistanceToKerb(place.position, street) < 7.5 ||
          !ClearOfRoute(place.position, 0.91)) {
        continue;
      }
      const Mesh car = MakeCar(Label::kCar, world_.NextInstance(), random);
      world_.standing.Append(car, Placement(place.position.x(), place.position.y(),
                                            network_.RoadHeight(place.position), yaw));
    }
  }

  // Lamps, signs, trees and bins on the pavement; trees in the gardens behind.
  void Furnish(std::size_t street, int side, Random* random) {
    const Street& s = network_.streets()[street];
    const std::vector<StreetSample> samples = network_.Sample(street, 1);
    const int count = static_cast<int>(samples.size());
    const bool avenue = random->Chance(0.6);
    const double lamp_phase = random->Uniform(0, 30);
    int last_sign = -100;
    for (int i = 2; i < count - 2; ++i) {
      const StreetSample& sample = samples[static_cast<std::size_t>(i)];
      const Place kerb = Beside(sample, side, s.half_width_m + 0.45);
      const double crossing = network_.DistanceToKerb(kerb.position, street);
      if (crossing < 0.4 || !ClearOfRoute(kerb.position, 0.3)) {
        continue;
      }
      const Vec3 foot = At(kerb.position, kPavementM);
      const bool lamp =
          static_cast<int>((i + lamp_phase) / 30) != static_cast<int>((i - 1 + lamp_phase) / 30);
      if (lamp && side > 0) {
        AddLamp(foot, kerb.yaw - M_PI / 2, world_.NextInstance(), &world_.standing);
      } else if (i - last_sign > 15 && (crossing < 2.5 || random->Chance(1 / 40.))) {
        last_sign = i;
        AddSign(foot, kerb.yaw, random->Bits(), world_.NextInstance(), &world_.standing);
      } else if (avenue && crossing > 6 && random->Chance(1 / 12.)) {
        AddTree(foot, random->Uniform(6, 10), world_.NextInstance(), random, &world_.standing);
        i += 5;
      } else if (random->Chance(1 / 25.)) {
        const Place wall = Beside(sample, side, s.half_width_m + s.pavement_m - 0.4);
        AddBox(Placement(wall.position.x(), wall.position.y(), kPavementM, wall.yaw),
               Vec3(-0.3, -0.3, 0), Vec3(0.3, 0.3, 1.07),
               {Label::kOtherObject, Material::kWood, world_.NextInstance()}, &world_.standing);
      }
      if (random->Chance(1 / 12.)) {
        const Place garden = Beside(sample, side, s.half_width_m + random->Uniform(6, 20));
        if (!InHouse(garden.position, 1.5) && network_.DistanceToKerb(garden.position) > 4) {
          AddTree(At(garden.position, kGardenM), random->Uniform(5, 11), world_.NextInstance(),
                  random, &world_.standing);
        }
      }
    }
  }

  const StreetNetwork& network_;
  const std::vector<Vec2>& route_;
  std::uint64_t key_;
  std::vector<Footprint> houses_;
  World world_;
};

}  // namespace

World MakeTown(const StreetNetwork& streets, const std::vector<Vec2>& route, std::uint64_t key) {
  return TownBuilder(streets, route, key).Build();
}

}  // namespace icpscape
