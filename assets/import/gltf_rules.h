// assets/import/gltf_rules.h: the rules that a glTF file's JSON must meet before a reader
// continues: required keys, their types, and indices of other parts of the file. Source: Khronos,
// "glTF 2.0 Specification", "Properties Reference". In foretouch-import only.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "assets/import/faults.h"

namespace foretouch::internal {

/// Faults are at paths of keys: "accessors[3].bufferView".
void checkRules(const nlohmann::json& document, Faults& faults);

}  // namespace foretouch::internal
