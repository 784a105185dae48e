// tools/inputs/own_pairs.h: which of an avatar's own links are asked whether they touch: from a
// file, or derived from the avatar and the poses that it usually takes.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/clip.h"
#include "articulated/pair_rules.h"
#include "articulated/result.h"
#include "assets/avatar/joint_match.h"
#include "tools/settings/clip_settings.h"
#include "tools/settings/world_settings.h"

namespace foretouch::tools {

/// At most so many poses of one clip are looked at, spread evenly; more of them say hardly more,
/// and each costs all pairs of LSS.
inline constexpr std::size_t kMostUsualPoses = 2000;

/// Adds the avatar's poses in a clip. Errors name `path` and the frame.
[[nodiscard]] Result<Done> addUsualPoses(const Avatar& avatar, const Clip& clip,
                                         const JointMatch& match, const std::string& path,
                                         std::vector<Pose>& poses);

/// Each text is a list of `a:b`, separated by commas: links whose pairs are left out. Names are
/// exact or patterns (tools/inputs/name_pattern.h). If names contain colons, the reading that
/// matches counts. Errors name `option`: two readings that match, names that match no link with LSS
/// (with the nearest existing ones), and texts that stand for no pair.
[[nodiscard]] Result<std::vector<LinkPair>> parseLeftOut(const std::string& option,
                                                         const std::vector<std::string>& texts,
                                                         const Avatar& avatar);

/// Adds the avatar's poses at configurations drawn within the limits of the robot that `motion`
/// names, as RobotPairOptions has it. Errors name the robot's file.
[[nodiscard]] Result<Done> addSampledPoses(const Avatar& avatar, const ClipRequest& motion,
                                           std::vector<Pose>& poses);

/// The rules for `request`, which asks for own links: those of its file, or derived from the avatar
/// and the clip's poses, for a robot from sampled ones. Errors name the file or the option.
[[nodiscard]] Result<PairRules> pairRulesFor(const WorldRequest& request, const ClipRequest& motion,
                                             const Avatar& avatar, const Clip& clip,
                                             const JointMatch& match);

/// "25 adjacent, 3 rest-overlap, 1 always", without the reasons that no pair has.
[[nodiscard]] std::string reasonsOf(const PairRules& rules);

}  // namespace foretouch::tools
