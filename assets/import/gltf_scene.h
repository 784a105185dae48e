// assets/import/gltf_scene.h: a glTF file's scene: its nodes, and the triangles of its meshes. Both
// what becomes a scene and what becomes a model are made of it. Source: Khronos, "glTF 2.0
// Specification". In foretouch-import only. Not installed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "assets/file_frame.h"
#include "assets/import/gltf_data.h"
#include "assets/import/polygon.h"
#include "assets/model/model.h"

namespace foretouch::internal {

class DracoMesh;

struct GltfNode {
  std::optional<std::size_t> index;  ///< In the file; none: the one that is not in it.
  std::int32_t parent = -1;          ///< Position in the walk; -1: a root.
  std::string name;
  Affine toParent;
  std::optional<std::size_t> mesh, skin;
  bool isOnlooker = false;  ///< It holds a camera or a light.
};

/// A primitive of a mesh, its morph targets applied at their default weights.
struct GltfPrimitive {
  std::string name;
  std::vector<Eigen::Vector3d> vertices;
  std::vector<CornerTriple> triangles;  ///< Indices are in range.
  std::uint64_t skippedPrimitives = 0, skippedFaces = 0;
  /// Pairs of JOINTS_n and WEIGHTS_n, each of four numbers per vertex.
  std::vector<std::pair<GltfNumbers, GltfNumbers>> influences;
};

/// Metres and +Y up: the format knows no others.
[[nodiscard]] inline FileFrame gltfFrame() {
  FileFrame frame;
  frame.declared = {1.0, UpAxis::Y, true};
  return frame;
}

/// Everything throws Failure.
class GltfScene {
 public:
  /// Refuses a file that requires what is not understood, by name.
  explicit GltfScene(const std::string& path);

  /// The nodes of the file's default scene, parents before children, children in order. Several
  /// roots stand below one that is not in the file, "ROOT". `limit` is for their number.
  [[nodiscard]] std::vector<GltfNode> nodes(std::size_t limit);
  /// The primitives of the node's mesh; none if it has no mesh. Valid as long as this is.
  [[nodiscard]] const std::vector<GltfPrimitive>& primitivesOf(const GltfNode& node);
  /// Where copies of the node's mesh stand, in the node's frame: one, unless it says otherwise
  /// (EXT_mesh_gpu_instancing).
  [[nodiscard]] std::vector<Affine> instancesOf(const GltfNode& node);

  [[nodiscard]] GltfData& data() { return data_; }
  [[nodiscard]] const nlohmann::json& document() const { return data_.document(); }
  /// Primitives of all meshes.
  [[nodiscard]] std::size_t numPrimitives() const;

  /// What the file has that is not read, one sentence each, as far as known by now.
  [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }
  void note(const std::string& text);

 private:
  void checkExtensions();
  [[nodiscard]] GltfNode nodeAt(std::size_t index, std::int32_t parent);
  [[nodiscard]] GltfPrimitive read(const nlohmann::json& primitive, const std::string& place,
                                   const nlohmann::json* weights);
  void addCorners(const nlohmann::json& primitive, const std::string& place, const DracoMesh* draco,
                  GltfPrimitive& out);
  void morph(const nlohmann::json& primitive, const std::string& place,
             const nlohmann::json* weights, GltfPrimitive& out);

  GltfData data_;
  /// Per mesh and, where a node has weights of its own, that node.
  std::map<std::pair<std::size_t, std::optional<std::size_t>>, std::vector<GltfPrimitive>> meshes_;
  std::vector<std::string> notes_;
};

}  // namespace foretouch::internal
