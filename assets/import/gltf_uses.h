// assets/import/gltf_uses.h: whether the accessors of a glTF file have the type that their users
// need: three numbers for positions, sixteen for inverse bind matrices. Source: Khronos, "glTF 2.0
// Specification", "Meshes", "Skins", "Animations". In foretouch-import only. Not installed.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "assets/import/faults.h"

namespace foretouch::internal {

/// Precondition: checkRules() found nothing. Faults are at paths of keys.
void checkUses(const nlohmann::json& document, Faults& faults);

}  // namespace foretouch::internal
