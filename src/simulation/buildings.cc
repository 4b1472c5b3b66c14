// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/simulation/buildings.h"

#include <algorithm>

namespace icpscape {
namespace {

constexpr double kFloorM = 3.0;
constexpr double kPlinthM = 0.5;

// One bay of a wall: a rectangle with an opening whose filling is set back.
struct Opening {
  double left, right, bottom, top;  // Within the bay, metres from its lower left corner.
  double recess_m;
  Material filling;
};

class Wall {
 public:
  // `T` has x along the wall, y into the house, z up.
  Wall(const SE3d& T_mesh_wall, std::uint16_t instance, Random* random, Mesh* mesh)
      : T_(T_mesh_wall), instance_(instance), random_(random), mesh_(mesh) {}

  void Add(double width_m, int floors) {
    const int bays = std::max(1, static_cast<int>(width_m / random_->Uniform(2.4, 3.2)));
    const double bay = width_m / bays;
    const int door = random_->Index(bays);
    const int bay_window = random_->Chance(0.35) ? random_->Index(bays) : -1;
    const bool garage = random_->Chance(0.2);
    const int balcony = random_->Chance(0.3) ? random_->Index(bays) : -1;
    for (int floor = 0; floor < floors; ++floor) {
      const double z = floor * kFloorM;
      for (int i = 0; i < bays; ++i) {
        const double x = i * bay;
        if (floor == 0 && i == door) {
          const double half = garage ? std::min(1.25, 0.45 * bay) : 0.55;
          AddBay(x, z, bay,
                 {0.5 * bay - half, 0.5 * bay + half, 0.02, 2.15, garage ? 0.35 : 0.6,
                  Material::kWood});
          continue;
        }
        if (i == bay_window && i != door) {
          AddBayWindow(x, z, bay);
          continue;
        }
        // Closed shutters and drawn curtains return the pulse, panes do not.
        const Material filling = random_->Chance(0.5) ? Material::kGlass : Material::kPlaster;
        const double half = std::min(random_->Uniform(0.5, 0.75), 0.42 * bay);
        AddBay(x, z, bay, {0.5 * bay - half, 0.5 * bay + half, 0.95, 2.4, 0.18, filling});
        if (floor > 0 && i == balcony) {
          AddBalcony(x, z, bay);
        }
      }
    }
    // Plinth, left open at the door.
    const double gap = garage ? 1.3 : 0.6;
    const double middle = (door + 0.5) * bay;
    AddBoxHere(Vec3(0, -0.05, 0), Vec3(std::max(0.01, middle - gap), 0, kPlinthM),
               Material::kConcrete);
    AddBoxHere(Vec3(std::min(width_m - 0.01, middle + gap), -0.05, 0), Vec3(width_m, 0, kPlinthM),
               Material::kConcrete);
    const Vec3 pipe(0.25, -0.09, 0);
    AddFrustum(T_ * pipe, T_ * (pipe + Vec3(0, 0, floors * kFloorM)), 0.05, 0.05, 8,
               On(Material::kSteel), mesh_);
  }

 private:
  Surface On(Material material) const { return {Label::kBuilding, material, instance_}; }

  void AddBoxHere(const Vec3& low, const Vec3& high, Material material) {
    AddBox(T_, low, high, On(material), mesh_);
  }

  void AddRectangle(double x0, double x1, double z0, double z1, double y, Material material) {
    mesh_->AddQuad(T_ * Vec3(x0, y, z0), T_ * Vec3(x1, y, z0), T_ * Vec3(x1, y, z1),
                   T_ * Vec3(x0, y, z1), On(material));
  }

