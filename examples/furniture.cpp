// examples/furniture.cpp: see the header.
#include "examples/furniture.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "examples/fixed_random.h"
#include "examples/lamps_and_plant.h"
#include "examples/tableware.h"

namespace foretouch::examples {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

void addDiningTable(MeshBuilder& mesh, const Isometry3d& frame) {
  mesh.begin("table", frame);
  mesh.box({-0.85, 0.725, -0.45}, {0.85, 0.75, 0.45});
  mesh.box({-0.75, 0.65, -0.36}, {0.75, 0.725, -0.34});
  mesh.box({-0.75, 0.65, 0.34}, {0.75, 0.725, 0.36});
  for (const double x : {-0.76, 0.76}) {
    for (const double z : {-0.36, 0.36}) {
      mesh.tube({{x, 0, z}, {x, 0.4, z}, {x, 0.725, z}}, 0.025, 20);
    }
  }
  addTableware(mesh, frame * standingAt(0, 0.75, 0));
  addTableLamp(mesh, frame * standingAt(-0.72, 0.75, 0.0));
}

/// A chair that faces +Z; its slatted back is at -Z.
void addChair(MeshBuilder& mesh, const std::string& name, const Isometry3d& frame) {
  mesh.begin(name, frame);
  mesh.cushion({0, 0.455, 0}, {0.215, 0.018, 0.21}, 6.0, 16, 40);
  for (const double x : {-0.18, 0.18}) {
    mesh.tube({{1.1 * x, 0.001, 0.19}, {x, 0.45, 0.17}}, 0.014, 12);
    mesh.tube({{1.1 * x, 0.001, -0.20}, {x, 0.45, -0.18}, {x, 0.7, -0.20}, {x, 0.95, -0.24}}, 0.013,
              12);
  }
  const auto back = [](double x, double up) -> Vector3d {  // leans and curves a little
    return {x, 0.5 + 0.43 * up, -0.185 - 0.05 * up - 0.03 * (1.0 - x * x / 0.0324)};
  };
  for (const double up : {0.0, 1.0}) {
    std::vector<Vector3d> rail;
    for (int i = 0; i <= 8; ++i) {
      rail.push_back(back(-0.18 + 0.045 * i, up));
    }
    mesh.tube(rail, 0.010, 12);
  }
  for (int i = 0; i < 5; ++i) {
    const double x = -0.12 + 0.06 * i;
    mesh.tube({back(x, 0.0), back(x, 0.33), back(x, 0.67), back(x, 1.0)}, 0.006, 10);
  }
}

void addSofa(MeshBuilder& mesh, const Isometry3d& frame) {
  mesh.begin("sofa", frame);
  mesh.cushion({0, 0.24, 0}, {0.98, 0.14, 0.42}, 8.0, 16, 48);
  mesh.cushion({0, 0.52, -0.36}, {0.98, 0.34, 0.11}, 6.0, 20, 48);
  for (const double x : {-0.93, 0.93}) {
    mesh.cushion({x, 0.38, 0}, {0.11, 0.26, 0.43}, 5.0, 18, 36);
    for (const double z : {-0.34, 0.34}) {
      mesh.tube({{x, 0, z}, {x, 0.12, z}}, 0.02, 12);
    }
  }
  for (int i = 0; i < 3; ++i) {
    const std::string suffix = "_" + std::to_string(i + 1);
    mesh.begin("seat_cushion" + suffix, frame);
    mesh.cushion({-0.545 + 0.545 * i, 0.45, 0.07}, {0.268, 0.085, 0.34}, 4.0, 28, 48);
    mesh.begin("back_cushion" + suffix, frame * Eigen::AngleAxisd(-0.2, Vector3d::UnitX()));
    mesh.cushion({-0.545 + 0.545 * i, 0.72, 0.01}, {0.262, 0.21, 0.09}, 3.2, 28, 48);
  }
  mesh.begin("throw_pillow", frame * standingAt(0.62, 0.68, 0.1, -25.0) *
                                 Eigen::AngleAxisd(-0.35, Vector3d::UnitX()));
  mesh.cushion({0, 0, 0}, {0.19, 0.19, 0.07}, 2.6, 28, 48);
}

/// A glass top 8 mm thick on thin legs, with a rack of rods under it.
void addCoffeeTable(MeshBuilder& mesh, const Isometry3d& frame) {
  mesh.begin("coffee_table_top", frame);
  mesh.box({-0.5, 0.412, -0.27}, {0.5, 0.42, 0.27});
  mesh.begin("coffee_table_legs", frame);
  for (const double x : {-0.46, 0.46}) {
    for (const double z : {-0.23, 0.23}) {
      mesh.tube({{x, 0, z}, {x, 0.2, z}, {x, 0.412, z}}, 0.010, 12);
    }
    mesh.tube({{x, 0.15, -0.23}, {x, 0.15, 0.23}}, 0.006, 10);
  }
  mesh.begin("coffee_table_rack", frame);
  for (int i = 0; i < 9; ++i) {
    const double z = -0.2 + 0.05 * i;
    mesh.tube({{-0.46, 0.156, z}, {0.0, 0.154, z}, {0.46, 0.156, z}}, 0.004, 8);
  }
  mesh.begin("magazines", frame);
  for (int i = 0; i < 4; ++i) {
    mesh.box({-0.38 + 0.01 * i, 0.42 + 0.008 * i, -0.12},
             {-0.17 - 0.01 * i, 0.427 + 0.008 * i, 0.17});
  }
  addVase(mesh, "vase_glass", frame * standingAt(0.22, 0.42, 0.02), 0.26);
}

void addBooks(MeshBuilder& mesh, const Isometry3d& frame, int shelf, double floorY, double toX) {
  mesh.begin("books_" + std::to_string(shelf), frame);
  FixedRandom random(20 + static_cast<std::uint64_t>(shelf));
  double x = -0.8;
  while (x < toX) {
    const double thick = random.uniform(0.014, 0.045);
    const double high = random.uniform(0.20, 0.29), deep = random.uniform(0.15, 0.22);
    mesh.box({x, floorY, -0.12}, {x + thick, floorY + high, -0.12 + deep});
    x += thick + (random.uniform(0.0, 1.0) < 0.1 ? 0.06 : 0.0015);
  }
}

/// A shelf that is open to both sides, along x, its front towards +Z.
void addShelf(MeshBuilder& mesh, const Isometry3d& frame) {
  mesh.begin("shelf", frame);
  for (const double x : {-0.84, 0.0, 0.82}) {
    mesh.box({x, 0, -0.14}, {x + 0.02, 1.84, 0.14});
  }
  for (int i = 0; i < 6; ++i) {
    const double y = 0.06 + 0.35 * i;
    mesh.box({-0.82, y, -0.14}, {0.0, y + 0.02, 0.14});
    mesh.box({0.02, y, -0.14}, {0.82, y + 0.02, 0.14});
  }
  constexpr double kFilledTo[] = {0.7, -0.1, 0.35, -0.25, 0.72};
  for (int i = 0; i < 5; ++i) {
    addBooks(mesh, frame, i + 1, 0.08 + 0.35 * i, kFilledTo[i] - 0.05);
  }
  addVase(mesh, "vase_tall", frame * standingAt(0.35, 0.43, 0), 0.27);
  addVase(mesh, "vase_small", frame * standingAt(0.2, 1.13, 0), 0.18);
  addVase(mesh, "vase_top", frame * standingAt(-0.5, 1.83, 0), 0.36);
  mesh.begin("globe", frame);
  mesh.cushion({0.55, 1.28, 0.0}, {0.11, 0.11, 0.11}, 2.0, 28, 44);
  mesh.tube({{0.55, 1.13, 0}, {0.55, 1.17, 0}}, 0.03, 16);
}

void addRadiator(MeshBuilder& mesh, const Isometry3d& frame) {
  mesh.begin("radiator", frame);
  for (int i = 0; i < 18; ++i) {
    mesh.cushion({-0.51 + 0.06 * i, 0.42, 0}, {0.024, 0.29, 0.045}, 4.0, 10, 14);
  }
}

void addPicture(MeshBuilder& mesh, const std::string& name, const Isometry3d& frame, double width,
                double height) {
  mesh.begin(name, frame);
  const double w = 0.5 * width, h = 0.5 * height, rim = 0.02;
  mesh.box({-w, -h, 0.001}, {w, -h + rim, 0.025});
  mesh.box({-w, h - rim, 0.001}, {w, h, 0.025});
  mesh.box({-w, -h + rim, 0.001}, {-w + rim, h - rim, 0.025});
  mesh.box({w - rim, -h + rim, 0.001}, {w, h - rim, 0.025});
  mesh.box({-w + rim, -h + rim, 0.002}, {w - rim, h - rim, 0.008});
}

}  // namespace

