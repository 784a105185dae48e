// middleware/solid/visual_body.h: what a person sees of an avatar, as points of weight: both ends
// of each LSS, by its area and its visibility. The distance of two poses is that of these points.
// Metres. Not installed.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "articulated/avatar.h"
#include "articulated/motion.h"
#include "articulated/skeleton.h"

namespace foretouch::internal {

/// A radian of a joint's twist counts as this much of its surface (m).
inline constexpr double kTwistLever = 0.05;

class VisualBody {
 public:
  struct Point {
    LinkId link;
    Eigen::Vector3d p_L;
    double weight;
  };

  /// `visibility`: one per link, >= 0, not all 0 where there are LSS.
  VisualBody(const Avatar& avatar, const std::vector<double>& visibility);

  /// By link; the weights' sum is 1.
  [[nodiscard]] const std::vector<Point>& points() const { return points_; }
  /// a_j: m^2 per rad^2 of a joint's error, > 0.
  [[nodiscard]] const std::vector<double>& stiffness() const { return stiffness_; }

  /// Where the points are in W. Resizes `places`.
  void place(const std::vector<LinkState>& states, std::vector<Eigen::Vector3d>& places) const;
  /// f, in m^2: sum of weighted squared distances and of a_j |turn|^2 (solid.md 2). `places`,
  /// `wanted`: of the points at a pose and at the target; `turns`: from the pose's rotations to the
  /// target's. O(LSS).
  [[nodiscard]] double cost(const std::vector<Eigen::Vector3d>& places,
                            const std::vector<Eigen::Vector3d>& wanted,
                            const std::vector<Eigen::Vector3d>& turns) const;
  /// The largest distance of two places of one point.
  [[nodiscard]] static double farthest(const std::vector<Eigen::Vector3d>& one,
                                       const std::vector<Eigen::Vector3d>& other);

  /// The largest distance of a point's places at two poses. `atOne`, `atOther`: memory.
  [[nodiscard]] double farthestMove(const Skeleton& skeleton, const Pose& one, const Pose& other,
                                    std::vector<LinkState>& atOne,
                                    std::vector<LinkState>& atOther) const;

 private:
  std::vector<Point> points_;
  std::vector<double> stiffness_;
};

}  // namespace foretouch::internal
