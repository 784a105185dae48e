#include "middleware/depth/near_pieces.h"

#include <algorithm>

#include "lss/index.h"
#include "lss/rounding.h"
#include "middleware/scene/scene_parts.h"

namespace foretouch::internal {
namespace {

Aabb boxOf(const Lss& lss, const Eigen::Vector3d& move, double margin) {
  Aabb box;
  box.add(lss.a + move);
  box.add(lss.b + move);
  // The sums round by half a unit in the last place, which grow() covers several times.
  box.grow(lss.radius + margin);
  return box;
}

}  // namespace

void PiecesApart::collect(const Eigen::Vector3d& move, double margin,
                          std::vector<PiecePair>& pairs) {
  const double grown = margin + 4.0 * rounding_;
  for (std::size_t i = 0; i < moved_.size(); ++i) {
    const Aabb box = boxOf(moved_[i], move, grown);
    const auto moved = static_cast<std::int32_t>(i);
    if (others_ != nullptr) {
      for (std::size_t j = 0; j < others_->size(); ++j) {
        if (!box.overlaps(boxOf((*others_)[j], Eigen::Vector3d::Zero(), 0.0))) continue;
        pairs.push_back({moved, static_cast<std::int32_t>(j)});
      }
      continue;
    }
    std::uint64_t visited = 0;
    ids_.clear();
    scene_->parts().bvh.collect(box, ids_, visited);
    std::sort(ids_.begin(), ids_.end());
    for (const TriangleId id : ids_) {
      if (box.overlaps(internal::boxOf(scene_->triangle(id)))) pairs.push_back({moved, id});
    }
  }
}

Hull PiecesApart::hullOf(std::int32_t other) const {
  if (scene_ != nullptr) return Hull::of(scene_->triangle(other));
  const Lss& lss = (*others_)[slotOf(other)];
  return Hull::segment(lss.a, lss.b);
}

double PiecesApart::radiusOf(std::int32_t other) const {
  return scene_ != nullptr ? 0.0 : (*others_)[slotOf(other)].radius;
}

ConvexPair PiecesApart::at(const PiecePair& pair) const {
  return pairOf(moved_[slotOf(pair.moved)], hullOf(pair.other), radiusOf(pair.other), rounding_);
}

ConvexPair PiecesApart::at(const PiecePair& pair, const Eigen::Vector3d& move) const {
  Lss lss = moved_[slotOf(pair.moved)];
  lss.a += move;
  lss.b += move;
  const double sums = kUnitRoundoff * (lss.a.lpNorm<1>() + lss.b.lpNorm<1>());
  return pairOf(lss, hullOf(pair.other), radiusOf(pair.other), rounding_ + sums);
}

}  // namespace foretouch::internal
