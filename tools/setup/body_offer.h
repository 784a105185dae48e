// tools/setup/body_offer.h: the unit and the up axis of a clip, from the body that it moves.
#pragma once

#include "articulated/clip.h"
#include "assets/import/scene_import.h"
#include "tools/setup/offer.h"

namespace foretouch::tools {

/// Metres per unit of a clip. A person's legs show the stature; of
/// the units that exporters use, one makes it that of an adult, and no two do. Without legs, or
/// where no unit fits: unsure, by the size of the skeleton. `isInMetres`: the file's format says so
/// (glTF, URDF), or its reader has converted it. `readAs`: the scale that it was read with, if it
/// was another one: the offer is a factor on it, and its reason names the unit of the file.
[[nodiscard]] Offer<double> unitOf(const Clip& clip, bool isInMetres, double readAs = 1.0);

/// Which axis points from feet to head, over the whole clip; at rest where names do not show feet
/// and head. Unsure if the body lies, or hangs head down. `isUpright`: its reader has turned it.
[[nodiscard]] Offer<UpAxis> upAxisOf(const Clip& clip, bool isUpright);

/// The largest side (m) of the box around all joints at rest.
[[nodiscard]] double reachOf(const Clip& clip);

/// "centimetres" for 0.01; "0.7 m per unit" for a number that no exporter is known to use.
[[nodiscard]] std::string unitInWords(double metres);

}  // namespace foretouch::tools
