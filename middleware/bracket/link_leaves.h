// middleware/bracket/link_leaves.h: which triangles of the scene may be near a link whose LSS
// are its surface, in a step and in each of its pieces: one walk of the tree for all links, and
// tubes around what LSS sweep in between. Nothing of it needs the motion inside a piece. Proof:
// bracket.md 3. Metres in W. Not installed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lss/index.h"
#include "middleware/events/moving_sides.h"
#include "middleware/events/swept_tube.h"
#include "middleware/lanes/near_triangles.h"
#include "middleware/pair/ignored_objects.h"
#include "middleware/pair/leaf_hits.h"
#include "middleware/scene/scene.h"
#include "tessellation/aabb.h"
#include "tessellation/swept_boxes.h"

namespace foretouch::internal {

/// Leaves of the scene's tree near a link, and which of their triangles are asked, as bits.
struct NearLeaves {
  std::vector<std::int32_t> leaf;  ///< Padded for lanes.
  std::vector<std::uint8_t> triangles;

  [[nodiscard]] std::size_t size() const { return triangles.size(); }
  [[nodiscard]] bool empty() const { return triangles.empty(); }
  void clear() { triangles.clear(); }
  void add(std::int32_t one, std::uint8_t asked);
};
/// Pairs of the link's LSS and triangles.
using NearPairs = std::vector<SidesPair>;
/// What each LSS of a link sweeps in a piece, grown.
using LinkTubes = std::vector<SweptTube>;

/// For one thread; keeps its memory.
class LinkLeaves {
 public:
  /// Finds which leaves each box (of a link, or of a link in a piece) meets.
  void walk(const Scene& scene, const std::vector<Aabb>& boxes);
  /// How many.
  [[nodiscard]] std::size_t count(std::size_t box) const {
    return hits_.first[box + 1] - hits_.first[box];
  }
  /// Those of a box, without what is ignored.
  void collect(const Scene& scene, std::size_t box, const IgnoredObjects& ignored,
               NearLeaves& leaves) const;
  /// The pairs that tubes meet in these leaves; the nearest is the first, or nearly so.
  void collect(const Scene& scene, const LinkTubes& tubes, const NearLeaves& leaves,
               NearPairs& pairs);

 private:
  void setLanes(const Scene& scene, const std::vector<Aabb>& boxes);

  SweptBoxes lanes_;
  LeafHits hits_;
  NearTriangles near_;
};

}  // namespace foretouch::internal
