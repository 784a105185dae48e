// examples/tableware.cpp: see the header.
#include "examples/tableware.h"

#include <array>
#include <cmath>
#include <string>

#include "lss/index.h"

namespace foretouch::examples {
namespace {

using Eigen::Vector3d;

void addPlate(MeshBuilder& mesh, const std::string& name, const Eigen::Isometry3d& frame) {
  mesh.begin(name, frame);
  mesh.revolve(Vector3d::Zero(),
               {{0, 0.001},
                {0.07, 0.001},
                {0.09, 0.005},
                {0.13, 0.018},
                {0.132, 0.020},
                {0.129, 0.021},
                {0.09, 0.009},
                {0.07, 0.005},
                {0, 0.005}},
               40);
}

void addCup(MeshBuilder& mesh, const std::string& name, const Eigen::Isometry3d& frame) {
  mesh.begin(name, frame);
  mesh.revolve(Vector3d::Zero(),
               {{0, 0.002},
                {0.025, 0.0},
                {0.028, 0.004},
                {0.036, 0.03},
                {0.040, 0.06},
                {0.041, 0.09},
                {0.038, 0.09},
                {0.037, 0.06},
                {0.033, 0.03},
                {0.024, 0.008},
                {0, 0.007}},
               32);
  std::vector<Vector3d> handle;
  for (int i = 0; i <= 12; ++i) {
    const double angle = 3.14159265358979323846 * (i / 12.0 - 0.5);
    handle.emplace_back(0.037 + 0.026 * std::cos(angle), 0.05 + 0.025 * std::sin(angle), 0.0);
  }
  mesh.tube(handle, 0.004, 8);
}

void addCutlery(MeshBuilder& mesh, const std::string& name, const Eigen::Isometry3d& frame) {
  mesh.begin(name, frame);
  for (const double x : {-0.17, 0.17}) {
    mesh.tube({{x, 0.004, 0.10}, {x, 0.006, 0.0}, {x, 0.004, -0.05}}, 0.004, 8);
    mesh.cushion({x, 0.006, -0.08}, {0.011, 0.004, 0.035}, 2.0, 8, 12);
  }
}

void addFruitBowl(MeshBuilder& mesh, const Eigen::Isometry3d& frame) {
  mesh.begin("fruit_bowl", frame);
  mesh.revolve(Vector3d::Zero(),
               {{0, 0.002},
                {0.05, 0.0},
                {0.055, 0.008},
                {0.10, 0.03},
                {0.135, 0.065},
                {0.14, 0.07},
                {0.136, 0.071},
                {0.10, 0.037},
                {0.05, 0.014},
                {0, 0.012}},
               48);
  mesh.begin("oranges", frame);
  constexpr std::array<std::array<double, 3>, 5> kPlaces = {{{0.05, 0.06, 0.0},
                                                             {-0.035, 0.06, 0.045},
                                                             {-0.03, 0.06, -0.048},
                                                             {0.01, 0.115, 0.005},
                                                             {0.075, 0.085, -0.065}}};
  for (const auto& [x, y, z] : kPlaces) {
    mesh.cushion({x, y, z}, {0.036, 0.035, 0.036}, 2.0, 14, 20);
  }
}

}  // namespace

void addVase(MeshBuilder& mesh, const std::string& name, const Eigen::Isometry3d& frame,
             double height) {
  Profile profile = {{0, 0.002}};
  constexpr int kRings = 22;
  for (int i = 0; i <= kRings; ++i) {
    const double up = static_cast<double>(i) / kRings;
    const double belly = 0.22 + 0.15 * std::sin(4.2 * up) - 0.02 * up;
    profile.emplace_back(height * belly, height * up);
  }
  for (int i = kRings; i >= 2; --i) {  // the inner wall, 3 mm in
    profile.emplace_back(profile[slotOf(i) + 1].x() - 0.003, height * i / kRings);
  }
  mesh.begin(name, frame);
  mesh.revolve(Vector3d::Zero(), profile, 32);
}

void addTableware(MeshBuilder& mesh, const Eigen::Isometry3d& top) {
  constexpr std::array<std::array<double, 3>, 4> kSeats = {
      // x, z, yaw of the guest
      {{-0.42, -0.28, 0.0}, {0.42, -0.28, 0.0}, {-0.42, 0.28, 180.0}, {0.42, 0.28, 180.0}}};
  int number = 0;
  for (const auto& [x, z, yaw] : kSeats) {
    const std::string suffix = "_" + std::to_string(++number);
    const Eigen::Isometry3d seat = top * standingAt(x, 0.0, z, yaw);
    addPlate(mesh, "plate" + suffix, seat);
    addCup(mesh, "cup" + suffix, seat * standingAt(-0.21, 0.0, 0.13, 40.0));
    addCutlery(mesh, "cutlery" + suffix, seat);
  }
  addFruitBowl(mesh, top * standingAt(0.0, 0.0, 0.0));
}

}  // namespace foretouch::examples
