// assets/bvh/body_parts.h: the parts of a person's body, found by the names of its joints. Not
// installed.
#pragma once

#include <vector>

#include "articulated/skeleton.h"

namespace foretouch {

/// Pelvis, torso, neck and head, by their names. None if the names show none of them.
[[nodiscard]] std::vector<LinkId> namedTrunkOf(const Skeleton& skeleton);

/// Pelvis, torso, neck and head: what stays free where a person goes. All links if the names show
/// none of them.
[[nodiscard]] std::vector<LinkId> trunkOf(const Skeleton& skeleton);

/// Feet and toes: what stands on the ground. None if the names show none.
[[nodiscard]] std::vector<LinkId> feetOf(const Skeleton& skeleton);

}  // namespace foretouch
