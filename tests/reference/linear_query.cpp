#include "tests/reference/linear_query.h"

#include <cmath>

#include "lss/assert.h"
#include "tests/reference/moving_polygon.h"

namespace foretouch {
namespace {

constexpr double kLargest = 1e100, kSmallest = 1e-100;

bool admitted(const LinearPoint& point) {
  const auto fits = [](double x) {
    return x == 0.0 || (std::abs(x) >= kSmallest && std::abs(x) <= kLargest);
  };
  for (int axis = 0; axis < 3; ++axis) {
    if (!fits(point.from[axis]) || !fits(point.to[axis])) return false;
  }
  return true;
}

LeafAnswer decide(const internal::MovingPolygon& polygon) {
  for (int i = 0; i < polygon.count; ++i) {
    FORETOUCH_ASSERT(admitted(*polygon.plus[i]) && admitted(*polygon.minus[i]));
  }
  LeafAnswer answer;
  internal::StageAnswer found = internal::filterStage(polygon);
  if (found.decision == internal::Decision::CannotTell) {
    found = internal::exactStage(polygon);
    answer.stage = LeafStage::Exact;
  }
  answer.hits = found.decision == internal::Decision::Yes;
  if (answer.hits) {
    answer.toiLow = found.toiLow;
    answer.toiHigh = found.toiHigh;
  }
  return answer;
}

}  // namespace

namespace internal {

MovingPolygon polygonOf(const LinearPoint& vertex, const std::array<LinearPoint, 3>& face) {
  return {3, {&face[0], &face[1], &face[2]}, {&vertex, &vertex, &vertex}};
}

MovingPolygon polygonOf(const std::array<LinearPoint, 2>& one,
                        const std::array<LinearPoint, 2>& other) {
  return {4, {&one[0], &one[1], &one[1], &one[0]}, {&other[0], &other[0], &other[1], &other[1]}};
}

MovingPolygon polygonOf(const LinearPoint& vertex, const std::array<LinearPoint, 2>& edge) {
  return {2, {&edge[0], &edge[1]}, {&vertex, &vertex}};
}

MovingPolygon polygonOf(const LinearPoint& one, const LinearPoint& other) {
  return {1, {&one}, {&other}};
}

}  // namespace internal

const char* toString(LeafStage stage) {
  switch (stage) {
    case LeafStage::Filter: return "filter";
    case LeafStage::Exact: return "exact";
  }
  return "unknown";
}

LeafAnswer vertexFace(const LinearPoint& vertex, const std::array<LinearPoint, 3>& face) {
  return decide(internal::polygonOf(vertex, face));
}

LeafAnswer edgeEdge(const std::array<LinearPoint, 2>& one,
                    const std::array<LinearPoint, 2>& other) {
  return decide(internal::polygonOf(one, other));
}

LeafAnswer vertexEdge(const LinearPoint& vertex, const std::array<LinearPoint, 2>& edge) {
  return decide(internal::polygonOf(vertex, edge));
}

LeafAnswer vertexVertex(const LinearPoint& one, const LinearPoint& other) {
  return decide(internal::polygonOf(one, other));
}

}  // namespace foretouch
