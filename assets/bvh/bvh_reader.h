// assets/bvh/bvh_reader.h: BVH mocap files, with the quirks found in the wild, in bounded memory;
// an avatar made from a clip's skeleton, one LSS per bone; a person's height, head and feet. BVH
// has no specification; docs/formats.md lists what the reader accepts, tolerates with a note, and
// refuses. Rotation channels compose in file order (Z X Y means Rz*Rx*Ry); position channels
// replace the joint's OFFSET; angles are degrees in the file.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/clip.h"
#include "articulated/result.h"
#include "articulated/skeleton.h"

namespace foretouch {

struct BvhOptions {
  double scale = 1.0;  ///< Metres per file unit: 0.01 for centimetres, 0.0254 for inches. > 0.
};

/// Reads and checks a BVH file. Iterative: no recursion on the file's nesting. A clip has at least
/// one frame; callers that need motion must check for two.
[[nodiscard]] Result<Clip> readBvhFile(const std::string& path, const BvhOptions& options = {});

/// The same for text in memory; errors name `name` as the file. Safe on hostile input.
[[nodiscard]] Result<Clip> parseBvh(std::string_view text, const std::string& name,
                                    const BvhOptions& options = {});

/// The stature (m), from the legs' length at rest, hip to ankle: so it is the same in every pose.
/// Nothing if the joints' names show no legs with knees and ankles: not a person, or one with joint
/// names that docs/formats.md does not list.
[[nodiscard]] std::optional<double> statureOf(const Skeleton& skeleton);

/// By the joints' names.
struct HeadAndFeet {
  JointId head = kNoParent;   ///< kNoParent: no joint is called so.
  std::vector<JointId> feet;  ///< Ankles.
};
[[nodiscard]] HeadAndFeet headAndFeetOf(const Skeleton& skeleton);

struct BvhAvatarOptions {
  double radiusScale = 1.0;  ///< Multiplies every radius. Finite, > 0.
};

/// One LSS per bone (a joint to each of its child joints and End Sites), in the parent joint's
/// link, with a radius from the bone's length and its role (from the joint's name). Zero-length
/// bones and pure connector bones get none if another LSS still covers the link. The rules and
/// their anthropometric source are in docs/formats.md.
[[nodiscard]] Result<Avatar> avatarFromClip(const Clip& clip, const BvhAvatarOptions& options = {});

}  // namespace foretouch
