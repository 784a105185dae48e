// tools/glb/gltf_document.h: glTF 2.0 under construction, and the GLB container around it (Khronos,
// "glTF 2.0 Specification": "Binary Data Storage" and "GLB File Format Specification").
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "articulated/result.h"

namespace foretouch::tools {

/// The use of a view's bytes: glTF's numbers. Animations and the like have none.
enum class ViewTarget : int { None = 0, Vertices = 34962, Indices = 34963 };

/// glTF's numbers.
enum class ComponentType : int { UnsignedInt = 5125, Float = 5126 };

/// A row of numbers in a view.
struct Accessor {
  std::size_t view = 0, byteOffset = 0, count = 0;
  const char* type = "SCALAR";  ///< "SCALAR", "VEC3" or "VEC4".
  ComponentType componentType = ComponentType::Float;
  nlohmann::json low, high;  ///< Arrays; null: not stated.
};

/// The JSON, and the places of its views in the one binary buffer. The caller keeps the bytes
/// themselves: view after view, in the order added.
class GltfDocument {
 public:
  explicit GltfDocument(const std::string& generator);

  /// Adds a view at the buffer's end. `byteLength` is a multiple of four (asserted), so that all
  /// views are aligned. Returns the view's index.
  std::size_t addView(std::size_t byteLength, ViewTarget target, std::size_t byteStride = 0);
  std::size_t addAccessor(const Accessor& accessor);
  /// Adds to one of the document's lists ("nodes", "meshes", "materials", ...); returns its index.
  std::size_t add(const char* list, nlohmann::json entry);
  [[nodiscard]] nlohmann::json& at(const char* list, std::size_t index) {
    return root_[list][index];
  }
  /// Says that the document uses the extension; `content`: what the document holds of it as a
  /// whole, or null.
  void extend(const char* extension, nlohmann::json content);
  /// Adds a node to the scene.
  void show(std::size_t node) { root_["scenes"][0]["nodes"].push_back(node); }

  [[nodiscard]] std::size_t binaryBytes() const { return binaryBytes_; }

  /// The GLB up to the buffer's bytes, which come last. Error if it exceeds the container's 32-bit
  /// sizes.
  [[nodiscard]] Result<std::string> glbHead() const;

 private:
  nlohmann::json root_;
  std::size_t binaryBytes_ = 0;
};

/// A vector as glTF writes it.
[[nodiscard]] nlohmann::json gltfVector(const Eigen::Vector3d& v);

/// Appends a number's bytes. Little-endian, like every supported machine.
void appendFloat(std::string& bytes, double value);
void appendIndex(std::string& bytes, std::uint32_t index);

}  // namespace foretouch::tools
