// bench/surface.h: triangles for an avatar that has none: the skins of its LSS.
#pragma once

#include <cstddef>
#include <vector>

#include "articulated/avatar.h"
#include "lss/lss.h"

namespace foretouch::tools {

/// Per link, in its frame, triangles with their vertices on its LSS' surfaces: as fine as possible
/// with at most `count` of them in all, or as coarse as an LSS can be.
[[nodiscard]] std::vector<std::vector<Triangle>> lssSkins(const Avatar& avatar, std::size_t count);

}  // namespace foretouch::tools
