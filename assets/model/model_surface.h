// assets/model/model_surface.h: a model's triangles in the frames of the links that own them, and
// the skin over them. Internal to model_avatar.
#pragma once

#include <cstddef>
#include <vector>

#include "articulated/avatar.h"
#include "assets/model/model.h"
#include "assets/model/model_links.h"
#include "assets/model/model_ownership.h"
#include "lss/lss.h"

namespace foretouch::internal {

struct ModelSurface {
  std::vector<std::vector<Triangle>> triangles;  ///< Per link, in its frame, rounded to float.
  Skin skin;                                     ///< The same triangles, link by link.
  std::size_t dropped = 0;  ///< A vertex was not finite or beyond kMaxCoordinate.
};

/// A skin's vertex is placed in a link by the bone's meshToBone, that is by its place at bind time;
/// any other by the node's frame. The frames' shape goes into the vertices.
[[nodiscard]] ModelSurface surfaceOf(const Model& model, const ModelLinks& links,
                                     const ModelOwnership& ownership);

}  // namespace foretouch::internal
