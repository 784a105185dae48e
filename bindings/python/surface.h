// bindings/python/surface.h: an avatar's own triangles, and that avatar.
#pragma once

#include <memory>

#include "articulated/avatar.h"
#include "middleware/surface/avatar_surface.h"

namespace foretouch::python {

struct Surface {
  std::shared_ptr<Avatar> avatar;
  AvatarSurface triangles;
};

struct SkinOfAvatar {
  std::shared_ptr<Avatar> avatar;
  SkinnedSurface skin;
};

}  // namespace foretouch::python
