// assets/import/gltf_uses.h: whether the accessors of a glTF file are of the type that their
// users need: positions three numbers, inverse bind matrices sixteen. Source: Khronos, "glTF 2.0
// Specification", "Meshes", "Skins", "Animations". In foretouch-import only. Not installed.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "assets/import/faults.h"

namespace foretouch::internal {

/// Precondition: checkRules() found nothing. Faults are at paths of keys.
void checkUses(const nlohmann::json& document, Faults& faults);

}  // namespace foretouch::internal
