// tools/setup/walker.h: a body with its poses, asked where it could stand in a level. World W:
// metres, +Y up.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "articulated/avatar.h"
#include "articulated/result.h"
#include "articulated/skeleton.h"
#include "assets/avatar/joint_match.h"
#include "middleware/query/query.h"
#include "tools/inputs/clip_cut.h"
#include "tools/inputs/clip_pose.h"
#include "tools/setup/walkable_floor.h"

namespace foretouch::tools {

/// A body where its clip has it: Y-up, around the clip's origin.
struct WalkingBody {
  Avatar avatar;
  std::vector<Pose> poses;  ///< At least one; the first is the clip's first.
};

/// A link that a pose holds inside a scene's surface.
struct Inside {
  LinkId link = 0;
  ObjectId object = 0;
};

/// What a body rests on after it sank.
struct Rest {
  double depth = 0.0;  ///< How far it sank, metres.
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();
  TriangleId triangle = -1;
};

/// The body at frames of a clip that are spread over it, some of them if they are many; the same
/// for every caller. `clip`: with no placement but the one that makes it Y-up.
[[nodiscard]] Result<WalkingBody> walkingBody(const PlacedClip& clip, const FrameRange& frames);

/// Which of a body's poses shows at which height it stands: one of its lowest, but for the few that
/// dip lower. A clip may begin in a T-pose, or in the air.
[[nodiscard]] std::size_t standingPose(const WalkingBody& body);

class Walker {
 public:
  /// Both outlive the walker. `around`: where to look for floor in a level too large to be looked
  /// at as a whole. `on`: a name pattern of the objects on which it is wanted; empty: on the floor.
  /// Errors: those of Query::build(); no object has such a name.
  [[nodiscard]] static Result<Walker> build(const WalkingBody& body, const Level& level,
                                            const Eigen::Vector3d& around = Eigen::Vector3d::Zero(),
                                            const std::string& on = "");

  [[nodiscard]] const WalkingBody& body() const { return *body_; }
  [[nodiscard]] const Level& level() const { return *level_; }
  /// Index of the pose that shows at which height it stands.
  [[nodiscard]] std::size_t standing() const { return standing_; }
  /// Where a body of this height could walk; nullptr if that took too much: `floorDoubt` says what.
  [[nodiscard]] const WalkableFloor* floor() const { return floor_ ? &*floor_ : nullptr; }
  [[nodiscard]] const std::string& floorDoubt() const { return floorDoubt_; }
  [[nodiscard]] const std::string& on() const { return on_; }

  [[nodiscard]] Pose poseAt(std::size_t index, const Placement& place) const;
  /// All links that start inside a surface.
  [[nodiscard]] std::vector<Inside> insideAt(const Pose& pose) const;
  /// Lets the pose sink by at most `depth`. Nothing if it meets nothing; a depth of 0 if it starts
  /// in contact.
  [[nodiscard]] std::optional<Rest> sink(const Pose& pose, double depth) const;
  [[nodiscard]] bool isTrunk(LinkId link) const;
  [[nodiscard]] bool isFoot(LinkId link) const;

 private:
  Walker(const WalkingBody& body, const Level& level, Query query);

  [[nodiscard]] Result<Done> findFloor(const Eigen::Vector3d& around);

  const WalkingBody* body_;
  const Level* level_;
  std::size_t standing_;
  std::string on_, floorDoubt_;
  std::optional<WalkableFloor> floor_;
  Query query_;
  std::vector<LinkId> trunk_, feet_;
  std::unique_ptr<Scratch> scratch_;
};

}  // namespace foretouch::tools
