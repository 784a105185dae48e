// tools/repair/levers.h: how far knobs move a point of a body: the coefficients of a row.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "articulated/motion.h"
#include "tools/repair/least_change.h"
#include "tools/repair/stage.h"

namespace foretouch::tools {

/// A point of a link, seen along a direction (W).
struct SeenPoint {
  LinkId link = 0;
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();
  Eigen::Vector3d along_W = Eigen::Vector3d::Zero();
};

class Levers {
 public:
  /// `stage` must outlive it.
  explicit Levers(const Stage& stage);

  /// Of the changes that the stage is posed with: the turn of each joint, pose by pose.
  void setChanges(const Changes& changes);
  /// Appends how far the knobs at `pose` move the point, times `share`. `states`: of the body where
  /// the point is seen.
  void add(const SeenPoint& point, const std::vector<LinkState>& states, std::int32_t pose,
           double share, std::vector<RowTerm>& terms) const;
  /// What changes cost (m^2): the mean over the body's joints of how far they move, squared; over
  /// some of the poses that the changes are about.
  [[nodiscard]] Eigen::MatrixXd metric() const;

 private:
  struct Lever {
    std::int32_t knob;
    LinkId joint;       // of the body
    JointId clipJoint;
    bool turns;
    Eigen::Vector3d along;
  };
  const Stage& stage_;
  Eigen::Matrix3d R_WClip_;
  std::vector<std::vector<Lever>> levers_;  // per link: of it and of all above it
  /// Per pose and joint of the clip: what a small change of the rotation vector turns.
  std::vector<std::vector<Eigen::Matrix3d>> tilts_;
};

}  // namespace foretouch::tools
