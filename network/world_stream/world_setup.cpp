#include "network/world_stream/world_setup.h"

#include <algorithm>

namespace foretouch {

bool hasSolidBodies(const WorldSetup& setup) {
  return std::any_of(setup.avatars.begin(), setup.avatars.end(),
                     [](const auto& avatar) { return avatar.solid.has_value(); });
}

const SolidOptions* solidOptionsOf(const WorldSetup& setup, BodyNumber body) {
  for (const WorldSetup::ServedAvatar& avatar : setup.avatars) {
    if (avatar.number == body && avatar.solid) return &*avatar.solid;
  }
  return nullptr;
}

}  // namespace foretouch
