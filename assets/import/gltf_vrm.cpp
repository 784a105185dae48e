#include "assets/import/gltf_vrm.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "articulated/quoted.h"
#include "articulated/skeleton.h"
#include "assets/human_bones.h"
#include "assets/import/failure.h"
#include "assets/import/gltf_data.h"
#include "assets/import/gltf_json.h"
#include "assets/import/text.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;
using nlohmann::json;

constexpr char kVrm[] = "VRMC_vrm", kOldVrm[] = "VRM", kSprings[] = "VRMC_springBone";
constexpr char kExtended[] = "VRMC_springBone_extended_collider";
constexpr char kConstraint[] = "VRMC_node_constraint";

const json& listIn(const json& object, std::string_view key) {
  static const json none = json::array();
  const json* const found = memberOf(object, key);
  return found == nullptr ? none : *found;
}

/// Reads one document; a class as every part adds to the same avatar.
class VrmReader {
 public:
  explicit VrmReader(const json& document) : document_(document) {}

  Vrm read() {
    const json* const vrm = extensionOf(document_, kVrm);
    const json* const old = extensionOf(document_, kOldVrm);
    const json* const springs = extensionOf(document_, kSprings);
    if (vrm != nullptr) {
      noteVersion(*vrm, kVrm);
      addBones((*vrm)["humanoid"]["humanBones"]);
    } else if (old != nullptr) {
      addOldBones((*old)["humanoid"]["humanBones"]);
      vrm_.notes.emplace_back("it is of VRM 0.x and faces -z, as such avatars do");
    }
    if (vrm != nullptr || old != nullptr) noteBones();
    if (springs != nullptr) {
      noteVersion(*springs, kSprings);
      addSprings(*springs);
    } else if (const json* const moved = old ? memberOf(*old, "secondaryAnimation") : nullptr) {
      addOldSprings(*moved);
    }
    noteSprings();
    noteConstraints();
    return std::move(vrm_);
  }

 private:
  void noteVersion(const json& extension, const std::string& name) {
    const json* const version = memberOf(extension, "specVersion");
    if (version != nullptr && (*version == "1.0" || *version == "1.0-beta")) return;
    vrm_.notes.push_back(
        name + " says of itself " +
        (version == nullptr ? "no specVersion" : "the specVersion " + quotedName(version->dump())) +
        " and is read as 1.0");
  }

  void addBone(const std::string& place, const std::string& bone, std::size_t node) {
    if (!isHumanBone(bone)) {
      vrm_.notes.push_back(place + ": " + inQuotes(bone) +
                           " is no bone of a VRM humanoid and is left out");
      return;
    }
    if (!bones_.insert(bone).second) {
      refuseAt(place, "expected the bone " + inQuotes(bone) + " once, found it again");
    }
    const auto [found, isNew] = vrm_.boneOfNode.emplace(node, bone);
    if (isNew) return;
    refuseAt(place + ".node", "expected a node of its own, found nodes[" + std::to_string(node) +
                                  "], which is " + inQuotes(found->second) + " already");
  }

  void addBones(const json& bones) {
    // A beta of 1.0 had the old names of the thumb.
    const bool isBeta =
        bones.contains("leftThumbIntermediate") || bones.contains("rightThumbIntermediate");
    for (const auto& [name, bone] : bones.items()) {
      addBone("extensions.VRMC_vrm.humanoid.humanBones." + inQuotes(name),
              isBeta ? thumbOf(name) : name, bone["node"].get<std::size_t>());
    }
  }

  void addOldBones(const json& bones) {
    for (std::size_t i = 0; i < bones.size(); ++i) {
      addBone("extensions.VRM.humanoid." + placeIn("humanBones", i),
              thumbOf(bones[i]["bone"].get<std::string>()), bones[i]["node"].get<std::size_t>());
    }
  }

  void noteBones() {
    std::string missing;
    for (const std::string_view bone : kRequiredHumanBones) {
      if (bones_.count(bone) == 0) missing += (missing.empty() ? "" : ", ") + inQuotes(bone);
    }
    if (!missing.empty()) {
      vrm_.notes.push_back("its humanoid lacks bones that VRM requires: " + missing);
    }
    if (vrm_.boneOfNode.empty()) return;
    const auto& [node, bone] = *vrm_.boneOfNode.begin();
    vrm_.notes.push_back(std::to_string(vrm_.boneOfNode.size()) +
                         " nodes are called by their part of the body, such as " + inQuotes(bone) +
                         " for " +
                         quotedName(nameOf(document_["nodes"][node], placeIn("nodes", node))));
  }

  void addCollider(std::size_t node, const std::string& place, const Lss& lss) {
    vrm_.colliders.push_back(checkedCollider({node, place, lss}));
  }

  static Vector3d vectorIn(const json& object, std::string_view key) {
    const json* const found = memberOf(object, key);
    if (found == nullptr) return Vector3d::Zero();
    return {(*found)[0].get<double>(), (*found)[1].get<double>(), (*found)[2].get<double>()};
  }

