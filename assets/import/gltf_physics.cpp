#include "assets/import/gltf_physics.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "articulated/skeleton.h"
#include "assets/import/failure.h"
#include "assets/import/gltf_json.h"
#include "assets/import/text.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;
using nlohmann::json;

constexpr char kShapes[] = "KHR_implicit_shapes", kBodies[] = "KHR_physics_rigid_bodies";

/// Nothing of a shape that is neither a sphere nor a capsule. Defaults are the draft's.
std::optional<Lss> lssOf(const json& shape) {
  if (const json* const sphere = memberOf(shape, "sphere")) {
    return Lss{Vector3d::Zero(), Vector3d::Zero(), sphere->value("radius", 0.5)};
  }
  const json* const capsule = memberOf(shape, "capsule");
  if (capsule == nullptr) return std::nullopt;
  const Vector3d half(0.0, 0.5 * capsule->value("height", 0.5), 0.0);
  return Lss{-half, half,
             std::max(capsule->value("radiusBottom", 0.25), capsule->value("radiusTop", 0.25))};
}

class ColliderReader {
 public:
  explicit ColliderReader(const json& document) : document_(document) {}

  GltfColliders read() {
    const std::size_t count = sizeOf(document_, "nodes");
    isMoved_.assign(count, false);
    findMoved();
    for (std::size_t node = 0; node < count; ++node) addOf(node);
    if (others_ > 0) {
      found_.notes.push_back(std::to_string(others_) + " colliders of " + kBodies +
                             " are neither spheres nor capsules and are left out");
    }
    return std::move(found_);
  }

 private:
  /// What animations move, and the bones of skins.
  void findMoved() {
    for (std::size_t i = 0; i < sizeOf(document_, "animations"); ++i) {
      for (const json& channel : document_["animations"][i]["channels"]) {
        const json* const node = memberOf(channel["target"], "node");
        if (node != nullptr) isMoved_[node->get<std::size_t>()] = true;
      }
    }
    for (std::size_t i = 0; i < sizeOf(document_, "skins"); ++i) {
      for (const json& joint : document_["skins"][i]["joints"]) {
        isMoved_[joint.get<std::size_t>()] = true;
      }
    }
  }

  [[nodiscard]] bool isAlone(std::size_t index, const json& node) const {
    return !isMoved_[index] && sizeOf(node, "children") == 0 && !node.contains("mesh") &&
           !node.contains("camera") && !extensionOf(node, kBodies)->contains("motion");
  }

  void addOf(std::size_t index) {
    const json& node = document_["nodes"][index];
    const json* const body = extensionOf(node, kBodies);
    const json* const collider = body == nullptr ? nullptr : memberOf(*body, "collider");
    const json* const geometry = collider == nullptr ? nullptr : memberOf(*collider, "geometry");
    if (geometry == nullptr) return;
    const std::string place = placeIn("nodes", index) + ".extensions." + kBodies + ".collider";
    const json* const number = memberOf(*geometry, "shape");
    const auto lss = number == nullptr ? std::nullopt : lssOf(shapeAt(*number, place));
    if (!lss) {
      ++others_;
      return;
    }
    found_.colliders.push_back(checkedCollider({index, place, *lss, isAlone(index, node)}));
  }

  [[nodiscard]] const json& shapeAt(const json& number, const std::string& place) const {
    const json* const shapes = extensionOf(document_, kShapes);
    const std::size_t count = shapes == nullptr ? 0 : sizeOf(*shapes, "shapes");
    const auto index = number.get<std::size_t>();
    if (index >= count) {
      refuseAt(place + ".geometry.shape", "expected one of the " + std::to_string(count) +
                                              " shapes of " + kShapes + ", found " +
                                              std::to_string(index));
    }
    return (*shapes)["shapes"][index];
  }

  const json& document_;
  GltfColliders found_;
  std::vector<bool> isMoved_;
  std::size_t others_ = 0;
};

}  // namespace

NodeCollider checkedCollider(NodeCollider collider) {
  const Lss& lss = collider.lss;
  const double farthest = std::max(lss.a.cwiseAbs().maxCoeff(), lss.b.cwiseAbs().maxCoeff());
  if (!(lss.radius >= 0.0 && std::max(farthest, lss.radius) <= kMaxCoordinate)) {
    refuseAt(collider.place,
             "expected a radius of at least 0, and numbers within 1e7, found a radius of " +
                 inDigits(lss.radius) + " and " + inDigits(farthest));
  }
  return collider;
}

GltfColliders gltfColliders(const json& document) {
  return ColliderReader(document).read();
}

}  // namespace foretouch::internal
