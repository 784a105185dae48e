// tools/audit/audits.h: what avatars and scenes hold, put into words, and what looks wrong about
// it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "articulated/avatar.h"
#include "articulated/pose.h"
#include "middleware/scene/scene.h"

namespace foretouch::tools {

/// A person with arms spread or raised measures something in between; what does not was most likely
/// read in another unit.
inline constexpr double kSmallestPerson = 0.5;
inline constexpr double kLargestPerson = 3.0;
/// Tighter, as it is the same in every pose: how tall people are who stand on their legs.
inline constexpr double kSmallestStature = 0.8;
inline constexpr double kLargestStature = 2.5;
/// Robots, animals, things: from a gripper to a crane. The files of robots are in metres.
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
  double volume = 0.0;            ///< Of all LSS, overlaps counted as often as they occur.
  std::optional<double> stature;  ///< Of a person, by the legs; nothing of all else.
};

/// Measured in `pose`, a validated pose of the avatar's skeleton. A person is who has a
/// statureOf(), but for robots, which may have legs and be of any size: an avatar whose root stands
/// as `avatar urdf` puts it, turned from Z-up, counts as one.
[[nodiscard]] AvatarAudit auditAvatar(const Avatar& avatar, const Pose& pose);

/// Aligned lines. `poseName` says where the extent was measured: "rest pose".
[[nodiscard]] std::string describe(const AvatarAudit& audit, const std::string& poseName);
[[nodiscard]] std::string describe(const SceneAudit& audit);

/// What a check says no to, one sentence each; empty where nothing looks wrong.
[[nodiscard]] std::vector<std::string> doubtsAbout(const AvatarAudit& audit);
[[nodiscard]] std::vector<std::string> doubtsAbout(const SceneAudit& audit);

/// One aligned line of an audit.
[[nodiscard]] std::string auditRow(const char* what, const std::string& value);

/// The ten objects with the most triangles, aligned, the largest first.
[[nodiscard]] std::string largestObjects(const Scene& scene);

}  // namespace foretouch::tools
