// tools/audit/audits.h: describes the contents of avatars and scenes, and what looks wrong.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "articulated/avatar.h"
#include "articulated/skeleton.h"
#include "assets/file_frame.h"
#include "middleware/scene/scene.h"

namespace foretouch::tools {

/// A person with arms spread or raised is within these; otherwise the unit is most likely wrong.
inline constexpr double kSmallestPerson = 0.5;
inline constexpr double kLargestPerson = 3.0;
/// Tighter, because stature is the same in every pose.
inline constexpr double kSmallestStature = 0.8;
inline constexpr double kLargestStature = 2.5;
/// Robots, animals, things: from a gripper to a crane. Robot files are in metres.
inline constexpr double kSmallestThing = 0.05;
inline constexpr double kLargestThing = 50.0;
/// The same for the largest side of a scene's box: a table top, a city.
inline constexpr double kSmallestScene = 0.5;
inline constexpr double kLargestScene = 5e3;

/// Metres and cubic metres.
struct AvatarAudit {
  std::int32_t links = 0, lss = 0;
  std::vector<std::string> linksWithoutLss;
  Eigen::Vector3d extent = Eigen::Vector3d::Zero();  ///< Sides of the box around all LSS.
  double smallestRadius = 0.0, largestRadius = 0.0;
  double volume = 0.0;            ///< The volume of all LSS; overlaps count as often as they occur.
  std::optional<double> stature;  ///< A person's, by the legs; nothing for everything else.
};

/// Measured in `pose`, a validated pose of the avatar's skeleton. An avatar with a statureOf() is a
/// person, except robots, which may have legs and any size: an avatar whose root is turned from
/// Z-up, as `avatar urdf` does, counts as a robot.
[[nodiscard]] AvatarAudit auditAvatar(const Avatar& avatar, const Pose& pose);

/// Aligned lines. `poseName`: the pose of the measured extent, "rest pose".
[[nodiscard]] std::string describe(const AvatarAudit& audit, const std::string& poseName);
[[nodiscard]] std::string describe(const SceneAudit& audit);

/// The findings that fail a check, one sentence each; empty if nothing looks wrong.
/// `unitOption`: what would give the avatar another unit.
[[nodiscard]] std::vector<std::string> doubtsAbout(
    const AvatarAudit& audit, const std::string& unitOption = "--clip-scale or --model-scale");
[[nodiscard]] std::vector<std::string> doubtsAbout(const SceneAudit& audit);

/// One aligned line of an audit.
[[nodiscard]] std::string auditRow(const char* what, const std::string& value);

/// What the file says about its own unit and axis, as one line; empty if it says nothing.
[[nodiscard]] std::string rowOf(const FileFrame& frame);

/// The ten objects with the most triangles, aligned, the largest first.
[[nodiscard]] std::string largestObjects(const Scene& scene);

}  // namespace foretouch::tools
