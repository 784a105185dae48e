// middleware/pair/part_lanes.h: parts of one link against triangles of the scene, or against parts
// of another link, sixteen pairs at a time, each at its own instant: fills the lanes
// (lanes/frame_lanes.h), runs the proofs (lanes/triangle_pairs.h) and turns their results back into
// t. Not installed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "lss/index.h"
#include "lss/lss.h"
#include "lss/rounding.h"
#include "middleware/lanes/blend_lanes.h"
#include "middleware/lanes/frame_lanes.h"
#include "middleware/lanes/triangle_pairs.h"

namespace foretouch::internal {

/// How far boxes in lanes may be apart, by a difference that rounds, where `reach` (m) counts.
[[nodiscard]] inline float reachInLanes(double reach) {
  return floatAbove(reach * (1.0 + 4.0 * double{kUnitRoundoffOfFloat}));
}

/// What the parts of two links are.
enum class BothParts : std::uint8_t {
  Triangles,    ///< Those of either, or what is above them.
  AxisOfOne,    ///< The first link's are LSS, which nothing is below.
  AxisOfOther,  ///< The other's are.
};

/// One link over one span of t, whose length and bounds are multiples of 2^-20. Keeps its memory;
/// for one thread.
class PartLanes {
 public:
  /// The polynomials' origin is relative to `nodesOrigin_W`. Forgets the scene's triangles.
  void reset(const FramePolynomials& polynomials, const Eigen::Vector3d& nodesOrigin_W,
             double begin, double end);
  /// The span alone: setFrame() before anything is proven, or a triangle of the scene is added.
  void reset(double begin, double end);
  void setFrame(const FramePolynomials& polynomials, const Eigen::Vector3d& nodesOrigin_W);
  /// The other link, whose polynomials have the same origin over the same span. After setFrame().
  void setOther(const FramePolynomials& polynomials) { otherFrame_ = laneFrame(polynomials); }

  [[nodiscard]] double begin() const { return begin_; }
  [[nodiscard]] double end() const { return end_; }

  /// A number for the triangle, ascending from 0.
  std::int32_t add(const Triangle& triangle_W);

  /// The box around the triangle, relative to the frame's origin. Made when it is first needed.
  [[nodiscard]] const CurveBox& box(std::int32_t triangle);

  /// A place's x in W (m), relative to the frame's origin and rounded up.
  [[nodiscard]] float laneX(double x) const { return floatAbove(x - origin_.x()); }

  /// The last instant, not after `t` in [begin, end), that lanes can begin at.
  [[nodiscard]] float laneTime(double t) const {
    const auto instant = static_cast<std::int32_t>((t - begin_) * instantsPerTime_);
    // The difference may have been rounded up.
    return uOf(timeOf(uOf(instant)) > t ? instant - 1 : instant);
  }
  /// Exact for what laneTime() returns.
  [[nodiscard]] double timeOf(float u) const {
    return begin_ + (static_cast<double>(u) + 1.0) * halfSpan_;
  }

  /// Fills a lane. `floor` (m): that of the part's own surface, its radius counted.
  void put(std::size_t lane, std::int32_t triangle, const LanePart& part, float u, float floor);
  /// The same for a triangle or a part of a skin, whose curve is relative to the link's frame.
  void putBlend(std::size_t lane, std::int32_t triangle, std::int32_t curve, const BlendHull& hull,
                float u, float floor);
  /// The same for parts of both links.
  void putBoth(std::size_t lane, const LanePart& part, const LanePart& other, float u, float floor);
  /// Proves the first `count` lanes: all of triangles, or all of LSS.
  void proveTriangles(std::size_t count);
  void proveLss(std::size_t count);
  /// The same for a skin.
  void proveBlendedTriangles(const BlendTriangle* curves, std::size_t count);
  void proveBlendedParts(const BlendTriangle* curves, std::size_t count);
  /// The same for both links; `areSurfaces`: where one's are LSS, the other's may be triangles.
  void proveBoth(BothParts kind, bool areSurfaces, std::size_t count);

  /// Lower bound (m) on the separation of the lane's part and triangle; not above 0 if nothing is
  /// proven.
  [[nodiscard]] double lower(std::size_t lane) const {
    return static_cast<double>(steps_.lower[lane]) - static_cast<double>(radius_[lane]);
  }
  /// For a skin's triangle at the lane's instant: no point of it has a smaller x in W (m).
  [[nodiscard]] double leastX(std::size_t lane) const;
  /// Up to which t the pair keeps its floor, rounded down; at most the span's end.
  [[nodiscard]] double freeUntil(std::size_t lane) const;

 private:
  /// Lanes begin at instants this far apart in u. All of them on [-1,1] are floats, and so are
  /// their distances from -1.
  static constexpr double kInstant = 0x1p-24;
  static float uOf(std::int32_t instant) { return static_cast<float>(instant * kInstant - 1.0); }

  struct SceneTriangle {
    float vertex[3][3];  // relative to origin_
    float pad;
  };

  static void putPart(std::size_t lane, const LanePart& part, float u, float scenePad,
                      PartBlock& block);
  void putScene(std::size_t lane, const SceneTriangle& scene, float u);

  LaneFrame frame_{}, otherFrame_{};
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  double begin_ = 0.0, end_ = 1.0, halfSpan_ = 0.5, instantsPerTime_ = 1.0 / kInstant;
  double originPad_ = 0.0;
  std::vector<SceneTriangle> triangles_;
  std::vector<CurveBox> boxes_;  // of the first of them
  PartBlock parts_{};
  std::int32_t curves_[kTrianglePairLanes] = {};
  TrianglePairBlock pairs_{};
  // The other link's parts, where they are, and how they move.
  PartBlock otherParts_{};
  TrianglePairBlock others_{};
  OtherMotions motions_{};
  TrianglePairSteps steps_{};
  PairFloats radius_{};
};

}  // namespace foretouch::internal
