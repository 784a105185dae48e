// tests/assets/vrm_writer.h: small VRM avatars written by the test: a person of triangles in a
// T-pose, with spring bones and their colliders. Shares no code with the reader.
#pragma once

#include <map>
#include <string>

#include <Eigen/Geometry>

#include "tests/assets/gltf_writer.h"

namespace foretouch::test {

enum class VrmVersion { Old, One };  ///< 0.x, 1.0.

struct VrmSample {
  GltfWriter file;
  std::map<std::string, std::size_t> nodeOf;       ///< By VRM 1.0's bone, or own name.
  std::map<std::string, Eigen::Affine3d> frameOf;  ///< The same nodes, in the world.
  [[nodiscard]] nlohmann::json& extension(const std::string& name) {
    return file.root["extensions"][name];
  }
};

/// Bones called "Bone00" and so on. VRM 1.0 faces +z, its bones are turned at rest, and its root
/// too; VRM 0.x faces -z and turns nothing. Beside them "SkirtBack" at the hips and "hair" at the
/// head, both spring bones; a sphere at the head, and in VRM 1.0 a capsule at the left upper arm, a
/// plane, a sphere that holds hair inside, and a node constraint.
VrmSample vrmSample(VrmVersion version);

/// Where `bone` is in the T-pose of a person who faces +z.
Eigen::Vector3d placeInTPose(const std::string& bone);

}  // namespace foretouch::test
