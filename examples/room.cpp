// examples/room.cpp: see the header.
#include "examples/room.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "examples/circle.h"
#include "examples/fixed_random.h"

namespace foretouch::examples {
namespace {

using Eigen::Vector3d;

/// An opening in a wall, along the wall and upwards.
struct Opening {
  double left, right, bottom, top;
};

/// A wall along the frame's x from 0 to `length`, 12 cm thick towards -z, with one opening.
void wallWithOpening(MeshBuilder& mesh, double length, const Opening& hole) {
  constexpr double kThick = 0.12;
  mesh.box({0, 0, -kThick}, {hole.left, kWallHeight, 0});
  mesh.box({hole.right, 0, -kThick}, {length, kWallHeight, 0});
  mesh.box({hole.left, hole.top, -kThick}, {hole.right, kWallHeight, 0});
  if (hole.bottom > 0.0) {
    mesh.box({hole.left, 0, -kThick}, {hole.right, hole.bottom, 0});
  }
}

void addFloorAndWalls(MeshBuilder& mesh) {
  mesh.begin("floor");
  mesh.surface(40, 46, false, [](double u, double v) -> Vector3d {
    return {kHalfWidth * (2.0 * v - 1.0), 0.0, kHalfDepth * (1.0 - 2.0 * u)};
  });
  mesh.begin("wall_back");
  mesh.box({-kHalfWidth, 0, -kHalfDepth - 0.12}, {kHalfWidth, kWallHeight, -kHalfDepth});
  mesh.begin("wall_front");
  mesh.box({-kHalfWidth, 0, kHalfDepth}, {kHalfWidth, kWallHeight, kHalfDepth + 0.12});
  mesh.begin("wall_door", standingAt(-kHalfWidth, 0, kHalfDepth, 90.0));
  wallWithOpening(mesh, 2.0 * kHalfDepth, {4.5, 5.4, 0.0, 2.05});
  mesh.begin("wall_window", standingAt(kHalfWidth, 0, -kHalfDepth, -90.0));
  wallWithOpening(mesh, 2.0 * kHalfDepth, {3.2, 4.8, 0.9, 2.2});
  mesh.begin("skirting");
  mesh.box({-kHalfWidth, 0, -kHalfDepth}, {0.2, 0.08, -kHalfDepth + 0.012});
  mesh.box({-kHalfWidth, 0, kHalfDepth - 0.012}, {kHalfWidth, 0.08, kHalfDepth});
  mesh.box({kHalfWidth - 0.012, 0, -2.1}, {kHalfWidth, 0.08, kHalfDepth});
}

void addDoor(MeshBuilder& mesh) {
  mesh.begin("door", standingAt(-kHalfWidth + 0.02, 0.01, -2.4, 5.0));  // open, against the wall
  mesh.box({0, 0, -0.02}, {0.88, 2.02, 0.02});
  mesh.begin("door_handle", standingAt(-kHalfWidth + 0.02, 0.01, -2.4, 5.0));
  mesh.tube({{0.82, 1.02, 0.02}, {0.82, 1.02, 0.07}, {0.81, 1.02, 0.075}, {0.70, 1.02, 0.075}},
            0.008, 10);
  mesh.begin("door_frame");
  for (const double z : {-2.43, -1.47}) {
    mesh.box({-kHalfWidth - 0.13, 0, z - 0.03}, {-kHalfWidth + 0.015, 2.08, z + 0.03});
  }
  mesh.box({-kHalfWidth - 0.13, 2.05, -2.46}, {-kHalfWidth + 0.015, 2.11, -1.44});
}

void addWindow(MeshBuilder& mesh) {
  mesh.begin("window_frame", standingAt(kHalfWidth + 0.06, 0, -kHalfDepth, -90.0));
  for (const double x : {3.2, 3.98, 4.76}) {
    mesh.box({x, 0.9, -0.02}, {x + 0.04, 2.2, 0.02});
  }
  for (const double y : {0.9, 1.7, 2.16}) {
    mesh.box({3.2, y, -0.02}, {4.8, y + 0.04, 0.02});
  }
  mesh.begin("window_glass", standingAt(kHalfWidth + 0.06, 0, -kHalfDepth, -90.0));
  mesh.surface(1, 1, false, [](double u, double v) -> Vector3d {
    return {3.2 + 1.6 * v, 0.9 + 1.3 * u, 0.0};
  });
  mesh.begin("window_sill");
  mesh.box({kHalfWidth - 0.14, 0.87, 0.12}, {kHalfWidth, 0.9, 1.88});
}

/// A sheet of no thickness that hangs in folds between z0 and z1.
void addCurtain(MeshBuilder& mesh, const std::string& name, double z0, double z1) {
  mesh.begin(name);
  mesh.surface(16, 84, false, [&](double u, double v) -> Vector3d {
    const double fold = 0.035 * std::sin(2.0 * kPi * 7.0 * v) * (0.7 + 0.5 * (1.0 - u));
    return {kHalfWidth - 0.2 + fold, 0.03 + 2.33 * u, z0 + (z1 - z0) * v};
  });
}

void addWindowCurtains(MeshBuilder& mesh) {
  addCurtain(mesh, "curtain_left", -0.35, 0.3);
  addCurtain(mesh, "curtain_right", 1.7, 2.35);
  mesh.begin("curtain_rod");
  mesh.tube({{kHalfWidth - 0.2, 2.38, -0.45}, {kHalfWidth - 0.2, 2.38, 2.45}}, 0.012, 12);
}

constexpr int kTreads = 13;
constexpr double kRise = 0.19, kRun = 0.25, kStairX = 0.2, kRailZ = -2.08;

void addStaircase(MeshBuilder& mesh) {
  mesh.begin("stairs");
  for (int i = 0; i < kTreads; ++i) {  // open treads: 4 cm boards on two slanted beams
    const double y = (i + 1) * kRise, x = kStairX + i * kRun;
    mesh.box({x - 0.02, y - 0.04, -kHalfDepth}, {x + kRun, y, -2.02});
  }
  for (const double z : {-2.93, -2.15}) {
    mesh.surface(1, 4, true, [&](double u, double v) -> Vector3d {
      const double x = kStairX + 0.02 + u * (kTreads * kRun - 0.06);
      const double around = 2.0 * kPi * (v + 0.125);
      const double middle = 0.05 + u * (kTreads * kRise - 0.12);
      return {x, std::max(0.0, middle + 0.08 * std::sin(around)), z + 0.03 * std::cos(around)};
    });
  }
  mesh.begin("railing_bars");
  for (int i = 0; i < kTreads; ++i) {
    const double x = kStairX + (i + 0.5) * kRun, y = (i + 1) * kRise;
    mesh.tube({{x, y, kRailZ}, {x, y + 0.3, kRailZ}, {x, y + 0.6, kRailZ}, {x, y + 0.9, kRailZ}},
              0.007, 12);
  }
  mesh.begin("handrail");
  const auto rail = [](double i) -> Vector3d {
    return {kStairX + (i + 0.5) * kRun, (i + 1) * kRise + 0.92, kRailZ};
  };
  mesh.tube({rail(-0.3), rail(3), rail(6), rail(9), rail(kTreads - 0.8)}, 0.022, 16);
}

/// Cords 6 cm apart between the entrance and the room, each swaying in its own way.
void addStringCurtain(MeshBuilder& mesh) {
  constexpr double kX = -1.7, kFromZ = -2.97, kToZ = -0.75, kTop = 2.3;
  mesh.begin("string_curtain_rail");
  mesh.tube({{kX, kTop, kFromZ - 0.03}, {kX, kTop, kToZ}}, 0.014, 12);
  mesh.begin("string_curtain_post");
  mesh.tube({{kX, 0.0, kToZ}, {kX, 1.0, kToZ}, {kX, kTop + 0.05, kToZ}}, 0.018, 14);
  mesh.begin("string_curtain");
  FixedRandom random(11);
  for (double z = kFromZ + 0.06; z < kToZ - 0.05; z += 0.06) {
    const double sway = random.uniform(-0.02, 0.02), drift = random.uniform(-0.012, 0.012);
    const double end = random.uniform(0.05, 0.12);
    std::vector<Vector3d> line;
    constexpr int kPieces = 22;
    for (int i = 0; i <= kPieces; ++i) {
      const double down = static_cast<double>(i) / kPieces;
      line.emplace_back(kX + sway * std::sin(4.0 * down) * down, kTop - down * (kTop - end),
                        z + drift * down * down);
    }
    mesh.tube(line, 0.0025, 6);
  }
}

void addRug(MeshBuilder& mesh) {
  mesh.begin("rug", standingAt(-1.85, 0, 1.05));
  mesh.surface(30, 40, false, [](double u, double v) -> Vector3d {
    const double ripple = std::sin(9.0 * u + 4.0 * v) * std::sin(5.0 * v - 3.0 * u);
    return {0.95 * (2.0 * v - 1.0), 0.007 + 0.002 * ripple, 1.25 * (1.0 - 2.0 * u)};
  });
  mesh.begin("rug_fringe", standingAt(-1.85, 0, 1.05));
  FixedRandom random(12);
  for (const double side : {-1.0, 1.0}) {
    for (int i = 0; i < 64; ++i) {
      const double x = -0.94 + 0.03 * i;
      mesh.tube({{x, 0.006, side * 1.25}, {x + random.uniform(-0.015, 0.015), 0.004, side * 1.31}},
                0.002, 5);
    }
  }
}

}  // namespace

void addRoom(MeshBuilder& mesh) {
  addFloorAndWalls(mesh);
  addDoor(mesh);
  addWindow(mesh);
  addWindowCurtains(mesh);
  addStaircase(mesh);
  addStringCurtain(mesh);
  addRug(mesh);
}

}  // namespace foretouch::examples
