#include "middleware/link_mesh_skinned.h"

#include <algorithm>

#include "articulated/model_avatar.h"

namespace foretouch::internal {

Result<std::vector<std::vector<Triangle>>> surfacesOfBones(const Model& model,
                                                           const std::vector<std::int32_t>& nodes,
                                                           const std::string& path) {
  auto made = avatarFromModel(model);
  if (!made.ok()) {
    Error error = made.error();
    error.file = path;
    return error;
  }
  const ModelAvatar& avatar = made.value();
  std::vector<std::vector<Triangle>> surfaces;
  for (const std::int32_t node : nodes) {
    const auto link = std::find(avatar.nodeOfLink.begin(), avatar.nodeOfLink.end(), node);
    if (link == avatar.nodeOfLink.end()) {
      return Error{ErrorCode::UnknownName, path, -1, -1,
                   "the node '" + model.nodes[static_cast<std::size_t>(node)].name +
                       "' is no link of the model's avatar"};
    }
    surfaces.push_back(avatar.surface[static_cast<std::size_t>(link - avatar.nodeOfLink.begin())]);
  }
  return surfaces;
}

}  // namespace foretouch::internal
