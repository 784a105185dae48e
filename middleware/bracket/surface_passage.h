// middleware/bracket/surface_passage.h: did a point, of which only a region is known that it stayed
// in, surely pass through a surface? Proof: bracket.md 7. Metres in W. Not installed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "middleware/pair/ignored_objects.h"
#include "middleware/scene/scene.h"
#include "tessellation/aabb.h"

namespace foretouch::internal {

/// A part of the point's way. From `begin` to `end` it is within `radius` of the segment, at both
/// instants within `radiusFrom` and `radiusTo` of the segment's ends.
struct PassagePart {
  double begin = 0.0, end = 1.0;
  Eigen::Vector3d from, to;
  double radius = 0.0, radiusFrom = 0.0, radiusTo = 0.0;
};

/// The point was on a surface at an instant of [after, by].
struct PassageSpan {
  double after = 0.0, by = 1.0;
};

/// For one thread; keeps its memory.
class SurfacePassage {
 public:
  /// `way`: each part begins where and when the one before it ends. Nothing: that is not sure. Of
  /// several passages through one surface, the first.
  [[nodiscard]] std::optional<PassageSpan> find(const Scene& scene, const IgnoredObjects& ignored,
                                                const std::vector<PassagePart>& way);

 private:
  using Index = std::uint32_t;
  /// An edge of a triangle, that the region meets.
  struct Edge {
    Eigen::Vector3d a, b;
    Index triangle;
  };
  struct Crossing {
    std::size_t part;
    Index triangle;
    bool isClear;  // else the segment may pass along the triangle's border
  };
  void begin(const std::vector<PassagePart>& way);
  [[nodiscard]] bool mayCross(const Scene& scene, const IgnoredObjects& ignored);
  [[nodiscard]] bool meetsWay(const Triangle& triangle) const;
  void collect(const Scene& scene, const IgnoredObjects& ignored);
  void findCrossings();
  void joinAcrossEdges();
  [[nodiscard]] bool meetsRegion(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const;
  [[nodiscard]] Index surfaceOf(Index triangle);
  [[nodiscard]] std::optional<PassageSpan> through(Index surface);
  [[nodiscard]] bool isFree(const Eigen::Vector3d& centre, double radius, Index surface);

  std::vector<PassagePart> way_;  // moved aside
  std::vector<Aabb> boxes_;       // each part's region's
  Aabb region_;
  std::vector<TriangleId> ids_;
  std::vector<Triangle> triangles_;
  std::vector<Crossing> crossings_;
  std::vector<Edge> edges_;
  std::vector<Index> above_;              // per triangle: another one of its surface, or itself
  std::vector<std::uint8_t> isBordered_;  // per triangle: the region meets a border there
  std::vector<Index> tried_;
};

}  // namespace foretouch::internal
