// bench/ask/ray_scene.h: rays into a scene that stands still, beside Embree's.
#pragma once

#include <cstdint>

#include "articulated/result.h"
#include "bench/report.h"

namespace foretouch::tools {

/// In the bundled room, cut into so many triangles. Errors name a file; DeviceFailed in a build
/// without Embree.
[[nodiscard]] Result<BenchTable> raySceneTable(int triangles, int questions, std::uint64_t seed);

}  // namespace foretouch::tools