void addFurniture(MeshBuilder& mesh) {
  const Isometry3d table = standingAt(1.95, 0, 0.75);
  addDiningTable(mesh, table);
  addPendantLamp(mesh, "_1", table * standingAt(-0.45, 2.7, 0));
  addPendantLamp(mesh, "_2", table * standingAt(0.45, 2.7, 0));
  addChair(mesh, "chair_1", table * standingAt(-0.42, 0, -0.68, 4.0));
  addChair(mesh, "chair_2", table * standingAt(0.45, 0, -0.62, -3.0));
  addChair(mesh, "chair_3", table * standingAt(-0.42, 0, 0.66, 176.0));
  addChair(mesh, "chair_4", table * standingAt(0.42, 0, 0.75, 205.0));
  addSofa(mesh, standingAt(-2.95, 0, 1.05, 90.0));
  addCoffeeTable(mesh, standingAt(-1.75, 0, 1.15, 90.0));
  addShelf(mesh, standingAt(0.2, 0, 2.84, 180.0));
  addFloorLamp(mesh, standingAt(-0.75, 0, 0.15));
  addPlant(mesh, standingAt(-0.35, 0, -2.3));
  addRadiator(mesh, standingAt(3.42, 0, 1.0, -90.0));
  addPicture(mesh, "picture_1", standingAt(-0.6, 1.6, -2.995), 0.9, 0.6);
  addPicture(mesh, "picture_2", standingAt(-3.495, 1.7, 0.7, 90.0), 0.5, 0.7);
  addPicture(mesh, "picture_3", standingAt(-3.495, 1.7, 1.4, 90.0), 0.5, 0.7);
}

}  // namespace foretouch::examples
