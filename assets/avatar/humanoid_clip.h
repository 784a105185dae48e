// assets/avatar/humanoid_clip.h: the clip of one humanoid for the body of another: joints by their
// part of the body (assets/human_bones.h), whatever they are called and however they are turned at
// rest. Not installed.
#pragma once

#include <optional>

#include "articulated/clip.h"
#include "articulated/result.h"
#include "articulated/skeleton.h"

namespace foretouch {

/// The clip's motion on `avatar`: each part of the body turns in the world as the clip's does, from
/// rest on, and the hips go where the clip's go, at the clip's size. Both rest alike for that: as a
/// T-pose, whichever way each faces and whichever axis is up. Joints that are not part of the body,
/// or that the clip lacks, keep their rest. Notes say what was matched, and how far the rest poses
/// and the lengths of the legs differ.
///
/// Nothing if `avatar` is not a humanoid, or the clip is not by its names, or has the avatar's own
/// names and rest. Error (Mismatch) if the clip rests otherwise than the avatar: then its turns
/// mean something else.
[[nodiscard]] Result<std::optional<Clip>> humanoidClip(const Skeleton& avatar, const Clip& clip);

}  // namespace foretouch
