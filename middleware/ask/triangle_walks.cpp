// Walks down to triangles, the nearest parts first: the flat tree of a scene, and the hierarchy
// over a link's.
#include <algorithm>
#include <array>

#include "lss/assert.h"
#include "lss/index.h"
#include "middleware/ask/piece_asker.h"
#include "middleware/ask/way_boxes.h"

namespace foretouch::internal {
namespace {

/// What waits: a child of a node, and how near it can be.
template <typename Child>
struct Waiting {
  double bound;
  Child child;
};

/// The last `count` of a stack, the nearest one last.
template <typename Child>
void sortLast(Waiting<Child>* first, Waiting<Child>* last) {
  for (Waiting<Child>* next = first; next != last; ++next) {
    for (Waiting<Child>* at = next; at != first && (at - 1)->bound < at->bound; --at) {
      std::swap(at[-1], at[0]);
    }
  }
}

/// Of all places in the tree, from its origin.
double extentOf(const SceneParts& scene) {
  return (scene.audit.boxMax - scene.origin).cwiseAbs().maxCoeff() +
         (scene.audit.boxMin - scene.origin).cwiseAbs().maxCoeff();
}

Aabb boxOf(const Lss& lss) {
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

  void walk() {
    waiting_[size_++] = {0.0, 0};
    while (size_ > 0) {
      const Waiting<std::uint32_t> next = waiting_[--size_];
      if (next.bound > asker_.limit()) continue;
      if ((next.child & BvhNode::kLeafFlag) != 0) {
        askLeaf(scene_.bvh.leaf(next.child & BvhNode::kLeafMask));
      } else {
        expand(scene_.bvh.node(next.child));
      }
    }
  }

 private:
  void expand(const BvhNode& node) {
    const float *const lower[3] = {node.lower[0], node.lower[1], node.lower[2]}, *const upper[3] = {
                                                                                     node.upper[0],
                                                                                     node.upper[1],
                                                                                     node.upper[2]};
    double bounds[kBvhWidth];
    boxes_.nearest(kBvhWidth, lower, upper, bounds);
    const double limit = asker_.limit();
    const int first = size_;
    FORETOUCH_ASSERT(first + kBvhWidth <= kRoom);
    for (int i = 0; i < kBvhWidth; ++i) {
      if (bounds[i] <= limit) waiting_[size_++] = {bounds[i], node.child[i]};
    }
    sortLast(waiting_ + first, waiting_ + size_);
  }

  void askLeaf(const BvhLeaf& leaf) {
    for (int i = 0; i < kBvhWidth && leaf.id[i] >= 0; ++i) {
      const Triangle& triangle = scene_.triangles[slotOf(leaf.id[i])];
      if (!isRay_ && boxes_.nearest(boxFromOrigin(triangle)) > asker_.limit()) continue;
      side_.triangle = leaf.id[i];
      asker_.askTriangle(triangle, side_, scene_.objectOf[slotOf(leaf.id[i])]);
    }
  }

  [[nodiscard]] Aabb boxFromOrigin(const Triangle& triangle) const {
    Aabb box;
    for (const Eigen::Vector3d& v : triangle.vertices) box.add(v - scene_.origin);
    return box;
  }

  static constexpr int kRoom = BvhWalk::kNodeRoom + kBvhWidth;

  const SceneParts& scene_;
  PieceAsker& asker_;
  const WayBoxes boxes_;
  const bool isRay_;  ///< Then the asker has a quicker way past triangles.
  ContactSide side_;
  int size_ = 0;
  Waiting<std::uint32_t> waiting_[kRoom];
};

}  // namespace

void askScene(const SceneParts& scene, const ContactSide& side, PieceAsker& asker) {
  SceneWalk(scene, side, asker).walk();
}

void askSurface(const LinkSurface& surface, const ContactSide& side, PieceAsker& asker) {
  const LssHierarchy& hierarchy = surface.hierarchy(side.lss);
  const auto extent = [&](const Lss& lss) {
    return lss.a.lpNorm<1>() + lss.b.lpNorm<1>() + lss.radius;
  };
  ContactSide part = side;
  const auto ask = [&](std::int32_t triangle) {
    part.triangle = triangle;
    asker.askTriangle(surface.triangle(triangle), part, kEveryObject);
  };
  if (hierarchy.root().isTriangle()) return ask(hierarchy.root().index());
  const WayBoxes boxes(asker.shape(), Eigen::Vector3d::Zero(),
                       2.0 * extent(hierarchy.node(hierarchy.root().index()).lss));
  const auto boundOf = [&](HierarchyChild child, double ofParent) {
    if (!child.isTriangle()) return boxes.nearest(boxOf(hierarchy.node(child.index()).lss));
    // The asker has a quicker way for rays.
    return asker.shape().isRay() ? ofParent : boxes.nearest(boxOf(surface.triangle(child.index())));
  };
  // Depth first: one waits per level, beside the two of the last. Triangles are ~index.
  constexpr int kRoom = 66;
  std::array<Waiting<std::int32_t>, kRoom> waiting;
  int size = 0;
  waiting[slotOf(size++)] = {0.0, hierarchy.root().index()};
  while (size > 0) {
    const Waiting<std::int32_t> next = waiting[slotOf(--size)];
    if (next.bound > asker.limit()) continue;
    if (next.child < 0) {
      ask(~next.child);
      continue;
    }
    const int first = size;
    FORETOUCH_ASSERT(first + 2 <= kRoom);
    for (const HierarchyChild child : hierarchy.node(next.child).children) {
      const double bound = boundOf(child, next.bound);
      if (bound > asker.limit()) continue;
      waiting[slotOf(size++)] = {bound, child.isTriangle() ? ~child.index() : child.index()};
    }
    sortLast(waiting.data() + first, waiting.data() + size);
  }
}

}  // namespace foretouch::internal
