// assets/import/gltf_file.h: a glTF file as its container has it: the JSON, and in a GLB the chunk
// of bytes behind it. Source: Khronos, "glTF 2.0 Specification": "GLB File Format Specification".
// In foretouch-import only. Not installed.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace foretouch::internal {

struct GltfFile {
  std::string path, bytes;
  nlohmann::json document;  ///< Meets checkRules().
  bool isBinary = false;    ///< A GLB.
  std::size_t chunkBegin = 0;
  std::optional<std::size_t> chunkBytes;  ///< The size of a GLB's second chunk.

  [[nodiscard]] std::string_view chunk() const {
    return std::string_view(bytes).substr(chunkBegin, chunkBytes.value_or(0));
  }
};

/// Is it a glTF file, by its extension?
[[nodiscard]] bool isGltf(const std::string& path);

/// Throws Failure, which names each fault with its place: a byte, a line or a path of keys.
[[nodiscard]] GltfFile openGltf(const std::string& path);

}  // namespace foretouch::internal
