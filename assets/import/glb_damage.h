// assets/import/glb_damage.h: damage of glTF files: of the GLB container, of its JSON, of what
// that says about its buffers. Source: Khronos, "glTF 2.0 Specification": "GLB File Format
// Specification". In foretouch-import only. Not installed.
#pragma once

#include <string>

namespace foretouch::internal {

/// What is wrong with the file, each with its place; empty where nothing is found.
[[nodiscard]] std::string damageOfGlb(const std::string& path);
[[nodiscard]] std::string damageOfGltf(const std::string& path);

/// Whether a GLB file's JSON ends beyond the end of the file: no reader can read it, and assimp
/// takes the memory that the length claims before it finds out.
[[nodiscard]] bool isGlbWithoutItsJson(const std::string& path);

}  // namespace foretouch::internal
