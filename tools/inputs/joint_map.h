// tools/inputs/joint_map.h: the file of --map: {"avatar joint": "clip joint", ...}
// (docs/formats.md).
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "articulated/clip.h"
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

/// Makes the clip of one humanoid a clip of `avatar`, another humanoid, by the parts of the body
/// (assets/avatar/humanoid_clip.h); true if it did. A map itself says what belongs together, so
/// with one the clip stays as it is. Errors name the clip.
[[nodiscard]] Result<bool> followByParts(const Skeleton& avatar, const std::string& mapPath,
                                         const std::string& motionPath, Clip& clip);

}  // namespace foretouch::tools
