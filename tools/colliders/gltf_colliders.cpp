#include <nlohmann/json.hpp>

#include "articulated/try.h"
#include "lss/index.h"
#include "tools/colliders/capsule_forms.h"
#include "tools/colliders/collider_writers.h"
#include "tools/glb/gltf_document.h"

namespace foretouch::tools {
namespace {

using nlohmann::json;

constexpr char kShapes[] = "KHR_implicit_shapes", kBodies[] = "KHR_physics_rigid_bodies";

json quaternionOf(const Quaternion& q) {
  return json::array({q.x(), q.y(), q.z(), q.w()});
}

json shapeOf(const StandingCapsule& capsule) {
  if (capsule.halfLength == 0.0) {
    return {{"type", "sphere"}, {"sphere", {{"radius", capsule.radius}}}};
  }
  // Twice a float is a float.
  return {{"type", "capsule"},
          {"capsule",
           {{"height", 2.0 * capsule.halfLength},
            {"radiusBottom", capsule.radius},
            {"radiusTop", capsule.radius}}}};
}

/// A collider is about its node's origin, so each has a node of its own.
std::size_t addCollider(const Lss& lss, const std::string& name, json& shapes,
                        GltfDocument& document) {
  const StandingCapsule capsule = standing(lss, Eigen::Vector3d::UnitY(), HeldAs::Floats);
  const json collider = {{"geometry", {{"shape", shapes.size()}}}};
  json node = {{"name", name},
               {"translation", gltfVector(capsule.middle)},
               {"extensions", {{kBodies, {{"collider", collider}}}}}};
  if (capsule.halfLength > 0.0) node["rotation"] = quaternionOf(capsule.turn);
  shapes.push_back(shapeOf(capsule));
  return document.add("nodes", std::move(node));
}

json nodeOf(const Avatar& avatar, LinkId link) {
  const Skeleton& skeleton = avatar.skeleton();
  json node = {{"name", skeleton.name(link)},
               {"translation", gltfVector(skeleton.restOffset(link))},
               {"rotation", quaternionOf(skeleton.restRotation(link))}};
  // Poses move it, and no force does.
  if (!avatar.lss(link).empty()) {
    node["extensions"][kBodies] = {{"motion", {{"isKinematic", true}}}};
  }
  return node;
}

}  // namespace

Result<std::string> gltfColliders(const Avatar& avatar) {
  GltfDocument document("foretouch " FORETOUCH_VERSION);
  const Skeleton& skeleton = avatar.skeleton();
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    const std::size_t node = document.add("nodes", nodeOf(avatar, link));
    const LinkId parent = skeleton.parent(link);
    if (parent == kNoParent) {
      document.show(node);
    } else {
      document.at("nodes", slotOf(parent))["children"].push_back(node);
    }
  }
  json shapes = json::array();
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    const auto& list = avatar.lss(link);
    for (std::size_t i = 0; i < list.size(); ++i) {
      const std::string name = skeleton.name(link) + " collider " + std::to_string(i);
      const std::size_t node = addCollider(list[i], name, shapes, document);
      document.at("nodes", slotOf(link))["children"].push_back(node);
    }
  }
  document.extend(kShapes, {{"shapes", std::move(shapes)}});
  document.extend(kBodies, nullptr);
  return document.glbHead();
}

}  // namespace foretouch::tools
