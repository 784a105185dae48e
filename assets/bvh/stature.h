// assets/bvh/stature.h: a person's height, head and feet, from a skeleton.
#pragma once

#include <optional>
#include <vector>

#include "articulated/skeleton.h"

namespace foretouch {

/// From the length of the legs, hip to ankle, at rest (metres); so it is the same in every pose.
/// Nothing if the joints' names show no legs with knees and ankles: not a person, or one with joint
/// names that docs/formats.md does not list.
[[nodiscard]] std::optional<double> statureOf(const Skeleton& skeleton);

/// By the joints' names.
struct HeadAndFeet {
  JointId head = kNoParent;   ///< kNoParent: no joint is called so.
  std::vector<JointId> feet;  ///< Ankles.
};
[[nodiscard]] HeadAndFeet headAndFeetOf(const Skeleton& skeleton);

}  // namespace foretouch
