// tools/setup/walker.h: a body with its poses, asked where it could stand in a level. World W:
// metres, +Y up.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "articulated/avatar.h"
#include "articulated/result.h"
#include "articulated/skeleton.h"
#include "assets/avatar/joint_match.h"
#include "middleware/query/query.h"
#include "tools/setup/level.h"

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

class Walker {
 public:
  /// Both outlive the walker. Errors: as Query::build().
  [[nodiscard]] static Result<Walker> build(const WalkingBody& body, const Level& level);

  [[nodiscard]] const WalkingBody& body() const { return *body_; }
  [[nodiscard]] const Level& level() const { return *level_; }

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

  const WalkingBody* body_;
  const Level* level_;
  Query query_;
  std::vector<LinkId> trunk_, feet_;
  std::unique_ptr<Scratch> scratch_;
};

}  // namespace foretouch::tools
