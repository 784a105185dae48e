#include "middleware/pair/side.h"

#include <algorithm>

#include "lss/assert.h"
#include "lss/index.h"
#include "lss/rounding.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;

/// The rounding of a blended point, in its links' own: the second time covers the products and
/// sums of so many shares; more of them cost in proportion.
constexpr double kBlendedRounding = 2.0, kSharesCovered = 16.0;

/// Adds one link's share of a skinned vertex. `roundings` of a point's count for each.
void addInfluence(const SkinInfluence& influence, const LinkState& state,
                  const MotionBounds& bounds, double roundings, std::size_t corner,
                  MovingHull& moving) {
  const double w = influence.weight, rho = influence.p_L.norm() * kInflation;
  moving.hull.points[corner] += w * state.pointAt(influence.p_L);
  moving.velocity[corner] += w * state.velocityAt(influence.p_L);
  moving.acceleration[corner] += w * bounds.accelerationAt(rho) * kInflation;
  moving.positionRounding[corner] += roundings * w * bounds.positionRoundingAt(rho) * kInflation;
  moving.velocityRounding[corner] += roundings * w * bounds.velocityRoundingAt(rho) * kInflation;
}

MovingHull meshTriangle(const Side& parts, std::int32_t index, const LinkState& state) {
  const MotionBounds bounds = parts.bounds();
  MovingHull moving;
  moving.moves = true;
  moving.hull.count = 3;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3d& p_L = parts.surface->triangle(index).vertices[i];
    const double rho = p_L.norm() * kInflation;
    moving.hull.points[i] = state.pointAt(p_L);
    moving.velocity[i] = state.velocityAt(p_L);
    moving.acceleration[i] = bounds.accelerationAt(rho) * kInflation;
    moving.positionRounding[i] = bounds.positionRoundingAt(rho) * kInflation;
    moving.velocityRounding[i] = bounds.velocityRoundingAt(rho) * kInflation;
  }
  return moving;
}

}  // namespace

const Lss& Side::lssOf(std::int32_t lssIndex, Part part) const {
  FORETOUCH_ASSERT(!part.isTriangle());
  const auto index = slotOf(lssIndex);
  return part.isWhole() ? lss[index] : surface->hierarchy(lssIndex).node(part.index()).lss;
}

std::array<Part, 2> Side::below(std::int32_t lssIndex, Part part) const {
  const LssHierarchy& hierarchy = surface->hierarchy(lssIndex);
  HierarchyChild child = hierarchy.root();
  if (part.isWhole() && child.isTriangle()) return {Part::of(child), Part::of(child)};
  if (!part.isWhole()) child = HierarchyChild::node(part.index());
  const auto& children = hierarchy.node(child.index()).children;
  return {Part::of(children[0]), Part::of(children[1])};
}

MovingHull Side::hullAt(std::int32_t lssIndex, Part part, const LinkState& state) const {
  if (part.isTriangle()) return meshTriangle(*this, part.index(), state);
  const Lss& bound = lssOf(lssIndex, part);
  return MovingHull::of(
      bound, part.isWhole() ? axisBounds[slotOf(lssIndex)] : foretouch::axisBounds(bound, bounds()),
      state);
}

MovingHull Side::skinTriangle(std::int32_t index, const std::vector<LinkState>& states) const {
  MovingHull moving;
  moving.moves = true;
  moving.hull.count = 3;
  for (std::size_t i = 0; i < 3; ++i) {
    moving.hull.points[i].setZero();
    moving.velocity[i].setZero();
    const std::int32_t vertex = skin->triangle(link, index)[i];
    const std::vector<SkinInfluence>& influences = skin->skin.vertices[slotOf(vertex)];
    const double crowd = static_cast<double>(influences.size()) / kSharesCovered;
    for (const SkinInfluence& influence : influences) {
      addInfluence(influence, states[slotOf(influence.link)], motion().bounds(influence.link),
                   kBlendedRounding * std::max(1.0, crowd), i, moving);
    }
  }
  return moving;
}

Aabb Side::boxOfPoints(std::int32_t lssIndex, Part part, const PosedLink& posed) const {
  if (skin == nullptr || !part.isTriangle()) return boxAt(lssIndex, part, posed.state);
  Aabb box;
  for (const Vector3d& v : skinTriangle(part.index(), *posed.all).hull.points) box.add(v);
  return box;
}

Aabb Side::boxAt(std::int32_t lssIndex, Part part, const LinkState& state) const {
  Aabb box;
  if (part.isTriangle()) {
    for (const Vector3d& v : surface->triangle(part.index()).vertices) box.add(state.pointAt(v));
    return box;
  }
  const AxisEnds ends = axisEnds(lssOf(lssIndex, part), state);
  box.add(ends.a);
  box.add(ends.b);
  return box;
}

}  // namespace foretouch::internal
