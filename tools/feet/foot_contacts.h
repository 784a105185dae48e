// tools/feet/foot_contacts.h: when each part of a foot or hand touches, from enter to leave, as a
// WorldFollower finds it.
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "articulated/result.h"
#include "middleware/scene/scene.h"
#include "tools/feet/feet_inputs.h"

namespace foretouch::tools {

/// Free before `fromS` and after `toS`, both proven; at most the tolerance apart at `fromS`, and at
/// most twice that until `toS`. A part that is wholly below the ground no longer touches it, and
/// comes back through it: where poses show that, it is all one contact.
struct PartContact {
  std::size_t part = 0;
  ObjectId object = 0;
  double fromS = 0.0, toS = 0.0;             ///< Seconds of the clip.
  bool beganBefore = false, goesOn = false;  ///< At the first pose; at the last one.
  double underS = 0.0;                       ///< How long it is below the ground, by poses.
  GroundSurface surface;                     ///< The one that it met, its normal towards the part.
};

struct PartContacts {
  std::vector<PartContact> contacts;  ///< By part, then by time; those of one part do not overlap.
  double unresolvedS = 0.0;           ///< For all parts together: nothing is claimed there.
};

/// For feet, only with surfaces level enough to stand on. Errors: those of WorldFollower::follow().
[[nodiscard]] Result<PartContacts> partContactsOf(const FeetInputs& inputs);

}  // namespace foretouch::tools
