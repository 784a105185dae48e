// middleware/solid/pulled_step.h: the small step of a pose that a target pulls along and rows hold
// back: to first order, by the avatar's visual inertia (solid.md 2 to 4). Metres in W. Not
// installed.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "articulated/avatar.h"
#include "articulated/motion.h"
#include "articulated/skeleton.h"
#include "middleware/mechanics/tree_inertia.h"
#include "middleware/solid/contact_row.h"
#include "middleware/solid/least_push.h"
#include "middleware/solid/pace.h"
#include "middleware/solid/tree_pose.h"
#include "middleware/solid/visual_body.h"

namespace foretouch::internal {

/// Where a pose places what counts, and how far that is from the target.
struct BodyState {
  std::vector<LinkState> states;
  std::vector<Eigen::Vector3d> places;  // of the body's points
  std::vector<Eigen::Vector3d> turns;   // per joint, to the target
  double cost = 0.0;
};

/// For one thread; keeps its memory.
class PulledStep {
 public:
  PulledStep(const Avatar& avatar, const std::vector<double>& visibility);

  [[nodiscard]] const VisualBody& body() const { return body_; }
  [[nodiscard]] const Skeleton& skeleton() const { return skeleton_; }

  void place(const Pose& pose, BodyState& state) const;
  /// Completes a state that place() made. `wanted`: the body's points at the target.
  void evaluate(const Pose& target, const std::vector<Eigen::Vector3d>& wanted, const Pose& pose,
                BodyState& state) const;

  /// Finds the step that would reach the target to first order if nothing were in the way, from
  /// `here`, the state of `shown`. O(joints + LSS).
  void aim(const Pose& target, const std::vector<Eigen::Vector3d>& wanted, const BodyState& here,
           const Pose& shown);
  /// Only this share of the way to the target, 0 to 1, from now on.
  void pullLess(double share);
  /// Forgets the rows that solve() has taken up.
  void begin() { push_.begin(); }
  /// Finds the step that keeps the rows and is nearest to the free one. Rows get their pushes.
  /// Returns how many rows it has taken up since begin(); since then, only bounds may have changed.
  std::size_t solve(std::vector<ContactRow>& rows);

  /// How far the free step moves the body's points on each link, at most. Resizes `far`.
  void farthestFree(const BodyState& here, std::vector<double>& far) const;
  /// The farthest that the whole step moves any point, a joint's turn counted by its lever.
  [[nodiscard]] double size(const BodyState& here) const { return sizeOf(step_, here); }
  /// How far the whole step moves the body, to first order.
  [[nodiscard]] Moved moveOf(const BodyState& here, const Pace& pace) const;
  [[nodiscard]] double sizeOfFree(const BodyState& here) const { return sizeOf(free_, here); }
  /// Goes a share of the step on from `shown`, whose state is `here`.
  void move(const BodyState& here, const Pose& shown, double share, Pose& moved);

 private:
  [[nodiscard]] double sizeOf(const TreeStep& step, const BodyState& here) const;
  void findStiffness(const BodyState& here, const std::vector<Eigen::Vector3d>& wanted);

  /// Sums over all points on a joint's link and below: of weight times error, and of their products
  /// with the places.
  struct Bend {
    Eigen::Vector3d force = Eigen::Vector3d::Zero();
    double moment = 0.0;
  };

  Skeleton skeleton_;
  VisualBody body_;
  TreeInertia inertia_;
  LeastPush push_;
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  TreePull pull_;
  std::vector<Bend> bends_;
  std::vector<double> stiffness_;  // per joint
  TreeStep free_, step_;
  PoseStep change_;
  std::vector<std::uint8_t> isSeen_;  // per joint: points are on its link or below
};

}  // namespace foretouch::internal
