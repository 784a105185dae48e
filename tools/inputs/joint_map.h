// tools/inputs/joint_map.h: the file of --map: {"avatar joint": "clip joint", ...}
// (docs/formats.md).
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "articulated/result.h"
#include "assets/avatar/joint_match.h"

namespace foretouch::tools {

inline constexpr std::size_t kMaxJointMapBytes = 16u << 20;

/// Refuses everything but one flat JSON object of texts, and repeated keys.
[[nodiscard]] Result<JointNameMap> readJointMapFile(const std::string& path);

/// The same for text in memory; errors name `name` as the file. Safe on hostile input.
[[nodiscard]] Result<JointNameMap> parseJointMap(std::string_view json, const std::string& name);

/// matchJoints() with the map of a file, or without one if `mapPath` is empty. Errors name the map,
/// or else the clip at `motionPath`; codes Mismatch and UnknownName are about the match.
[[nodiscard]] Result<JointMatch> matchWithMap(const Skeleton& avatar, const Skeleton& clip,
                                              const std::string& mapPath,
                                              const std::string& motionPath);

}  // namespace foretouch::tools
