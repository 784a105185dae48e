// assets/mesh/link_mesh_skinned.h: triangles of links by avatarFromModel()'s rule. Not installed.
#pragma once

#include <string>
#include <vector>

#include "articulated/result.h"
#include "assets/model/model.h"
#include "lss/lss.h"

namespace foretouch::internal {

/// For each of `names` the triangles of that link of the model's avatar. Links have the names of
/// their nodes; if nodes share a name, those that avatarFromModel() gives them. Error, naming
/// `path`, if the model makes no avatar or has no such link.
[[nodiscard]] Result<std::vector<std::vector<Triangle>>> surfacesOfLinks(
    const Model& model, const std::vector<std::string>& names, const std::string& path);

}  // namespace foretouch::internal
