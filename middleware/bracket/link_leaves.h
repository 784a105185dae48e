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
#include "middleware/pair/ignored_objects.h"
#include "middleware/pair/leaf_hits.h"
#include "middleware/scene/scene.h"
#include "tessellation/aabb.h"
#include "tessellation/swept_boxes.h"

namespace foretouch::internal {

/// A leaf of the scene's tree near an LSS of a link, and which of its triangles are asked.
struct NearLeaf {
  std::int32_t lss;
  std::uint32_t leaf;
  std::uint8_t triangles;
};
using NearLeaves = std::vector<NearLeaf>;
/// Pairs of the link's LSS and triangles.
using NearPairs = std::vector<SidesPair>;
/// What each LSS of a link sweeps in a piece, grown.
using LinkTubes = std::vector<SweptTube>;

/// For one thread; keeps its memory.
class LinkLeaves {
 public:
  /// Of each box (of a link, or of a link in a piece), which leaves it meets.
  void walk(const Scene& scene, const std::vector<Aabb>& boxes);
  /// How many.
  [[nodiscard]] std::size_t count(std::size_t box) const {
    return hits_.first[box + 1] - hits_.first[box];
  }
  /// Those of a box's leaves that tubes meet: of each of the link's LSS, or none of `numLss`: all.
  void collect(const Scene& scene, std::size_t box, const IgnoredObjects& ignored,
               const LinkTubes& tubes, std::size_t numLss, NearLeaves& leaves) const;
  /// The leaves among them that tubes meet.
  static void narrow(const Scene& scene, const LinkTubes& tubes, const NearLeaves& leaves,
                     NearLeaves& fewer);
  /// The pairs that tubes meet in leaves that they do; the nearest is the first, or nearly so.
  static void collect(const Scene& scene, const LinkTubes& tubes, const NearLeaves& leaves,
                      NearPairs& pairs);
  /// The nearest, or nearly so, of those that tubes meet; none if that is not sure.
  [[nodiscard]] static SidesPair nearest(const Scene& scene, const LinkTubes& tubes,
                                         const NearLeaves& leaves);

 private:
  void setLanes(const Scene& scene, const std::vector<Aabb>& boxes);

  SweptBoxes lanes_;
  LeafHits hits_;
};

}  // namespace foretouch::internal
