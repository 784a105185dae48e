// assets/import/gltf_physics.h: what a glTF file states as colliders, as LSS: spheres and capsules
// of KHR_implicit_shapes that are colliders by KHR_physics_rigid_bodies. Source: the drafts of both
// (eoineoineoin/glTF_Physics). In foretouch-import only. Not installed.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "lss/lss.h"

namespace foretouch::internal {

/// A sphere or capsule that a node of a file carries.
struct NodeCollider {
  std::size_t node = 0;  ///< In the file.
  std::string place;     ///< In the JSON.
  Lss lss;               ///< In the node's frame, as glTF has it: right-handed.
  /// The node is there only for the collider: nothing else is in it or below it, and no animation
  /// moves it. So the collider is its parent's.
  bool isAlone = false;
};

/// The same collider. Throws Failure: a negative radius, or numbers beyond kMaxCoordinate.
[[nodiscard]] NodeCollider checkedCollider(NodeCollider collider);

struct GltfColliders {
  std::vector<NodeCollider> colliders;
  std::vector<std::string> notes;  ///< What is not an LSS, one sentence each.
};

/// The colliders of a document that checkRules() has passed. A capsule of two radii becomes the LSS
/// with the larger one, which holds it. Throws Failure as checkedCollider() does, and for a shape
/// that is not there.
[[nodiscard]] GltfColliders gltfColliders(const nlohmann::json& document);

}  // namespace foretouch::internal
