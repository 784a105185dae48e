// bench/peers/reference.h: the truth that `bench peers` judges by: when an LSS on a rigid
// motion first touches a scene. A plain tree of boxes and conservative advancement in double,
// written for this purpose alone: it shares no code with the query that is judged (types apart).
// Metres in W.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "bench/peers/rigid_sweep.h"
#include "lss/triangle.h"

namespace foretouch::tools {

class ReferenceScene {
 public:
  /// At least one triangle, all finite. O(n log n).
  explicit ReferenceScene(std::vector<Triangle> triangles);

  /// The distance (m) of the segment ab from the triangles, or `bound` where that is less: none
  /// farther is looked for. Zero where the segment meets one. Errs by a few roundings of the
  /// coordinates.
  [[nodiscard]] double distance(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                double bound) const;

  [[nodiscard]] const Eigen::Vector3d& low() const { return nodes_.front().low; }
  [[nodiscard]] const Eigen::Vector3d& high() const { return nodes_.front().high; }

 private:
  struct Node {
    Eigen::Vector3d low, high;
    std::int32_t first = 0;  ///< Of its triangles; of an inner node, its left child's index.
    std::int32_t count = 0;  ///< Triangles of a leaf; zero: an inner node.
  };
  void split(std::size_t node, std::size_t first, std::size_t count);
  std::vector<Triangle> triangles_;
  std::vector<Node> nodes_;
};

enum class TouchOutcome : std::uint8_t {
  Free,       ///< Proven: the separation is positive at every t.
  Touch,      ///< At t the separation is at most kReferenceSeparation, before t it is positive.
  Uncertain,  ///< kReferenceSteps evaluations did not tell: the motion grazes something.
};

struct FirstTouch {
  TouchOutcome outcome = TouchOutcome::Free;
  double t = 1.0;
};

/// Metres: a million times finer than the finest difference that is judged by it.
inline constexpr double kReferenceSeparation = 1e-9;
/// Evaluations of the distance; motions that need more are replaced by others.
inline constexpr int kReferenceSteps = 20'000;

/// The first touch of the sweep's LSS with `radius` (m) in place of its own.
/// Conservative advancement [Mirtich96]: no point of the axis can come nearer faster than
/// fastestAxisPoint(). The separation is taken to be less than computed by more than rounding can
/// do.
[[nodiscard]] FirstTouch firstTouch(const ReferenceScene& scene, const RigidSweep& sweep,
                                    double radius);

}  // namespace foretouch::tools
