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
  explicit Levers(const RepairStage& stage);

  /// Takes the changes that the stage is posed with: the turn of each joint, pose by pose.
  void setChanges(const Changes& changes);
  /// Where and when a point is seen: the body's links, and the pose whose knobs move it, times
  /// share.
  struct Sight {
    const std::vector<LinkState>& states;
    std::int32_t pose = 0;
    double share = 1.0;
  };
  /// Appends how far the knobs move the point.
  void add(const SeenPoint& point, const Sight& sight, std::vector<RowTerm>& terms) const {
    add(levers_[slotOf(point.link)], point, sight, terms);
  }
  /// The same as seen from another link: what moves both of them does not move it.
  void addBeside(LinkId other, const SeenPoint& point, const Sight& sight,
                 std::vector<RowTerm>& terms) const;
  /// The same by the limb only, if the point is on one: an arm is mended by the arm, while the
  /// rest stands as it did.
  void addOfLimb(const SeenPoint& point, const Sight& sight, std::vector<RowTerm>& terms) const {
    add(limbs_[slotOf(point.link)], point, sight, terms);
  }
  /// The cost of changes (m^2): the mean over the body's joints of how far they move, squared; over
  /// some of the poses that the changes are about.
  [[nodiscard]] Eigen::MatrixXd metric() const;

 private:
  struct Lever {
    std::int32_t knob;
    LinkId joint;  // of the body
    JointId clipJoint;
    bool turns;
    Eigen::Vector3d along;
  };
  void add(const std::vector<Lever>& levers, const SeenPoint& point, const Sight& sight,
           std::vector<RowTerm>& terms) const;

  const RepairStage& stage_;
  Eigen::Matrix3d R_WClip_;
  std::vector<std::vector<Lever>> levers_;  // per link: of it and of all above it
  std::vector<std::vector<Lever>>
      limbs_;  // the same without what carries a foot, if that is enough
  /// Per pose and joint of the clip: what a small change of the rotation vector turns.
  std::vector<std::vector<Eigen::Matrix3d>> tilts_;
};

}  // namespace foretouch::tools