  static double numberIn(const json& object, std::string_view key) {
    const json* const found = memberOf(object, key);
    return found == nullptr ? 0.0 : found->get<double>();
  }

  /// Nothing of a shape that bounds from outside: it holds no body.
  std::optional<Lss> lssOf(const json& shape, const std::string& place) {
    const json* const sphere = memberOf(shape, "sphere");
    const json* const capsule = memberOf(shape, "capsule");
    if (memberOf(shape, "plane") != nullptr) return std::nullopt;
    const json* const found = sphere != nullptr ? sphere : capsule;
    if (found == nullptr) refuseAt(place, "expected a sphere or a capsule, found neither");
    if (found->value("inside", false)) return std::nullopt;
    const Vector3d a = vectorIn(*found, "offset");
    return Lss{a, sphere != nullptr ? a : vectorIn(*found, "tail"), numberIn(*found, "radius")};
  }

  void addSprings(const json& springs) {
    for (const json& spring : listIn(springs, "springs")) {
      springJoints_ += sizeOf(spring, "joints");
    }
    const json& colliders = listIn(springs, "colliders");
    std::size_t outside = 0;
    for (std::size_t i = 0; i < colliders.size(); ++i) {
      std::string place = "extensions.VRMC_springBone." + placeIn("colliders", i);
      const json* const extended = extensionOf(colliders[i], kExtended);
      // The plain shape beside an extended one only stands in for it.
      if (extended != nullptr) place += std::string(".extensions.") + kExtended;
      const json& shape = (extended != nullptr ? *extended : colliders[i])["shape"];
      const auto lss = lssOf(shape, place + ".shape");
      if (lss) addCollider(colliders[i]["node"].get<std::size_t>(), place, *lss);
      outside += lss ? 0 : 1;
    }
    if (outside == 0) return;
    vrm_.notes.push_back(std::to_string(outside) + " colliders of " + kExtended +
                         " are planes or hold hair inside them: they are no part of a body and "
                         "are left out");
  }

  /// The offsets of VRM 0.x are in Unity's left-handed frame, of which the file's is the mirror
  /// image in z: UniVRM wrote them unconverted, and the schema says so since
  /// (vrm-specification, schema vrm.secondaryanimation.collidergroup; UniVRM #65).
  void addOldSprings(const json& springs) {
    for (const json& group : listIn(springs, "boneGroups")) springJoints_ += sizeOf(group, "bones");
    const json& groups = listIn(springs, "colliderGroups");
    for (std::size_t g = 0; g < groups.size(); ++g) {
      const json& colliders = listIn(groups[g], "colliders");
      const std::string place =
          "extensions.VRM.secondaryAnimation." + placeIn("colliderGroups", g) + ".";
      for (std::size_t i = 0; i < colliders.size(); ++i) {
        const json* const offset = memberOf(colliders[i], "offset");
        Vector3d a = Vector3d::Zero();
        if (offset != nullptr) {
          a = {numberIn(*offset, "x"), numberIn(*offset, "y"), -numberIn(*offset, "z")};
        }
        addCollider(groups[g]["node"].get<std::size_t>(), place + placeIn("colliders", i),
                    {a, a, numberIn(colliders[i], "radius")});
      }
    }
  }

  void noteSprings() {
    if (!vrm_.colliders.empty()) {
      double largest = 0.0;
      for (const NodeCollider& collider : vrm_.colliders) {
        largest = std::max(largest, collider.lss.radius);
      }
      vrm_.notes.push_back(std::to_string(vrm_.colliders.size()) +
                           " spheres and capsules of spring bones' colliders are LSS of the body, "
                           "beside those around its meshes, the largest of radius " +
                           inDigits(largest));
    }
    if (springJoints_ == 0) return;
    vrm_.notes.push_back("spring bones are not followed: " + std::to_string(springJoints_) +
                         " of hair or clothes keep their rest against what carries them");
  }

  void noteConstraints() {
    std::size_t count = 0;
    for (const json& node : listIn(document_, "nodes")) {
      count += extensionOf(node, kConstraint) != nullptr ? 1 : 0;
    }
    if (count == 0) return;
    vrm_.notes.push_back(std::string(kConstraint) + " is not followed: " + std::to_string(count) +
                         " nodes keep their rest against what carries them");
  }

  const json& document_;
  Vrm vrm_;
  std::set<std::string, std::less<>> bones_;
  std::size_t springJoints_ = 0;
};

}  // namespace

Vrm vrmIn(const json& document) {
  return VrmReader(document).read();
}

std::string nameIn(const Vrm& vrm, std::size_t node, const std::string& own) {
  const auto bone = vrm.boneOfNode.find(node);
  if (bone != vrm.boneOfNode.end()) return bone->second;
  const bool isTaken = !vrm.boneOfNode.empty() && isHumanBone(own);
  return isTaken ? own + "#2" : own;
}

}  // namespace foretouch::internal
