#include <cmath>

#include "assets/import/assimp.h"
#include "assets/import/urdf_surface.h"
#include "lss/rounding.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;

constexpr int kSides = 32;
constexpr double kPi = 3.14159265358979323846;

}  // namespace

FlatMesh boxOf(const Vector3d& size) {
  FlatMesh box;
  for (int i = 0; i < 8; ++i) {
    const Vector3d sign((i & 1) != 0 ? 0.5 : -0.5, (i & 2) != 0 ? 0.5 : -0.5,
                        (i & 4) != 0 ? 0.5 : -0.5);
    box.vertices.push_back(sign.cwiseProduct(size));
  }
  // Corners of each side in turn about it; bit k of a corner's number is its side along axis k.
  constexpr std::array<std::array<std::int32_t, 4>, 6> kSidesOfBox = {
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  for (const auto& side : kSidesOfBox) {
    box.triangles.push_back({side[0], side[1], side[2]});
    box.triangles.push_back({side[0], side[2], side[3]});
  }
  return box;
}

FlatMesh cylinderAround(double radius, double length) {
  FlatMesh prism;
  const double corner = radius / std::cos(kPi / kSides) * kInflation;
  const double halfLength = length / 2 * kInflation;
  for (int i = 0; i < kSides; ++i) {
    const double angle = 2 * kPi * i / kSides;
    const double x = corner * std::cos(angle), y = corner * std::sin(angle);
    prism.vertices.emplace_back(x, y, -halfLength);
    prism.vertices.emplace_back(x, y, halfLength);
  }
  for (std::int32_t i = 0; i < kSides; ++i) {
    const std::int32_t low = 2 * i, next = 2 * ((i + 1) % kSides);
    prism.triangles.push_back({low, next, next + 1});
    prism.triangles.push_back({low, next + 1, low + 1});
    if (i == 0 || i + 1 == kSides) continue;
    prism.triangles.push_back({0, next, low});
    prism.triangles.push_back({1, low + 1, next + 1});
  }
  return prism;
}

Affine affineOf(const urdf::Pose& pose, const std::string& owner) {
  const urdf::Rotation& r = pose.rotation;
  const Quaternion q(r.w, r.x, r.y, r.z);
  const Vector3d p(pose.position.x, pose.position.y, pose.position.z);
  const double norm = q.norm();
  if (!(norm > 0.0) || !std::isfinite(norm) || !(p.cwiseAbs().maxCoeff() <= kMaxCoordinate) ||
      !p.allFinite()) {
    throw Failure{ImportFailure::Refused, "the origin of " + owner + " is not finite, or beyond " +
                                              std::to_string(static_cast<long>(kMaxCoordinate)) +
                                              " m"};
  }
  return {q.normalized().toRotationMatrix(), p};
}

}  // namespace foretouch::internal
