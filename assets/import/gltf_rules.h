// assets/import/gltf_rules.h: what the JSON of a glTF file must hold for a reader to go on: the
// keys that are required, their types, and numbers that name other things of the file. Source:
// Khronos, "glTF 2.0 Specification", "Properties Reference". In foretouch-import only.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "assets/import/faults.h"

namespace foretouch::internal {

/// Faults are at paths of keys: "accessors[3].bufferView".
void checkRules(const nlohmann::json& document, Faults& faults);

}  // namespace foretouch::internal
