// assets/bvh/stature.h: how tall a person is, told from a skeleton.
#pragma once

#include <optional>

#include "articulated/skeleton.h"

namespace foretouch {

/// From the length of the legs, hip to ankle, at rest (metres); so it is the same in every pose.
/// Nothing where the joints' names tell of no legs with knees and ankles: no person, or one whose
/// joints have other names than docs/formats.md lists.
[[nodiscard]] std::optional<double> statureOf(const Skeleton& skeleton);

}  // namespace foretouch
