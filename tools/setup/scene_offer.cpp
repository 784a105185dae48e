#include "tools/setup/scene_offer.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "lss/index.h"
#include "tools/settings/plain_figures.h"
#include "tools/setup/level.h"
#include "tools/setup/walkable_floor.h"

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;

/// So much lower than wide that the height shows which axis it is.
constexpr double kClearlyLower = 1.3;
/// So much of an axis's level area faces one way, that it is floors and not walls' two sides.
constexpr double kClearlyUp = 0.75, kNotUp = 0.6;
/// A level of this size (m) at least; a single thing is smaller, and may lie any way.
constexpr double kSmallestLevel = 5.0;

/// Level in which a person walks (m): its height, and its largest side.
constexpr double kLowestLevel = 1.5, kHighestLevel = 60.0, kLargestLevel = 3000.0;
/// Above this, metres are less likely than centimetres.
constexpr double kTooHigh = 200.0;
/// The share of the ground plan that must be floor with room for a person.
constexpr double kEnoughRoom = 0.05;

Vector3d sizeOf(const RawScene& raw) {
  const Eigen::AlignedBox3d box = boundsOf(raw);
  return box.isEmpty() ? Vector3d::Zero() : Vector3d(box.sizes());
}

/// The share that faces up of the area that is level when `axis` is up.
double shareFacingUp(const RawScene& raw, int axis) {
  double up = 0.0, all = 0.0;
  for (const Triangle& triangle : raw.triangles) {
    const auto& [a, b, c] = triangle.vertices;
    const Vector3d area = (b - a).cross(c - a);
    const double size = area.norm();
    if (!std::isfinite(size) || std::abs(area[axis]) < 0.85 * size) continue;
    all += size;
    up += area[axis] > 0.0 ? size : 0.0;
  }
  return all > 0.0 ? up / all : 0.5;
}

/// Whether there is floor on which a person finds room, in this unit.
bool hasRoom(const RawScene& raw, double unit) {
  RawScene scaled = raw;
  for (Triangle& triangle : scaled.triangles) {
    for (Vector3d& vertex : triangle.vertices) vertex *= unit;
  }
  const auto level = Level::build(std::move(scaled));
  if (!level.ok()) return false;
  const SceneAudit& audit = level.value().scene().audit();
  const Vector3d size = audit.boxMax - audit.boxMin;
  const auto floor =
      WalkableFloor::build(level.value(), BodyRoom{}, 0.5 * (audit.boxMin + audit.boxMax), nullptr);
  return floor.ok() && floor.value().area() > kEnoughRoom * size.x() * size.z();
}

std::string sizeText(const Vector3d& size) {
  return plainFigures(size.x()) + " x " + plainFigures(size.y()) + " x " + plainFigures(size.z());
}

}  // namespace

Offer<UpAxis> sceneUpAxisOf(const RawScene& raw) {
  const Vector3d size = sizeOf(raw);
  const double upY = shareFacingUp(raw, 1), upZ = shareFacingUp(raw, 2);
  const bool yIsLow = size.z() > kClearlyLower * size.y();
  const bool zIsLow = size.y() > kClearlyLower * size.z();
  const bool yFacesUp = upY >= kClearlyUp && upZ < kNotUp;
  const bool zFacesUp = upZ >= kClearlyUp && upY < kNotUp;
  const bool isThing = size.maxCoeff() < kSmallestLevel;
  const std::string extent = "it is " + sizeText(size) + " along x, y, z";
  if (yFacesUp != zFacesUp) {
    const bool agrees = yFacesUp ? !zIsLow : !yIsLow;
    return {yFacesUp ? UpAxis::Y : UpAxis::Z, agrees && !isThing,
            fmt::format("{:.0f} % of the surfaces across {} show their front along it, and {}",
                        100.0 * (yFacesUp ? upY : upZ), yFacesUp ? "y" : "z", extent)};
  }
  if (yIsLow != zIsLow) {
    return {yIsLow ? UpAxis::Y : UpAxis::Z, !isThing, extent + ", and levels are lower than wide"};
  }
  return {UpAxis::Y, false, extent + ", about as high as wide"};
}

Offer<double> sceneUnitOf(const RawScene& raw) {
  const Vector3d size = sizeOf(raw);
  const auto inMetres = [&](double unit) { return "it is " + sizeText(unit * size) + " m"; };
  if (size.y() < kTooHigh) {
    const bool isLevel = size.y() >= kLowestLevel && size.y() <= kHighestLevel &&
                         size.maxCoeff() >= kSmallestLevel && size.maxCoeff() <= kLargestLevel;
    return {1.0, isLevel, "in metres " + inMetres(1.0)};
  }
  for (const double unit : {0.001, 0.01}) {
    if (size.y() * unit < kLowestLevel || size.maxCoeff() * unit < kSmallestLevel) continue;
    if (!hasRoom(raw, unit)) continue;
    return {unit, false,
            fmt::format("in {} {}, with room for a person",
                        unit == 0.001 ? "millimetres" : "centimetres", inMetres(unit))};
  }
  return {1.0, false, "in metres " + inMetres(1.0) + "; no other unit leaves room for a person"};
}

}  // namespace foretouch::tools
