// articulated/raw_skeleton.h: from a validated skeleton back to what an author gives, to add to it
// or to send it. Not installed.
#pragma once

#include "articulated/skeleton.h"

namespace foretouch {

/// The authoring form of a validated skeleton: Skeleton::build() makes the same of it.
[[nodiscard]] RawSkeleton rawSkeleton(const Skeleton& skeleton);

}  // namespace foretouch
