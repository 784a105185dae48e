// assets/bvh/bvh_avatar.h: an avatar made from a clip's skeleton: one LSS per bone.
#pragma once

#include "articulated/avatar.h"
#include "articulated/clip.h"
#include "articulated/result.h"

namespace foretouch {

struct BvhAvatarOptions {
  double radiusScale = 1.0;  ///< Multiplies every radius. Finite, > 0.
};

/// One LSS per bone (a joint to each of its child joints and End Sites), in the parent joint's
/// link, with a radius from the bone's length and its role (from the joint's name). Zero-length
/// bones and pure connector bones get none if another LSS still covers the link. The rules and
/// their anthropometric source are in docs/formats.md.
[[nodiscard]] Result<Avatar> avatarFromClip(const Clip& clip, const BvhAvatarOptions& options = {});

}  // namespace foretouch
