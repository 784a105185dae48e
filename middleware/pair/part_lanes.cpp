#include "middleware/pair/part_lanes.h"

#include <algorithm>
#include <cmath>

#include "lss/assert.h"
#include "lss/index.h"
#include "lss/rounding.h"

namespace foretouch::internal {
namespace {

/// The rounding of a scene's vertex that is taken relative to the origin (lanes/frame_lanes.md 4).
constexpr double kVertexRounding = 2.0 * kUnitRoundoffOfFloat;
constexpr double kOriginRounding = 2.0 * kUnitRoundoff;
/// The rounding of a bound of the vertices: the proof needs 2 unit roundoffs. Their pad is twice
/// their error, which covers its own part.
constexpr float kSceneBoxRounding = 8.0F * kUnitRoundoffOfFloat;
/// Rounds the sum of a floor and a radius, or of two pads, up.
constexpr float kFloorInflation = 1.0F + 4.0F * kUnitRoundoffOfFloat;

}  // namespace

void PartLanes::reset(const FramePolynomials& polynomials, const Eigen::Vector3d& nodesOrigin_W,
                      double begin, double end) {
  reset(begin, end);
  setFrame(polynomials, nodesOrigin_W);
}

void PartLanes::reset(double begin, double end) {
  FORETOUCH_ASSERT(begin < end);
  begin_ = begin;
  end_ = end;
  halfSpan_ = 0.5 * (end - begin);
  instantsPerTime_ = 1.0 / (kInstant * halfSpan_);
  triangles_.clear();
  boxes_.clear();
}

void PartLanes::setFrame(const FramePolynomials& polynomials,
                         const Eigen::Vector3d& nodesOrigin_W) {
  frame_ = laneFrame(polynomials);
  for (int axis = 0; axis < 3; ++axis)
    origin_[axis] = nodesOrigin_W[axis] + polynomials.origin[axis];
  originPad_ = kOriginRounding * origin_.norm() + kFrameUnderflow;
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
  triangles_.push_back(scene);
  return static_cast<std::int32_t>(triangles_.size()) - 1;
}

const CurveBox& PartLanes::box(std::int32_t triangle) {
  for (std::size_t i = boxes_.size(); i <= slotOf(triangle); ++i) {
    const SceneTriangle& scene = triangles_[i];
    CurveBox box{};
    for (int axis = 0; axis < 3; ++axis) {
      const auto [least, most] =
          std::minmax({scene.vertex[0][axis], scene.vertex[1][axis], scene.vertex[2][axis]});
      box.lower[axis] = (least - scene.pad) - kSceneBoxRounding * std::abs(least);
      box.upper[axis] = (most + scene.pad) + kSceneBoxRounding * std::abs(most);
    }
    boxes_.push_back(box);
  }
  return boxes_[slotOf(triangle)];
}

void PartLanes::put(std::size_t lane, std::int32_t triangle, const LanePart& part, float u,
                    float floor) {
  const SceneTriangle& scene = triangles_[slotOf(triangle)];
  // One loop for both sides: half the time of putScene() and putPart().
  for (int i = 0; i < 3; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      parts_.point[i][axis][lane] = part.point[i][axis];
      pairs_.scene[i][axis][lane] = scene.vertex[i][axis];
    }
  }
  parts_.u[lane] = u;
  parts_.rho[lane] = part.rho;
  parts_.scenePad[lane] = scene.pad;
  pairs_.floor[lane] = (floor + part.radius) * kFloorInflation;
  radius_[lane] = part.radius;
}

void PartLanes::putBoth(std::size_t lane, const LanePart& part, const LanePart& other, float u,
                        float floor) {
  putPart(lane, part, u, 0.0F, parts_);
  putPart(lane, other, u, 0.0F, otherParts_);
  radius_[lane] = (part.radius + other.radius) * kFloorInflation;
  pairs_.floor[lane] = (floor + radius_[lane]) * kFloorInflation;
}

void PartLanes::putPart(std::size_t lane, const LanePart& part, float u, float scenePad,
                        PartBlock& block) {
  for (int i = 0; i < 3; ++i) {
    for (int axis = 0; axis < 3; ++axis) block.point[i][axis][lane] = part.point[i][axis];
  }
  block.u[lane] = u;
  block.rho[lane] = part.rho;
  block.scenePad[lane] = scenePad;
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

void PartLanes::proveBoth(BothParts kind, bool areSurfaces, std::size_t count) {
  // An axis goes first, as the side with two points.
  const bool isTurned = kind == BothParts::AxisOfOther;
  placeParts(isTurned ? otherFrame_ : frame_, isTurned ? otherParts_ : parts_, count, pairs_);
  placeParts(isTurned ? frame_ : otherFrame_, isTurned ? parts_ : otherParts_, count, others_);
  std::copy_n(&others_.link[0][0][0], 9 * kTrianglePairLanes, &pairs_.scene[0][0][0]);
  std::copy_n(&others_.velocity[0][0][0], 9 * kTrianglePairLanes, &motions_.velocity[0][0][0]);
  std::copy_n(others_.acceleration[0], kTrianglePairLanes, motions_.acceleration);
  for (std::size_t lane = 0; lane < count; ++lane) {
    pairs_.positionPad[lane] =
        (pairs_.positionPad[lane] + others_.positionPad[lane]) * kFloorInflation;
    pairs_.velocityPad[lane] =
        (pairs_.velocityPad[lane] + others_.velocityPad[lane]) * kFloorInflation;
  }
  if (kind == BothParts::Triangles) return proveSteps(pairs_, motions_, count, steps_);
  areSurfaces ? proveSegmentSteps(pairs_, motions_, count, steps_)
              : proveAxisSteps(pairs_, motions_, count, steps_);
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
