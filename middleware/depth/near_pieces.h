// middleware/depth/near_pieces.h: the pairs of pieces near each other, for a rigid set of LSS that
// is moved by a translation. Not installed.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "lss/lss.h"
#include "lss/separation.h"
#include "middleware/depth/pair_depth.h"
#include "middleware/scene/scene.h"
#include "tessellation/aabb.h"

namespace foretouch::internal {

/// A moved LSS and a piece of the others, by their numbers.
struct PiecePair {
  std::int32_t moved = 0, other = 0;
};

/// What is moved and what it is in. What it refers to outlives it.
class PiecesApart {
 public:
  PiecesApart(const std::vector<Lss>& moved, const std::vector<Lss>& others, double rounding)
      : moved_(moved), others_(&others), rounding_(rounding) {}
  PiecesApart(const std::vector<Lss>& moved, const Scene& scene, double rounding)
      : moved_(moved), scene_(&scene), rounding_(rounding) {}

  /// Appends every pair that may have a common point after the move, or come within `margin` (m) of
  /// one: their boxes meet. By the moved piece, then by the other.
  void collect(const Eigen::Vector3d& move, double margin, std::vector<PiecePair>& pairs);

  /// The pair where it is without a move, and after one: then what rounding does to the moved
  /// points is in its reach.
  [[nodiscard]] ConvexPair at(const PiecePair& pair) const;
  [[nodiscard]] ConvexPair at(const PiecePair& pair, const Eigen::Vector3d& move) const;

 private:
  [[nodiscard]] Hull hullOf(std::int32_t other) const;
  [[nodiscard]] double radiusOf(std::int32_t other) const;

  const std::vector<Lss>& moved_;
  const std::vector<Lss>* others_ = nullptr;
  const Scene* scene_ = nullptr;
  double rounding_;
  std::vector<TriangleId> ids_;
};

}  // namespace foretouch::internal
