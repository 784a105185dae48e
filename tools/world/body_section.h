// tools/world/body_section.h: parts of the tables of a world file's bodies. Only for configuration:
// it includes toml++.
#pragma once

#include <optional>
#include <string>

#include "articulated/skeleton.h"
#include "tools/settings/toml_section.h"
#include "tools/world/file_shape.h"

namespace foretouch::tools {

[[nodiscard]] inline bool hasKey(const TomlSection& section, const char* key) {
  return section.find(key) != nullptr;
}

/// What a body, or a trigger, is made of. `file`: the world's, to which paths are relative.
void readShape(TomlSection& section, const std::string& file, bool isTrigger, FileShape& shape);

/// The keys position, rotation or yaw; nothing if none of them is there.
[[nodiscard]] std::optional<RigidPose> readPlace(TomlSection& section);

}  // namespace foretouch::tools
