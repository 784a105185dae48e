// middleware/query/touches_at.cpp: Query's discrete check.
#include <cstddef>

#include "lss/assert.h"
#include "lss/segment_triangle.h"
#include "middleware/exact/triangles_meet.h"
#include "middleware/pair/query_memory.h"
#include "middleware/pair/query_plan.h"
#include "middleware/query/query.h"
#include "middleware/scene/scene_parts.h"
#include "middleware/surface/link_surface.h"

namespace foretouch {
namespace {

using internal::IgnoredObjects;

bool touches(const Lss& lss, const LinkState& state, const Triangle& triangle) {
  const AxisEnds ends = axisEnds(lss, state);
  return closestPoints(ends.a, ends.b, triangle).distance <= lss.radius;
}

/// Does any of the link's triangles under one LSS meet `triangle`? Exact for the vertices as
/// computed.
bool meshTouches(const internal::LinkSurface& surface, std::int32_t lss, const LinkState& state,
                 const Triangle& triangle) {
  const LssHierarchy& hierarchy = surface.hierarchy(lss);
  std::vector<HierarchyChild> stack{hierarchy.root()};
  while (!stack.empty()) {
    const HierarchyChild child = stack.back();
    stack.pop_back();
    if (!child.isTriangle()) {
      const LssHierarchy::Node& node = hierarchy.node(child.index());
      if (!touches(node.lss, state, triangle)) continue;
      stack.insert(stack.end(), node.children.begin(), node.children.end());
      continue;
    }
    Triangle moved = surface.triangle(child.index());
    for (Eigen::Vector3d& vertex : moved.vertices) vertex = state.pointAt(vertex);
    if (trianglesMeet(moved, triangle)) return true;
  }
  return false;
}

bool skinTouches(const internal::Side& parts, double t, const Scene& scene,
                 const IgnoredObjects& ignored, std::vector<TriangleId>& found) {
  std::vector<LinkState> states;
  parts.motion().statesAt(t, states);
  internal::PosedLink posed;
  posed.all = &states;
  for (std::int32_t i = 0; i < parts.skin->numTriangles(parts.link); ++i) {
    const Triangle moved =
        parts.hullOf(0, internal::Part::of(HierarchyChild::triangle(i)), posed).hull.triangle();
    found.clear();
    std::uint64_t visited = 0;
    scene.parts().bvh.collect(internal::boxOf(moved), found, visited);
    for (const TriangleId id : found) {
      if (!ignored.has(scene, id) && trianglesMeet(moved, scene.triangle(id))) return true;
    }
  }
  return false;
}

}  // namespace

bool Query::touchesAt(const ChainMotion& motion, LinkId link, double t, Scratch& scratch) const {
  const Avatar& avatar = plan_->avatar;
  const Scene& scene = plan_->scene;
  FORETOUCH_ASSERT(link >= 0 && link < avatar.numLinks());
  FORETOUCH_ASSERT(motion.numLinks() == avatar.numLinks());
  const internal::LinkPlan& asked = plan_->of(link);
  std::vector<TriangleId>& found = scratch.of<internal::QueryMemory>().found;
  IgnoredObjects& ignored = scratch.of<internal::QueryMemory>().ignored;
  if (ignored.collect(plan_->options.ignored, link)) return false;
  if (asked.skin != nullptr) {
    const std::vector<AxisBounds> none;
    MotionEvaluator evaluator(motion);
    const internal::Side parts{link, avatar.lss(link), none, evaluator, nullptr, asked.skin};
    return skinTouches(parts, t, scene, ignored, found);
  }
  const LinkState state = motion.stateAt(link, t);
  for (std::size_t i = 0; i < avatar.lss(link).size(); ++i) {
    const Lss& lss = avatar.lss(link)[i];
    const auto index = static_cast<std::int32_t>(i);
    const AxisEnds ends = axisEnds(lss, state);
    Aabb box;
    box.add(ends.a);
    box.add(ends.b);
    box.grow(lss.radius);
    found.clear();
    std::uint64_t visited = 0;
    scene.parts().bvh.collect(box, found, visited);
    for (const TriangleId id : found) {
      if (ignored.has(scene, id) || !touches(lss, state, scene.triangle(id))) continue;
      if (asked.surface == nullptr || !asked.surface->hasTriangles(index) ||
          meshTouches(*asked.surface, index, state, scene.triangle(id))) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace foretouch
