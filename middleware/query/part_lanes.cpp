#include "middleware/query/part_lanes.h"

#include <algorithm>
#include <cmath>

#include "lss/assert.h"
#include "lss/index.h"
#include "lss/rounding.h"

namespace foretouch::internal {
namespace {

/// Of a scene's vertex, taken relative to the origin and rounded (lanes/frame_lanes.md 4).
constexpr double kVertexRounding = 2.0 * kUnitRoundoffOfFloat;
constexpr double kOriginRounding = 2.0 * kUnitRoundoff;
/// Of a bound of the vertices: the proof needs 2 unit roundoffs. Their pad is twice their error,
/// which covers its own part.
constexpr float kSceneBoxRounding = 8.0F * kUnitRoundoffOfFloat;
/// Rounds the sum of a floor and a radius, or of two pads, up.
constexpr float kFloorInflation = 1.0F + 4.0F * kUnitRoundoffOfFloat;

}  // namespace

void PartLanes::reset(const FramePolynomials& polynomials, const Eigen::Vector3d& nodesOrigin_W,
                      double begin, double end) {
  FORETOUCH_ASSERT(begin < end);
  frame_ = laneFrame(polynomials);
  for (int axis = 0; axis < 3; ++axis)
    origin_[axis] = nodesOrigin_W[axis] + polynomials.origin[axis];
  originPad_ = kOriginRounding * origin_.norm() + kFrameUnderflow;
  begin_ = begin;
  end_ = end;
  halfSpan_ = 0.5 * (end - begin);
  instantsPerTime_ = 1.0 / (kInstant * halfSpan_);
  triangles_.clear();
}

std::int32_t PartLanes::add(const Triangle& triangle_W) {
  SceneTriangle scene{};
  double largest = 0.0;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d& v = triangle_W.vertices[i];
    double squares = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      const double x = v[axis] - origin_[axis];
      scene.vertex[i][axis] = static_cast<float>(x);
      squares += x * x;
    }
    largest = std::max(largest, squares);
  }
  scene.pad = floatAbove(kVertexRounding * std::sqrt(largest) + originPad_);
  for (int axis = 0; axis < 3; ++axis) {
    const std::initializer_list<float> x = {scene.vertex[0][axis], scene.vertex[1][axis],
                                            scene.vertex[2][axis]};
    scene.box.lower[axis] = (std::min(x) - scene.pad) - kSceneBoxRounding * std::abs(std::min(x));
    scene.box.upper[axis] = (std::max(x) + scene.pad) + kSceneBoxRounding * std::abs(std::max(x));
  }
  triangles_.push_back(scene);
  return static_cast<std::int32_t>(triangles_.size()) - 1;
}

void PartLanes::put(std::size_t lane, std::int32_t triangle, const LanePart& part, float u,
                    float floor) {
  const SceneTriangle& scene = triangles_[slotOf(triangle)];
  putScene(lane, scene, u);
  for (int i = 0; i < 3; ++i) {
    for (int axis = 0; axis < 3; ++axis) parts_.point[i][axis][lane] = part.point[i][axis];
  }
  parts_.rho[lane] = part.rho;
  parts_.scenePad[lane] = scene.pad;
  pairs_.floor[lane] = (floor + part.radius) * kFloorInflation;
  radius_[lane] = part.radius;
}

void PartLanes::putBlend(std::size_t lane, std::int32_t triangle, std::int32_t curve,
                         const BlendHull& hull, float u, float floor) {
  const SceneTriangle& scene = triangles_[slotOf(triangle)];
  putScene(lane, scene, u);
  curves_[lane] = curve;
  pairs_.positionPad[lane] = (hull.pad + scene.pad) * kFloorInflation;
  pairs_.floor[lane] = (floor + hull.radius) * kFloorInflation;
  radius_[lane] = hull.radius;
}

void PartLanes::putScene(std::size_t lane, const SceneTriangle& scene, float u) {
  for (int i = 0; i < 3; ++i) {
    for (int axis = 0; axis < 3; ++axis) pairs_.scene[i][axis][lane] = scene.vertex[i][axis];
  }
  parts_.u[lane] = u;
}

void PartLanes::proveBlendedTriangles(const BlendTriangle* curves, std::size_t count) {
  placeBlends(curves, curves_, parts_.u, count, pairs_);
  proveSteps(pairs_, count, steps_);
}

void PartLanes::proveBlendedParts(const BlendTriangle* curves, std::size_t count) {
  placeBlends(curves, curves_, parts_.u, count, pairs_);
  proveSegmentSteps(pairs_, count, steps_);
}

void PartLanes::proveTriangles(std::size_t count) {
  placeParts(frame_, parts_, count, pairs_);
  proveSteps(pairs_, count, steps_);
}

void PartLanes::proveLss(std::size_t count) {
  placeParts(frame_, parts_, count, pairs_);
  proveSegmentSteps(pairs_, count, steps_);
}

double PartLanes::leastX(std::size_t lane) const {
  const auto& x = pairs_.link;
  const float least = std::min({x[0][0][lane], x[1][0][lane], x[2][0][lane]});
  return origin_.x() + static_cast<double>(least) - static_cast<double>(pairs_.positionPad[lane]);
}

double PartLanes::freeUntil(std::size_t lane) const {
  const double from = timeOf(parts_.u[lane]);
  const double step = static_cast<double>(steps_.step[lane]) * halfSpan_;
  return timeAfter(from, step, end_);
}

}  // namespace foretouch::internal
