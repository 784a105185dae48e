// assets/import/gltf_vrm.h: what a glTF file says as an avatar of VRM 1.0 (VRMC_vrm,
// VRMC_springBone) or VRM 0.x (VRM): which node is which part of the body, and the spheres and
// capsules of its spring bones' colliders. Source: vrm-c, "vrm-specification". In foretouch-import
// only. Not installed.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "assets/import/gltf_physics.h"

namespace foretouch::internal {

struct Vrm {
  std::map<std::size_t, std::string> boneOfNode;  ///< By the node's number in the file.
  std::vector<NodeCollider> colliders;
  std::vector<std::string> notes;  ///< What is not followed or not held, one sentence each.
};

/// The avatar in a document that checkRules() has passed; empty if it is not one. Throws Failure:
/// two bones at one node, one bone twice, a collider without a shape, a negative radius, numbers
/// beyond kMaxCoordinate.
[[nodiscard]] Vrm vrmIn(const nlohmann::json& document);

/// The node's name in the model: its part of the body, where it is one. No other node has a name
/// that is a part's.
[[nodiscard]] std::string nameIn(const Vrm& vrm, std::size_t node, const std::string& own);

}  // namespace foretouch::internal
