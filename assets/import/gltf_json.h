// assets/import/gltf_json.h: parts of a glTF file's JSON that checkRules() has passed. In
// foretouch-import only. Not installed.
#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace foretouch::internal {

inline constexpr char kMeshoptCompression[] = "EXT_meshopt_compression";
inline constexpr char kDracoCompression[] = "KHR_draco_mesh_compression";
inline constexpr char kInstancing[] = "EXT_mesh_gpu_instancing";

/// Null if there is none.
[[nodiscard]] inline const nlohmann::json* memberOf(const nlohmann::json& object,
                                                    std::string_view key) {
  if (!object.is_object()) return nullptr;
  const auto found = object.find(std::string(key));
  return found == object.end() ? nullptr : &*found;
}

[[nodiscard]] inline const nlohmann::json* extensionOf(const nlohmann::json& object,
                                                       std::string_view name) {
  const nlohmann::json* const extensions = memberOf(object, "extensions");
  return extensions == nullptr ? nullptr : memberOf(*extensions, name);
}

/// The number of elements of a list in it; 0 if it is none.
[[nodiscard]] inline std::size_t sizeOf(const nlohmann::json& object, std::string_view list) {
  const nlohmann::json* const found = memberOf(object, list);
  return found == nullptr || !found->is_array() ? 0 : found->size();
}

/// Its name, else its place in the file.
[[nodiscard]] inline std::string nameOf(const nlohmann::json& object, const std::string& place) {
  const nlohmann::json* const name = memberOf(object, "name");
  if (name == nullptr || !name->is_string()) return place;
  const auto& text = name->get_ref<const std::string&>();
  return text.empty() ? place : text;
}

}  // namespace foretouch::internal
