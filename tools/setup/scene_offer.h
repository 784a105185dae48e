// tools/setup/scene_offer.h: the unit and the up axis of a scene, from its triangles.
#pragma once

#include <string>

#include "assets/import/scene_import.h"
#include "middleware/scene/scene.h"
#include "tools/setup/offer.h"

namespace foretouch::tools {

/// Which axis points up in a scene that was read as it is. A level is lower than it is wide, and
/// its floors show their front upwards. Sure only where its height shows it, and its floors do not
/// say otherwise.
[[nodiscard]] Offer<UpAxis> sceneUpAxisOf(const RawScene& raw);

/// Metres per unit of a scene whose axis is known (already turned). The smallest of metres,
/// centimetres and millimetres in which a person finds room; sure only of metres, because inches
/// look like centimetres.
[[nodiscard]] Offer<double> sceneUnitOf(const RawScene& raw);

}  // namespace foretouch::tools
