#include "assets/mesh/link_mesh_skinned.h"

#include "articulated/try.h"
#include "assets/model/model_avatar.h"
#include "assets/text_file.h"
#include "lss/index.h"

namespace foretouch::internal {

Result<std::vector<std::vector<Triangle>>> surfacesOfLinks(const Model& model,
                                                           const std::vector<std::string>& names,
                                                           const std::string& path) {
  FORETOUCH_TRY(const auto made, inFile(avatarFromModel(model), path));
  std::vector<std::vector<Triangle>> surfaces;
  for (const std::string& name : names) {
    const auto link = made.avatar.skeleton().find(name);
    if (!link.has_value()) {
      return Error::in(path, ErrorCode::UnknownName,
                       "no link of the model is named " + inQuotes(name));
    }
    surfaces.push_back(made.surface[slotOf(*link)]);
  }
  return surfaces;
}

}  // namespace foretouch::internal
