// tests/reference/moving_polygon.h: the form that every linear query takes: corners that move
// along straight lines, each the difference of two of the query's points. Contact is the origin in
// their convex hull.
#pragma once

#include <array>

#include "tests/reference/leaf.h"
#include "tests/reference/linear_point.h"

namespace foretouch::internal {

/// Corner i is plus[i] - minus[i], as real numbers. In order around the polygon: a point, a
/// segment, a triangle or a parallelogram (corner 0 + corner 2 == corner 1 + corner 3). Refers to
/// the caller's points.
struct MovingPolygon {
  int count = 0;
  std::array<const LinearPoint*, 4> plus{}, minus{};
};

[[nodiscard]] MovingPolygon polygonOf(const LinearPoint& vertex,
                                      const std::array<LinearPoint, 3>& face);
[[nodiscard]] MovingPolygon polygonOf(const std::array<LinearPoint, 2>& one,
                                      const std::array<LinearPoint, 2>& other);
[[nodiscard]] MovingPolygon polygonOf(const LinearPoint& vertex,
                                      const std::array<LinearPoint, 2>& edge);
[[nodiscard]] MovingPolygon polygonOf(const LinearPoint& one, const LinearPoint& other);

/// When the origin first lies in the polygon, by one stage alone.
enum class Decision { No, Yes, CannotTell };
struct StageAnswer {
  Decision decision = Decision::CannotTell;
  double toiLow = 1.0, toiHigh = 1.0;  ///< As in LeafAnswer, if `decision` is Yes.
};
/// Doubles with a proved bound; may decline. Looks at kFilterSpans spans at most.
[[nodiscard]] StageAnswer filterStage(const MovingPolygon& polygon);
/// Integers; never declines.
[[nodiscard]] StageAnswer exactStage(const MovingPolygon& polygon);

}  // namespace foretouch::internal
