// middleware/scene/triangle_id.h: the numbers of a scene's triangles and objects.
#pragma once

#include <cstdint>

namespace foretouch {

using TriangleId = std::int32_t;
using ObjectId = std::int32_t;

}  // namespace foretouch
