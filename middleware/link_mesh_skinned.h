// middleware/link_mesh_skinned.h: triangles of nodes by avatarFromModel()'s rule. Not installed.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "articulated/model.h"
#include "articulated/result.h"
#include "lss/triangle.h"

namespace foretouch::internal {

/// For each of `nodes` (of `model`) the triangles of the link that moves with it. Error, naming
/// `path`, where the model makes no avatar or a node no link.
[[nodiscard]] Result<std::vector<std::vector<Triangle>>> surfacesOfBones(
    const Model& model, const std::vector<std::int32_t>& nodes, const std::string& path);

}  // namespace foretouch::internal
