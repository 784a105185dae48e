// examples/lamps_and_plant.cpp: see the header.
#include "examples/lamps_and_plant.h"

#include <cmath>
#include <string>
#include <vector>

#include "examples/circle.h"
#include "examples/fixed_random.h"
#include "lss/index.h"

namespace foretouch::examples {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

/// An open cone; a sheet of no thickness, as lamp shades nearly are.
void addShade(MeshBuilder& mesh, double bottomY, double bottomR, double topY, double topR) {
  Profile profile;
  for (int i = 0; i <= 8; ++i) {
    const double up = i / 8.0;
    profile.emplace_back(bottomR + up * (topR - bottomR), bottomY + up * (topY - bottomY));
  }
  mesh.revolve(Vector3d::Zero(), profile, 48);
}

struct LeafShape {
  double length, width, droop, heading;  ///< Metres, metres, metres, radians.
};

void addLeaf(MeshBuilder& mesh, const Vector3d& root, const LeafShape& leaf) {
  const Vector3d out(std::sin(leaf.heading), 0.0, std::cos(leaf.heading));
  const Vector3d side(out.z(), 0.0, -out.x());
  mesh.surface(14, 4, false, [&](double u, double v) -> Vector3d {
    const double across = (v - 0.5) * leaf.width * std::pow(std::sin(kPi * (0.04 + 0.96 * u)), 0.8);
    const double rise = leaf.length * 0.55 * u - leaf.droop * u * u;
    const double fold = 0.25 * std::abs(across);
    return root + leaf.length * u * out + across * side + (rise + fold) * Vector3d::UnitY();
  });
}

}  // namespace

void addTableLamp(MeshBuilder& mesh, const Isometry3d& frame) {
  mesh.begin("table_lamp", frame);
  mesh.revolve(Vector3d::Zero(),
               {{0, 0.001}, {0.07, 0.001}, {0.072, 0.006}, {0.068, 0.012}, {0, 0.016}}, 36);
  mesh.tube({{0, 0.014, 0}, {0, 0.2, 0}, {0, 0.4, 0}}, 0.005, 12);
  mesh.begin("table_lamp_shade", frame);
  addShade(mesh, 0.33, 0.11, 0.48, 0.06);
}

void addFloorLamp(MeshBuilder& mesh, const Isometry3d& frame) {
  mesh.begin("floor_lamp", frame);
  mesh.revolve(Vector3d::Zero(),
               {{0, 0.001}, {0.14, 0.001}, {0.142, 0.01}, {0.135, 0.018}, {0, 0.022}}, 48);
  std::vector<Vector3d> pole;
  for (int i = 0; i <= 16; ++i) {
    pole.emplace_back(0.0, 0.02 + 1.6 * i / 16.0, 0.0);
  }
  mesh.tube(pole, 0.011, 16);
  mesh.begin("floor_lamp_shade", frame);
  addShade(mesh, 1.47, 0.20, 1.75, 0.13);
}

void addPendantLamp(MeshBuilder& mesh, const std::string& suffix, const Isometry3d& frame) {
  mesh.begin("pendant_cord" + suffix, frame);
  std::vector<Vector3d> cord;
  for (int i = 0; i <= 20; ++i) {
    cord.emplace_back(0.0, -0.0525 * i, 0.0);
  }
  mesh.tube(cord, 0.003, 8);
  mesh.begin("pendant_shade" + suffix, frame);
  addShade(mesh, -1.28, 0.20, -1.05, 0.03);
  mesh.begin("pendant_bulb" + suffix, frame);
  mesh.cushion({0, -1.17, 0}, {0.035, 0.045, 0.035}, 2.0, 18, 26);
}

void addPlant(MeshBuilder& mesh, const Isometry3d& frame) {
  mesh.begin("plant_pot", frame);
  mesh.revolve(Vector3d::Zero(),
               {{0, 0.001},
                {0.13, 0.0},
                {0.16, 0.15},
                {0.18, 0.30},
                {0.19, 0.32},
                {0.175, 0.32},
                {0.165, 0.28},
                {0, 0.28}},
               44);
  mesh.begin("plant", frame);
  FixedRandom random(31);
  constexpr int kStems = 9;
  for (int stem = 0; stem < kStems; ++stem) {
    const double heading = 2.0 * kPi * stem / kStems + random.uniform(-0.25, 0.25);
    const double height = random.uniform(0.55, 1.05), lean = random.uniform(0.08, 0.22);
    std::vector<Vector3d> line;
    for (int i = 0; i <= 8; ++i) {
      const double up = i / 8.0;
      line.emplace_back(lean * up * up * std::sin(heading), 0.28 + height * up,
                        lean * up * up * std::cos(heading));
    }
    mesh.tube(line, 0.004, 8);
    for (int i = 0; i < 6; ++i) {
      const Vector3d root = line[slotOf(3 + i)];
      addLeaf(mesh, root,
              {random.uniform(0.25, 0.42), random.uniform(0.035, 0.06), random.uniform(0.15, 0.35),
               heading + random.uniform(-1.4, 1.4)});
    }
  }
}

}  // namespace foretouch::examples
