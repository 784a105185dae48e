// Stands in for articulated/model_avatar.cpp where that is not built: link meshes of models with
// bones are then refused.
#include "articulated/model_avatar.h"

namespace foretouch {

Result<ModelAvatar> avatarFromModel(const Model&, const ModelAvatarOptions&) {
  return Error{ErrorCode::ImportFailed, "", -1, -1, "models with bones are not built in"};
}

}  // namespace foretouch
