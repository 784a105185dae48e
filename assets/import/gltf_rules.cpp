#include "assets/import/gltf_rules.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "articulated/quoted.h"
#include "assets/import/gltf_elements.h"
#include "assets/import/gltf_json.h"
#include "lss/index.h"

namespace foretouch::internal {
namespace {

using nlohmann::json;

enum class Kind : std::uint8_t {
  Object,
  List,
  Text,
  Count,  ///< A whole number, 0 or above.
  Number,
  Number3,  ///< A list of that many numbers.
  Number4,
  Number16,
  Numbers,  ///< A list of any number of them.
  Flag,
  Index,       ///< The number of an element of `target`, a list at the root.
  LocalIndex,  ///< The same, in a list of the current animation.
  Version,
  Mode,
  ComponentType,
  ElementType,
  Interpolation,
};

struct Rule {
  /// Keys from the root on; * matches every element of a list, or every value of an object.
  std::string_view path;
  Kind kind;
  bool isRequired = false;
  std::string_view target = {};
};

// What the reader depends on: colours, images and cameras may be as they like.
constexpr Rule kRules[] = {
    {"extensionsUsed", Kind::List},
    {"extensionsUsed/*", Kind::Text},
    {"extensionsRequired", Kind::List},
    {"extensionsRequired/*", Kind::Text},
    {"asset", Kind::Object, true},
    {"asset/version", Kind::Version, true},
    {"scenes", Kind::List},
    {"nodes", Kind::List},
    {"meshes", Kind::List},
    {"skins", Kind::List},
    {"animations", Kind::List},
    {"accessors", Kind::List},
    {"bufferViews", Kind::List},
    {"buffers", Kind::List},
    {"scene", Kind::Index, false, "scenes"},
    {"scenes/*", Kind::Object},
    {"scenes/*/nodes", Kind::List},
    {"scenes/*/nodes/*", Kind::Index, false, "nodes"},
    {"nodes/*", Kind::Object},
    {"nodes/*/children", Kind::List},
    {"nodes/*/children/*", Kind::Index, false, "nodes"},
    {"nodes/*/mesh", Kind::Index, false, "meshes"},
    {"nodes/*/skin", Kind::Index, false, "skins"},
    {"nodes/*/matrix", Kind::Number16},
    {"nodes/*/translation", Kind::Number3},
    {"nodes/*/rotation", Kind::Number4},
    {"nodes/*/scale", Kind::Number3},
    {"nodes/*/weights", Kind::Numbers},
    {"nodes/*/extensions/EXT_mesh_gpu_instancing", Kind::Object},
    {"nodes/*/extensions/EXT_mesh_gpu_instancing/attributes", Kind::Object, true},
    {"nodes/*/extensions/EXT_mesh_gpu_instancing/attributes/*", Kind::Index, false, "accessors"},
    {"meshes/*", Kind::Object},
    {"meshes/*/weights", Kind::Numbers},
    {"meshes/*/primitives", Kind::List, true},
    {"meshes/*/primitives/*", Kind::Object},
    {"meshes/*/primitives/*/attributes", Kind::Object, true},
    {"meshes/*/primitives/*/attributes/*", Kind::Index, false, "accessors"},
    {"meshes/*/primitives/*/indices", Kind::Index, false, "accessors"},
    {"meshes/*/primitives/*/mode", Kind::Mode},
    {"meshes/*/primitives/*/targets", Kind::List},
    {"meshes/*/primitives/*/targets/*", Kind::Object},
    {"meshes/*/primitives/*/targets/*/*", Kind::Index, false, "accessors"},
    {"meshes/*/primitives/*/extensions/KHR_draco_mesh_compression", Kind::Object},
    {"meshes/*/primitives/*/extensions/KHR_draco_mesh_compression/bufferView", Kind::Index, true,
     "bufferViews"},
    {"meshes/*/primitives/*/extensions/KHR_draco_mesh_compression/attributes", Kind::Object, true},
    {"meshes/*/primitives/*/extensions/KHR_draco_mesh_compression/attributes/*", Kind::Count},
    {"skins/*", Kind::Object},
    {"skins/*/joints", Kind::List, true},
    {"skins/*/joints/*", Kind::Index, false, "nodes"},
    {"skins/*/skeleton", Kind::Index, false, "nodes"},
    {"skins/*/inverseBindMatrices", Kind::Index, false, "accessors"},
    {"animations/*", Kind::Object},
    {"animations/*/samplers", Kind::List, true},
    {"animations/*/samplers/*", Kind::Object},
    {"animations/*/samplers/*/interpolation", Kind::Interpolation},
    {"animations/*/samplers/*/input", Kind::Index, true, "accessors"},
    {"animations/*/samplers/*/output", Kind::Index, true, "accessors"},
    {"animations/*/channels", Kind::List, true},
    {"animations/*/channels/*", Kind::Object},
    {"animations/*/channels/*/sampler", Kind::LocalIndex, true, "samplers"},
    {"animations/*/channels/*/target", Kind::Object, true},
    {"animations/*/channels/*/target/node", Kind::Index, false, "nodes"},
    {"animations/*/channels/*/target/path", Kind::Text, true},
    {"accessors/*", Kind::Object},
    {"accessors/*/bufferView", Kind::Index, false, "bufferViews"},
    {"accessors/*/byteOffset", Kind::Count},
    {"accessors/*/componentType", Kind::ComponentType, true},
    {"accessors/*/count", Kind::Count, true},
    {"accessors/*/type", Kind::ElementType, true},
    {"accessors/*/normalized", Kind::Flag},
    {"accessors/*/sparse", Kind::Object},
    {"accessors/*/sparse/count", Kind::Count, true},
    {"accessors/*/sparse/indices", Kind::Object, true},
    {"accessors/*/sparse/indices/bufferView", Kind::Index, true, "bufferViews"},
    {"accessors/*/sparse/indices/byteOffset", Kind::Count},
    {"accessors/*/sparse/indices/componentType", Kind::ComponentType, true},
    {"accessors/*/sparse/values", Kind::Object, true},
    {"accessors/*/sparse/values/bufferView", Kind::Index, true, "bufferViews"},
    {"accessors/*/sparse/values/byteOffset", Kind::Count},
    {"bufferViews/*", Kind::Object},
    {"bufferViews/*/buffer", Kind::Index, true, "buffers"},
    {"bufferViews/*/byteOffset", Kind::Count},
    {"bufferViews/*/byteLength", Kind::Count, true},
    {"bufferViews/*/byteStride", Kind::Count},
    {"bufferViews/*/extensions/EXT_meshopt_compression", Kind::Object},
    {"bufferViews/*/extensions/EXT_meshopt_compression/buffer", Kind::Index, true, "buffers"},
    {"bufferViews/*/extensions/EXT_meshopt_compression/byteOffset", Kind::Count},
    {"bufferViews/*/extensions/EXT_meshopt_compression/byteLength", Kind::Count, true},
    {"bufferViews/*/extensions/EXT_meshopt_compression/byteStride", Kind::Count, true},
    {"bufferViews/*/extensions/EXT_meshopt_compression/count", Kind::Count, true},
    {"bufferViews/*/extensions/EXT_meshopt_compression/mode", Kind::Text, true},
    {"bufferViews/*/extensions/EXT_meshopt_compression/filter", Kind::Text},
    {"buffers/*", Kind::Object},
    {"buffers/*/byteLength", Kind::Count, true},
    {"buffers/*/uri", Kind::Text},
    {"nodes/*/extensions/KHR_physics_rigid_bodies", Kind::Object},
    {"nodes/*/extensions/KHR_physics_rigid_bodies/collider", Kind::Object},
    {"nodes/*/extensions/KHR_physics_rigid_bodies/collider/geometry", Kind::Object},
    {"nodes/*/extensions/KHR_physics_rigid_bodies/collider/geometry/shape", Kind::Count},
    {"extensions/KHR_implicit_shapes", Kind::Object},
    {"extensions/KHR_implicit_shapes/shapes", Kind::List},
    {"extensions/KHR_implicit_shapes/shapes/*", Kind::Object},
    {"extensions/KHR_implicit_shapes/shapes/*/sphere", Kind::Object},
    {"extensions/KHR_implicit_shapes/shapes/*/sphere/radius", Kind::Number},
    {"extensions/KHR_implicit_shapes/shapes/*/capsule", Kind::Object},
    {"extensions/KHR_implicit_shapes/shapes/*/capsule/height", Kind::Number},
    {"extensions/KHR_implicit_shapes/shapes/*/capsule/radiusBottom", Kind::Number},
    {"extensions/KHR_implicit_shapes/shapes/*/capsule/radiusTop", Kind::Number},
    {"extensions/VRMC_vrm", Kind::Object},
    {"extensions/VRMC_vrm/humanoid", Kind::Object, true},
    {"extensions/VRMC_vrm/humanoid/humanBones", Kind::Object, true},
    {"extensions/VRMC_vrm/humanoid/humanBones/*", Kind::Object},
    {"extensions/VRMC_vrm/humanoid/humanBones/*/node", Kind::Index, true, "nodes"},
    {"extensions/VRMC_springBone", Kind::Object},
    {"extensions/VRMC_springBone/springs", Kind::List},
    {"extensions/VRMC_springBone/springs/*", Kind::Object},
    {"extensions/VRMC_springBone/springs/*/joints", Kind::List},
    {"extensions/VRMC_springBone/colliders", Kind::List},
    {"extensions/VRMC_springBone/colliders/*", Kind::Object},
    {"extensions/VRMC_springBone/colliders/*/node", Kind::Index, true, "nodes"},
    {"extensions/VRMC_springBone/colliders/*/shape", Kind::Object, true},
    {"extensions/VRMC_springBone/colliders/*/shape/*", Kind::Object},
    {"extensions/VRMC_springBone/colliders/*/shape/*/offset", Kind::Number3},
    {"extensions/VRMC_springBone/colliders/*/shape/*/tail", Kind::Number3},
    {"extensions/VRMC_springBone/colliders/*/shape/*/radius", Kind::Number},
    {"extensions/VRMC_springBone/colliders/*/extensions/VRMC_springBone_extended_collider",
     Kind::Object},
    {"extensions/VRMC_springBone/colliders/*/extensions/VRMC_springBone_extended_collider/shape",
     Kind::Object, true},
    {"extensions/VRMC_springBone/colliders/*/extensions/VRMC_springBone_extended_collider/shape/*",
     Kind::Object},
    {"extensions/VRMC_springBone/colliders/*/extensions/VRMC_springBone_extended_collider/shape/*/"
     "offset",
     Kind::Number3},
    {"extensions/VRMC_springBone/colliders/*/extensions/VRMC_springBone_extended_collider/shape/*/"
     "tail",
     Kind::Number3},
    {"extensions/VRMC_springBone/colliders/*/extensions/VRMC_springBone_extended_collider/shape/*/"
     "radius",
     Kind::Number},
    {"extensions/VRMC_springBone/colliders/*/extensions/VRMC_springBone_extended_collider/shape/*/"
     "inside",
     Kind::Flag},
    {"extensions/VRM", Kind::Object},
    {"extensions/VRM/humanoid", Kind::Object, true},
    {"extensions/VRM/humanoid/humanBones", Kind::List, true},
    {"extensions/VRM/humanoid/humanBones/*", Kind::Object},
    {"extensions/VRM/humanoid/humanBones/*/bone", Kind::Text, true},
    {"extensions/VRM/humanoid/humanBones/*/node", Kind::Index, true, "nodes"},
    {"extensions/VRM/secondaryAnimation", Kind::Object},
    {"extensions/VRM/secondaryAnimation/boneGroups", Kind::List},
    {"extensions/VRM/secondaryAnimation/boneGroups/*", Kind::Object},
    {"extensions/VRM/secondaryAnimation/boneGroups/*/bones", Kind::List},
    {"extensions/VRM/secondaryAnimation/colliderGroups", Kind::List},
    {"extensions/VRM/secondaryAnimation/colliderGroups/*", Kind::Object},
    {"extensions/VRM/secondaryAnimation/colliderGroups/*/node", Kind::Index, true, "nodes"},
    {"extensions/VRM/secondaryAnimation/colliderGroups/*/colliders", Kind::List},
    {"extensions/VRM/secondaryAnimation/colliderGroups/*/colliders/*", Kind::Object},
    {"extensions/VRM/secondaryAnimation/colliderGroups/*/colliders/*/offset", Kind::Object},
    {"extensions/VRM/secondaryAnimation/colliderGroups/*/colliders/*/offset/x", Kind::Number},
    {"extensions/VRM/secondaryAnimation/colliderGroups/*/colliders/*/offset/y", Kind::Number},
    {"extensions/VRM/secondaryAnimation/colliderGroups/*/colliders/*/offset/z", Kind::Number},
    {"extensions/VRM/secondaryAnimation/colliderGroups/*/colliders/*/radius", Kind::Number},
};

/// A value, or a missing one, with the path of keys that leads there.
struct Visited {
  std::string place;
  const json* value;      ///< Null if the key is missing.
  const json* animation;  ///< Around it, if there is one.
};

std::string keyed(const std::string& place, std::string_view key) {
  const bool isPlain = std::all_of(key.begin(), key.end(), [](unsigned char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  });
  const std::string shown = isPlain && key.size() <= 48 ? std::string(key) : inQuotes(key);
  return place.empty() ? shown : place + "." + shown;
}

/// Every value that `path` leads to from `at` on.
template <typename Take>
void visit(const Visited& at, std::string_view path, const Take& take) {
  const std::size_t slash = path.find('/');
  const std::string_view key = path.substr(0, slash);
  const bool isLast = slash == std::string_view::npos;
  const auto go = [&](const Visited& next) {
    if (isLast) {
      take(next);
    } else if (next.value != nullptr) {
      visit(next, path.substr(slash + 1), take);
    }
  };
  if (key == "*" && at.value->is_array()) {
    for (std::size_t i = 0; i < at.value->size(); ++i) {
      const json& element = (*at.value)[i];
      const bool isAnimation = at.place == "animations";
      go({at.place + "[" + std::to_string(i) + "]", &element,
          isAnimation ? &element : at.animation});
    }
  } else if (key == "*" && at.value->is_object()) {
    for (const auto& [name, element] : at.value->items()) {
      go({keyed(at.place, name), &element, at.animation});
    }
  } else if (key != "*" && at.value->is_object()) {
    const auto found = at.value->find(std::string(key));
    go({keyed(at.place, key), found == at.value->end() ? nullptr : &*found, at.animation});
  }
}

std::string shown(const json& value) {
  if (value.is_object()) return "an object";
  if (value.is_array()) return "a list of " + std::to_string(value.size());
  if (value.is_string()) return inQuotes(value.get_ref<const std::string&>());
  return value.dump();
}

constexpr char kComponentTypes[] = "one of 5120, 5121, 5122, 5123, 5125, 5126";
constexpr char kElementTypes[] = "one of SCALAR, VEC2, VEC3, VEC4, MAT2, MAT3, MAT4";
constexpr char kInterpolations[] = "one of LINEAR, STEP, CUBICSPLINE";

bool isVersion2(const json& value) {
  return value.is_string() && value.get_ref<const std::string&>().rfind("2.", 0) == 0;
}

bool isMode(const json& value) {
  return value.is_number_unsigned() && value.get<std::uint64_t>() <= 6;
}

bool isInterpolation(const json& value) {
  return value == "LINEAR" || value == "STEP" || value == "CUBICSPLINE";
}

bool isNumbers(const json& value) {
  return value.is_array() &&
         std::all_of(value.begin(), value.end(), [](const json& x) { return x.is_number(); });
}

bool isNumbers(const json& value, std::size_t count) {
  return isNumbers(value) && value.size() == count;
}

std::string numberOf(std::size_t size, std::string_view list) {
  return "the number of one of the " + std::to_string(size) + " " + std::string(list);
}

/// The expectation, if `value` does not meet it; else empty.
std::string unmet(const Rule& rule, const Visited& visited, const json& document) {
  const json& value = *visited.value;
  const auto unless = [](bool isMet, const std::string& text) { return isMet ? "" : text; };
  switch (rule.kind) {
    case Kind::Object: return unless(value.is_object(), "an object");
    case Kind::List: return unless(value.is_array(), "a list");
    case Kind::Text: return unless(value.is_string(), "a text");
    case Kind::Count: return unless(value.is_number_unsigned(), "a whole number, 0 or above");
    case Kind::Number: return unless(value.is_number(), "a number");
    case Kind::Number3: return unless(isNumbers(value, 3), "a list of 3 numbers");
    case Kind::Number4: return unless(isNumbers(value, 4), "a list of 4 numbers");
    case Kind::Number16: return unless(isNumbers(value, 16), "a list of 16 numbers");
    case Kind::ElementType: return unless(elementShape(value).rows > 0, kElementTypes);
    case Kind::Numbers: return unless(isNumbers(value), "a list of numbers");
    case Kind::Flag: return unless(value.is_boolean(), "true or false");
    case Kind::Interpolation: return unless(isInterpolation(value), kInterpolations);
    case Kind::Version: return unless(isVersion2(value), "the text 2.0");
    case Kind::Mode: return unless(isMode(value), "a whole number from 0 to 6");
    case Kind::ComponentType: return unless(componentBytes(value) > 0, kComponentTypes);
    case Kind::Index:
    case Kind::LocalIndex: break;
  }
  const json& holder = rule.kind == Kind::Index ? document : *visited.animation;
  const std::size_t size = sizeOf(holder, rule.target);
  const bool isIn = value.is_number_unsigned() && value.get<std::uint64_t>() < size;
  return unless(isIn, numberOf(size, rule.target));
}

void checkRule(const Rule& rule, const json& document, Faults& faults) {
  visit({"", &document, nullptr}, rule.path, [&](const Visited& visited) {
    if (faults.isFull()) return;
    if (visited.value == nullptr) {
      if (rule.isRequired) faults.add(visited.place, "expected this key, found none");
      return;
    }
    const std::string expected = unmet(rule, visited, document);
    if (!expected.empty()) {
      faults.add(visited.place, "expected " + expected + ", found " + shown(*visited.value));
    }
  });
}

/// Every node has at most one parent here: a walk upwards ends at a root or comes back.
void checkCircles(const std::vector<std::int64_t>& parent, Faults& faults) {
  std::vector<std::int64_t> walkOf(parent.size(), -1);
  for (std::size_t i = 0; i < parent.size(); ++i) {
    const auto walk = static_cast<std::int64_t>(i);
    std::int64_t at = walk;
    while (at >= 0 && walkOf[slotOf(at)] < 0) {
      walkOf[slotOf(at)] = walk;
      at = parent[slotOf(at)];
    }
    if (at < 0 || walkOf[slotOf(at)] != walk) continue;
    faults.add("nodes[" + std::to_string(at) + "]", "expected a tree, found its own ancestor");
    return;
  }
}

void checkTrees(const json& document, Faults& faults) {
  const auto nodes = document.find("nodes");
  if (nodes == document.end()) return;
  std::vector<std::int64_t> parent(nodes->size(), -1);
  for (std::size_t i = 0; i < nodes->size(); ++i) {
    const auto children = (*nodes)[i].find("children");
    if (children == (*nodes)[i].end()) continue;
    for (std::size_t k = 0; k < children->size(); ++k) {
      const auto child = (*children)[k].get<std::size_t>();
      if (parent[child] >= 0 || child == i) {
        faults.add("nodes[" + std::to_string(i) + "].children[" + std::to_string(k) + "]",
                   "expected a node that is no other's child, found " + std::to_string(child) +
                       (child == i ? ", itself"
                                   : ", a child of nodes[" + std::to_string(parent[child]) + "]"));
        return;
      }
      parent[child] = static_cast<std::int64_t>(i);
    }
  }
  checkCircles(parent, faults);
}

}  // namespace

void checkRules(const json& document, Faults& faults) {
  if (!document.is_object()) {
    faults.add("the JSON", "expected an object, found " + shown(document));
    return;
  }
  for (const Rule& rule : kRules) {
    if (faults.isFull()) return;
    checkRule(rule, document, faults);
  }
  if (faults.text().empty()) checkTrees(document, faults);
}

}  // namespace foretouch::internal
