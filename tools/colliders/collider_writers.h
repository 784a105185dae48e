// tools/colliders/collider_writers.h: an avatar's LSS as colliders of other tools, a writer for
// each format. Each takes an avatar whose LSS asCollider() has made, and states every LSS in its
// link's frame, never smaller (tools/colliders/capsule_forms.h). Frames: an avatar's world is
// right-handed with +Y up, in metres.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/result.h"

namespace foretouch::tools {

/// A GLB: a node per link, and below it one per LSS with a shape of KHR_implicit_shapes, as a
/// collider of KHR_physics_rigid_bodies. Source: the drafts of both, eoineoineoin/glTF_Physics.
[[nodiscard]] Result<std::string> gltfColliders(const Avatar& avatar);

/// MuJoCo's XML, +Z up: a body per link, roots free, all others on ball joints; a geom per LSS.
[[nodiscard]] std::string mjcfColliders(const Avatar& avatar, const std::string& name);

enum class UrdfCapsules : std::uint8_t {
  Capsules,  ///< <capsule> of URDF 1.1.
  Parts,     ///< A cylinder and two spheres, which together are the same capsule.
};
/// URDF, +Z up: a link per link, on floating joints, as URDF has no ball joint. Several roots hang
/// on an added link, as URDF takes only one root.
[[nodiscard]] std::string urdfColliders(const Avatar& avatar, const std::string& name,
                                        UrdfCapsules capsules);

enum class GodotVersion : std::uint8_t { Three, Four };
/// A scene of Godot in text: a skeleton at rest, and per link with LSS a BoneAttachment with a body
/// and its shapes. `notes`: names that Godot does not take, and what replaced them.
[[nodiscard]] std::string godotColliders(const Avatar& avatar, const std::string& name,
                                         GodotVersion version, std::vector<std::string>& notes);

/// JSON for Unity, in its left-handed frame (docs/colliders.md has its fields).
[[nodiscard]] std::string unityColliders(const Avatar& avatar);

/// A copy of the VRM avatar `path` with these colliders added to those of its spring bones, each of
/// which then minds them. All else stays as it is. LSS that are colliders of the file already are
/// not added again. Error: not a VRM avatar, or one whose bones rest elsewhere than the avatar's.
[[nodiscard]] Result<std::string> vrmColliders(const Avatar& avatar, const std::string& path,
                                               std::vector<std::string>& notes);

}  // namespace foretouch::tools
