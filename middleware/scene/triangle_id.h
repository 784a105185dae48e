// middleware/scene/triangle_id.h: how a scene's triangles and objects are called.
#pragma once

#include <cstdint>

namespace foretouch {

using TriangleId = std::int32_t;
using ObjectId = std::int32_t;

}  // namespace foretouch
