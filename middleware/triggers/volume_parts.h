// middleware/triggers/volume_parts.h: the contents of a TriggerVolume. Not installed.
#pragma once

#include <optional>

#include "articulated/avatar.h"
#include "middleware/exact/closed_mesh.h"

namespace foretouch::internal {

/// A body that is solid, so that touching it is being in it; or one of whose surface alone can be
/// touched, and which has an inside besides.
struct VolumeParts {
  std::optional<Avatar> solid;  // of one joint
  std::optional<ClosedMesh> mesh;
};

}  // namespace foretouch::internal
