// tools/floor/resting_body.h: what a body stands and leans on: heel, ball and toes of each foot,
// and each hand, by the joints' names, as an avatar of its own. Metres.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "articulated/avatar.h"
#include "articulated/motion.h"
#include "articulated/result.h"

namespace foretouch::tools {

enum class PartOfLimb : std::uint8_t { Foot, Heel, Ball, Toe, Hand };
/// "foot", "heel", "ball", "toe", "hand".
[[nodiscard]] const char* toString(PartOfLimb part);

/// The sphere at one end of an LSS: the lowest point of a part always lies on one of these.
struct PartCorner {
  LinkId link = 0;  ///< A link of RestingBody::avatar.
  Eigen::Vector3d center_L = Eigen::Vector3d::Zero();
  double radius = 0.0;
};

struct RestingPart {
  PartOfLimb part = PartOfLimb::Foot;
  std::size_t limb = 0;             ///< Index of RestingBody::limbs.
  JointId joint = 0;                ///< The avatar's joint that it moves with.
  std::vector<LinkId> links;        ///< Links of RestingBody::avatar.
  std::vector<PartCorner> corners;  ///< At least one.

  [[nodiscard]] bool isHand() const { return part == PartOfLimb::Hand; }
};

/// A foot, or a hand.
struct RestingLimb {
  std::string name;  ///< The name of its first joint.
  bool isHand = false;
  JointId ankle = 0;           ///< A joint of the avatar; of a hand, its joint.
  std::optional<JointId> toe;  ///< The first joint of its toes.
};

/// The avatar without all that does not rest. A foot's LSS are cut in the middle of its length: the
/// rear half is its heel, the front half its ball; together they are what they were. A foot without
/// length is one part. Where toes do not say what is in front, the ball is what is farther from the
/// ankle.
struct RestingBody {
  Avatar avatar;  ///< The joints of the avatar that it is made of, then those of heels and balls.
  std::vector<RestingLimb> limbs;
  std::vector<RestingPart> parts;  ///< By limb, heels first.
  std::int32_t jointsBefore = 0;   ///< Joints of the avatar that it is made of.

  /// "LeftFoot heel".
  [[nodiscard]] std::string nameOf(const RestingPart& part) const;
  /// `pose` is one of the avatar that it is made of.
  [[nodiscard]] Pose poseOf(Pose pose) const;
};

/// `feet`: names of links that are feet, or patterns of them (tools/inputs/name_pattern.h), in
/// place of those whose names say so. Errors: no joint is called a foot; a name is not a link's;
/// no foot has an LSS.
[[nodiscard]] Result<RestingBody> restingBodyOf(const Avatar& avatar,
                                                const std::vector<std::string>& feet = {});

/// The lowest corner of a part along `up` (unit).
struct LowestCorner {
  double height = 0.0;     ///< Height of its sphere's lowest point along `up`.
  std::size_t corner = 0;  ///< Index of RestingPart::corners.
};
/// `states`: those of RestingBody::avatar, one per link.
[[nodiscard]] LowestCorner lowestOf(const RestingPart& part, const std::vector<LinkState>& states,
                                    const Eigen::Vector3d& up);

}  // namespace foretouch::tools
