// tools/glb/shown_contact.h: a contact of a replay, as a GLB shows it.
#pragma once

#include <cstdint>

#include "middleware/contact.h"

namespace foretouch::tools {

/// A contact that is to be shown.
struct ShownContact {
  LinkContact contact;
  std::int64_t step = 0;
  double t0S = 0.0, t1S = 0.0, timeS = 0.0;
  bool isMissedByPoses = false;
};

}  // namespace foretouch::tools
