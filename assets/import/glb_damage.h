// assets/import/glb_damage.h: damage of glTF files: of the GLB container, of its JSON, of the
// buffers that the JSON describes. Source: Khronos, "glTF 2.0 Specification": "GLB File Format
// Specification". In foretouch-import only. Not installed.
#pragma once

#include <string>

namespace foretouch::internal {

/// The file's faults, each with its place; empty if there are none.
[[nodiscard]] std::string damageOfGlb(const std::string& path);
[[nodiscard]] std::string damageOfGltf(const std::string& path);

/// Whether a GLB file's JSON ends beyond the end of the file: no reader can read it, and assimp
/// allocates the claimed length before it notices.
[[nodiscard]] bool isGlbWithoutItsJson(const std::string& path);

}  // namespace foretouch::internal
