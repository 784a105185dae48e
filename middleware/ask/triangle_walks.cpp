// Walks down to triangles, the nearest parts first: the flat tree of a scene, and the hierarchy
// over a link's.
#include <algorithm>
#include <array>

#include "lss/assert.h"
#include "lss/index.h"
#include "middleware/ask/piece_asker.h"
#include "middleware/ask/way_boxes.h"
#include "middleware/scene/nearest_walk.h"

namespace foretouch::internal {
namespace {

/// A bound on all places in the tree, from its origin.
double extentOf(const SceneParts& scene) {
  return (scene.audit.boxMax - scene.origin).cwiseAbs().maxCoeff() +
         (scene.audit.boxMin - scene.origin).cwiseAbs().maxCoeff();
}

Aabb boxAround(const Lss& lss) {
  Aabb box;
  box.add(lss.a);
  box.add(lss.b);
  box.grow(lss.radius);
  return box;
}

class SceneWalk {
 public:
  SceneWalk(const SceneParts& scene, const ContactSide& side, PieceAsker& asker)
      : scene_(scene),
        asker_(asker),
        boxes_(asker.shape(), scene.origin, extentOf(scene)),
        isRay_(asker.shape().isRay()),
        side_(side) {}

  void walk() { walkNearestFirst(scene_.bvh, *this); }

  // What the walk asks.
  [[nodiscard]] double limit() const { return asker_.limit(); }
  void bounds(const BvhNode& node, double (&bounds)[kBvhWidth]) const {
    const float *const lower[3] = {node.lower[0], node.lower[1], node.lower[2]}, *const upper[3] = {
                                                                                     node.upper[0],
                                                                                     node.upper[1],
                                                                                     node.upper[2]};
    boxes_.nearest(kBvhWidth, lower, upper, bounds);
  }
  void leaf(const BvhLeaf& leaf) {
    for (int i = 0; i < kBvhWidth && leaf.id[i] >= 0; ++i) {
      const Triangle& triangle = scene_.triangles[slotOf(leaf.id[i])];
      if (!isRay_ && boxes_.nearest(boxFromOrigin(triangle)) > asker_.limit()) continue;
      side_.triangle = leaf.id[i];
      asker_.askTriangle(triangle, side_, scene_.objectOf[slotOf(leaf.id[i])]);
    }
  }

 private:
  [[nodiscard]] Aabb boxFromOrigin(const Triangle& triangle) const {
    Aabb box;
    for (const Eigen::Vector3d& v : triangle.vertices) box.add(v - scene_.origin);
    return box;
  }

  const SceneParts& scene_;
  PieceAsker& asker_;
  const WayBoxes boxes_;
  const bool isRay_;  ///< Then the asker has a quicker way past triangles.
  ContactSide side_;
};

/// Triangles are ~index.
class SurfaceWalk {
 public:
  SurfaceWalk(const LinkSurface& surface, const ContactSide& side, PieceAsker& asker)
      : surface_(surface),
        hierarchy_(surface.hierarchy(side.lss)),
        asker_(asker),
        boxes_(asker.shape(), Eigen::Vector3d::Zero(), extentOf(hierarchy_)),
        side_(side) {}

  void walk() {
    push(hierarchy_.root(), 0.0);
    while (size_ > 0) {
      const WaitingChild<std::int32_t> next = waiting_[slotOf(--size_)];
      if (next.bound > asker_.limit()) continue;
      if (next.child < 0) {
        side_.triangle = ~next.child;
        asker_.askTriangle(surface_.triangle(side_.triangle), side_, kEveryObject);
        continue;
      }
      const int first = size_;
      for (const HierarchyChild child : hierarchy_.node(next.child).children) {
        push(child, boundOf(child, next.bound));
      }
      sortNearestLast(waiting_.data() + first, waiting_.data() + size_);
    }
  }

 private:
  static double extentOf(const LssHierarchy& hierarchy) {
    if (hierarchy.root().isTriangle()) return 0.0;
    const Lss& lss = hierarchy.node(hierarchy.root().index()).lss;
    return 2.0 * (lss.a.lpNorm<1>() + lss.b.lpNorm<1>() + lss.radius);
  }
  [[nodiscard]] double boundOf(HierarchyChild child, double ofParent) const {
    if (!child.isTriangle()) return boxes_.nearest(boxAround(hierarchy_.node(child.index()).lss));
    // The asker has a quicker way past triangles for rays.
    if (asker_.shape().isRay()) return ofParent;
    return boxes_.nearest(boxOf(surface_.triangle(child.index())));
  }
  void push(HierarchyChild child, double bound) {
    if (bound > asker_.limit()) return;
    FORETOUCH_ASSERT(size_ < kRoom);
    waiting_[slotOf(size_++)] = {bound, child.isTriangle() ? ~child.index() : child.index()};
  }

  /// Depth first: one waits per level, beside the two of the last.
  static constexpr int kRoom = 66;

  const LinkSurface& surface_;
  const LssHierarchy& hierarchy_;
  PieceAsker& asker_;
  const WayBoxes boxes_;
  ContactSide side_;
  int size_ = 0;
  std::array<WaitingChild<std::int32_t>, kRoom> waiting_;
};

}  // namespace

void askScene(const SceneParts& scene, const ContactSide& side, PieceAsker& asker) {
  SceneWalk(scene, side, asker).walk();
}

void askSurface(const LinkSurface& surface, const ContactSide& side, PieceAsker& asker) {
  SurfaceWalk(surface, side, asker).walk();
}

}  // namespace foretouch::internal