  void AddBay(double x, double z, double width, const Opening& o) {
    const double l = x + o.left;
    const double r = x + o.right;
    const double b = z + o.bottom;
    const double t = z + o.top;
    AddRectangle(x, l, z, z + kFloorM, 0, Material::kPlaster);
    AddRectangle(r, x + width, z, z + kFloorM, 0, Material::kPlaster);
    AddRectangle(l, r, z, b, 0, Material::kPlaster);
    AddRectangle(l, r, t, z + kFloorM, 0, Material::kPlaster);
    AddRectangle(l, r, b, t, o.recess_m, o.filling);
    const auto reveal = [&](const Vec3& from, const Vec3& to) {
      const Vec3 back(0, o.recess_m, 0);
      mesh_->AddQuad(T_ * from, T_ * to, T_ * (to + back), T_ * (from + back),
                     On(Material::kPlaster));
    };
    reveal(Vec3(l, 0, b), Vec3(l, 0, t));
    reveal(Vec3(r, 0, b), Vec3(r, 0, t));
    reveal(Vec3(l, 0, b), Vec3(r, 0, b));
    reveal(Vec3(l, 0, t), Vec3(r, 0, t));
    if (o.bottom > 0.5) {  // Sill.
      AddBoxHere(Vec3(l - 0.05, -0.08, b - 0.04), Vec3(r + 0.05, 0, b), Material::kConcrete);
    }
    if (o.bottom > 0.5 && o.filling == Material::kGlass) {  // Frame and glazing bar.
      const double y = o.recess_m - 0.03;
      for (const double at : {l, 0.5 * (l + r) - 0.035, r - 0.07}) {
        AddBoxHere(Vec3(at, y, b), Vec3(at + 0.07, o.recess_m, t), Material::kWood);
      }
    }
  }

  void AddBayWindow(double x, double z, double width) {
    constexpr double kOutM = 0.6;
    AddRectangle(x, x + width, z, z + kFloorM, 0, Material::kPlaster);
    const double l = x + 0.15 * width;
    const double r = x + 0.85 * width;
    AddBoxHere(Vec3(l, -kOutM, z), Vec3(r, 0, z + 0.9), Material::kPlaster);
    AddBoxHere(Vec3(l, -kOutM, z + 2.4), Vec3(r, 0, z + kFloorM), Material::kPlaster);
    AddBoxHere(Vec3(l + 0.06, -kOutM + 0.06, z + 0.9), Vec3(r - 0.06, 0, z + 2.4),
               Material::kGlass);
    for (const double at : {l, 0.5 * (l + r) - 0.06, r - 0.12}) {
      AddBoxHere(Vec3(at, -kOutM, z + 0.9), Vec3(at + 0.12, -kOutM + 0.12, z + 2.4),
                 Material::kPlaster);
    }
  }

  void AddBalcony(double x, double z, double width) {
    AddBoxHere(Vec3(x + 0.1, -1.2, z - 0.15), Vec3(x + width - 0.1, 0, z), Material::kConcrete);
    AddBoxHere(Vec3(x + 0.1, -1.2, z + 0.1), Vec3(x + width - 0.1, -1.16, z + 1.0),
               Material::kWood);
  }

  SE3d T_;
  std::uint16_t instance_;
  Random* random_;
  Mesh* mesh_;
};

}  // namespace

void AddHouse(const House& house, const SE3d& T_mesh_house, std::uint16_t instance, Random* random,
              Mesh* mesh) {
  const double w = house.width_m;
  const double d = house.depth_m;
  const double top = house.floors * kFloorM;
  Wall(T_mesh_house, instance, random, mesh).Add(w, house.floors);
  Wall(T_mesh_house * Placement(w, 0, 0, M_PI / 2), instance, random, mesh).Add(d, house.floors);
  Wall(T_mesh_house * Placement(w, d, 0, M_PI), instance, random, mesh).Add(w, house.floors);
  Wall(T_mesh_house * Placement(0, d, 0, -M_PI / 2), instance, random, mesh).Add(d, house.floors);
  // Ridge along the front, eaves 0.4 m out.
  const Surface roof{Label::kBuilding, Material::kConcrete, instance};
  const Vec3 ridge_a = T_mesh_house * Vec3(-0.3, 0.5 * d, top + 0.35 * d);
  const Vec3 ridge_b = T_mesh_house * Vec3(w + 0.3, 0.5 * d, top + 0.35 * d);
  for (const double y : {-0.4, d + 0.4}) {
    mesh->AddQuad(T_mesh_house * Vec3(-0.3, y, top - 0.25),
                  T_mesh_house * Vec3(w + 0.3, y, top - 0.25), ridge_b, ridge_a, roof);
  }
  for (const double x : {0., w}) {
    mesh->AddTriangle(T_mesh_house * Vec3(x, 0, top), T_mesh_house * Vec3(x, d, top),
                      T_mesh_house * Vec3(x, 0.5 * d, top + 0.35 * d),
                      {Label::kBuilding, Material::kPlaster, instance});
  }
}

}  // namespace icpscape
