// assets/model/model_ownership.h: which node of a model moves which triangle, from the skins'
// weights. Internal to model_avatar and model_clip.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "assets/model/model.h"

namespace foretouch::internal {

struct NodeInfluence {
  std::int32_t node = 0;
  double weight = 0.0;  ///< > 0
};

/// What moves one ModelMesh. A mesh without bones has no influences: all of it moves with its node.
struct MeshOwnership {
  /// Per vertex, ascending by node, weights summing to one; a vertex without usable weights follows
  /// the mesh's own node.
  std::vector<std::vector<NodeInfluence>> influences;
  std::vector<std::int32_t> ownerOfTriangle;  ///< Per triangle, a node.
};

struct ModelOwnership {
  std::vector<MeshOwnership> meshes;
  std::vector<bool> carries;   ///< Per node: does it own a triangle or move a corner of one?
  std::size_t badWeights = 0;  ///< NaN, infinite, negative, or of no vertex of the mesh.
  std::size_t unweighted = 0;  ///< Triangles of skins given to the mesh's own node.
  std::size_t shared = 0;      ///< Triangles whose vertices follow more than one node.
  std::size_t unknownBoneWeights = 0;     ///< Weights of bones that the file names but does not
                                          ///< contain.
  std::vector<std::string> unknownBones;  ///< Their names.
};

/// A triangle goes to the node with the largest sum of its vertices' weights; of several, to the
/// lowest. Precondition: indices of nodes and vertices of triangles are in range.
[[nodiscard]] ModelOwnership ownershipOf(const Model& model);

}  // namespace foretouch::internal
