// middleware/near/near_blocks.h: the triangles near one LSS, nearest first, in blocks for lanes.
// Not installed.
#pragma once

#include <cstdint>
#include <vector>

#include "middleware/lanes/near_bins.h"
#include "middleware/lanes/near_triangles.h"
#include "middleware/near/near_places.h"
#include "middleware/pair/ignored_objects.h"

namespace foretouch::internal {

/// As lanes want it.
[[nodiscard]] PlacedLss placedLss(const StandingLss& lss);

/// For one thread; keeps its memory.
class NearBlocks {
 public:
  /// Orders what lanes found near an LSS, without what is ignored: nearest first, but for up to a
  /// thirtieth of their range.
  void order(const Scene& scene, const IgnoredObjects& ignored, const NearTriangles& near);

  [[nodiscard]] std::size_t size() const { return order_.size(); }
  /// The k-th triangle's id, and a lower bound on its separation.
  [[nodiscard]] TriangleId id(std::size_t k) const { return order_[k].id; }
  [[nodiscard]] float gap(std::size_t k) const { return order_[k].gap; }

  /// Bit i: for triangle `from` + i, of the next PlaceBlock::kSize.
  [[nodiscard]] PlaceChoice mayWin(const Scene& scene, const FlatEdges& flat,
                                   const StandingLss& lss, const NearBins& bins, std::size_t from);

 private:
  struct Ordered {
    TriangleId id;
    float gap;
  };
  std::vector<Ordered> order_;
  std::vector<std::uint8_t> classOf_;  // of gaps, while ordering
  PlaceBlock block_;
};

}  // namespace foretouch::internal
