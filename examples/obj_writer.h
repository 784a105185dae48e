// examples/obj_writer.h: a scene as a Wavefront OBJ file, one `o` line per object.
#pragma once

#include <string>
#include <vector>

#include "examples/mesh_builder.h"

namespace foretouch::examples {

/// The file's text; coordinates to 10 micrometres.
[[nodiscard]] std::string objText(const std::vector<MeshObject>& objects);

}  // namespace foretouch::examples
