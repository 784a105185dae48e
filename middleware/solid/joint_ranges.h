// middleware/solid/joint_ranges.h: how a person was seen to turn each joint, and so how far
// surfaces may turn it: so far, and kMargin beyond. The mathematics: middleware/solid/solid.md 6.
// Radians; lengths in metres. Not installed.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "articulated/motion.h"
#include "articulated/skeleton.h"
#include "middleware/solid/contact_row.h"

namespace foretouch::internal {

/// What is learned only grows: a target that rests teaches nothing. Roots have no range.
class JointRanges {
 public:
  /// How far beyond what was seen. One pose is known of a new person.
  static constexpr double kMargin = 0.7;

  explicit JointRanges(const Skeleton& skeleton);

  void forget();
  /// Takes up a tracked pose, but for joints that are lost. O(joints).
  void learn(const Pose& tracked, const std::vector<std::uint8_t>& isLost);
  /// Appends rows of the joints that may reach the end of their range by a turn of `reach`.
  /// `states`: the links of the pose at hand. O(joints).
  void append(const std::vector<LinkState>& states, double reach,
              std::vector<ContactRow>& rows) const;
  /// The gap that such a row has elsewhere.
  [[nodiscard]] double gapAt(const std::vector<LinkState>& states, const ContactRow& row) const;

 private:
  /// Turns from the first one that was seen, as the vector parts of unit quaternions: of each
  /// coordinate the least and the greatest.
  struct Range {
    Eigen::Quaterniond first = Eigen::Quaterniond::Identity();
    Eigen::Vector3d least, most;      // seen
    Eigen::Vector3d lowest, highest;  // allowed
    bool isAny = false;
  };
  [[nodiscard]] Eigen::Quaterniond turnOf(std::size_t joint,
                                          const std::vector<LinkState>& states) const;
  static void widen(Range& range);

  std::vector<JointId> parents_;
  std::vector<Range> ranges_;  // per joint
};

}  // namespace foretouch::internal
