#include "assets/import/gltf_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <Eigen/Geometry>

#include "articulated/quoted.h"
#include "assets/import/failure.h"
#include "assets/import/gltf_compression.h"
#include "assets/import/gltf_json.h"
#include "assets/import/text.h"
#include "lss/index.h"
#include "middleware/scene/scene.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;
using nlohmann::json;

/// Those that are read, and those that say how surfaces look or are called, which are unused here.
/// What VRM adds of motion that is not followed gets its own notes (assets/import/gltf_vrm.h).
constexpr std::array<std::string_view, 20> kUnderstood{"KHR_mesh_quantization",
                                                       kMeshoptCompression,
                                                       kDracoCompression,
                                                       kInstancing,
                                                       "KHR_texture_transform",
                                                       "KHR_texture_basisu",
                                                       "EXT_texture_webp",
                                                       "EXT_texture_avif",
                                                       "MSFT_texture_dds",
                                                       "KHR_lights_punctual",
                                                       "EXT_lights_ies",
                                                       "KHR_xmp_json_ld",
                                                       "EXT_lights_image_based",
                                                       "VRM",
                                                       "VRMC_vrm",
                                                       "VRMC_springBone",
                                                       "VRMC_springBone_extended_collider",
                                                       "VRMC_node_constraint",
                                                       "KHR_implicit_shapes",
                                                       "KHR_physics_rigid_bodies"};

bool isUnderstood(std::string_view extension) {
  constexpr std::string_view kMaterials = "KHR_materials_", kOfVrm = "VRMC_materials_";
  return extension.substr(0, kMaterials.size()) == kMaterials ||
         extension.substr(0, kOfVrm.size()) == kOfVrm ||
         std::find(kUnderstood.begin(), kUnderstood.end(), extension) != kUnderstood.end();
}

template <int Size>
Eigen::Matrix<double, Size, 1> vectorIn(const json& node, const char* key,
                                        const Eigen::Matrix<double, Size, 1>& otherwise) {
  const json* const found = memberOf(node, key);
  if (found == nullptr) return otherwise;
  Eigen::Matrix<double, Size, 1> vector;
  for (Eigen::Index i = 0; i < Size; ++i) vector[i] = (*found)[slotOf(i)].get<double>();
  return vector;
}

/// `rotation` as the format has it: x, y, z, w.
Affine placedBy(const Vector3d& translation, const Eigen::Vector4d& rotation,
                const Vector3d& scale) {
  const double norm = rotation.stableNorm();
  const Quaternion q = norm > 0.0 ? Quaternion(Eigen::Vector4d(rotation / norm))
                                  : Quaternion(Quaternion::Identity());
  return {q.toRotationMatrix() * scale.asDiagonal(), translation};
}

Affine frameOfNode(const json& node) {
  if (const json* const matrix = memberOf(node, "matrix")) {
    Affine frame;
    for (Eigen::Index column = 0; column < 4; ++column) {
      for (Eigen::Index row = 0; row < 3; ++row) {
        const double number = (*matrix)[slotOf(4 * column + row)].get<double>();
        (column < 3 ? frame.linear(row, column) : frame.translation[row]) = number;
      }
    }
    return frame;
  }
  return placedBy(vectorIn<3>(node, "translation", Vector3d::Zero()),
                  vectorIn<4>(node, "rotation", Eigen::Vector4d::UnitW()),
                  vectorIn<3>(node, "scale", Vector3d::Ones()));
}

std::optional<std::size_t> indexIn(const json& node, const char* key) {
  const json* const found = memberOf(node, key);
  return found == nullptr ? std::nullopt : std::optional(found->get<std::size_t>());
}

/// Nothing else of a camera or a light is read, so they may be as they like.
bool isOnlooker(const json& node) {
  if (node.contains("camera")) return true;
  const json* const extensions = memberOf(node, "extensions");
  return extensions != nullptr && extensions->is_object() &&
         extensions->contains("KHR_lights_punctual");
}

/// "meshes[0].primitives[1].attributes.'POSITION'"
std::string attributeAt(const std::string& place, const std::string& name) {
  return place + ".attributes." + inQuotes(name);
}

constexpr std::uint64_t kTriangles = 4, kTriangleStrip = 5, kTriangleFan = 6;

/// Points and lines of so many corners.
std::uint64_t countOfLines(std::uint64_t mode, std::uint64_t corners) {
  constexpr std::uint64_t kLines = 1, kLineStrip = 3;
  if (mode == kLines) return corners / 2;
  return mode == kLineStrip && corners > 0 ? corners - 1 : corners;
}

/// The corners of triangle `i` among those of the primitive.
std::array<std::size_t, 3> cornersOf(std::uint64_t mode, std::size_t i) {
  if (mode == kTriangleStrip) return {i, i + 1 + i % 2, i + 2 - i % 2};
  if (mode == kTriangleFan) return {i + 1, i + 2, 0};
  return {3 * i, 3 * i + 1, 3 * i + 2};
}

void addTriangles(std::uint64_t mode, const std::vector<double>& corners, GltfPrimitive& out) {
  if (mode < kTriangles) {
    out.skippedPrimitives += countOfLines(mode, corners.size());
    return;
  }
  const std::size_t some = corners.size() < 3 ? 0 : corners.size() - 2;
  const std::size_t count = mode == kTriangles ? corners.size() / 3 : some;
  if (count > kMaxTriangles) {
    throw Failure{ImportFailure::TooLarge,
                  "a mesh of more than " + std::to_string(kMaxTriangles) + " triangles"};
  }
  out.triangles.reserve(count);
  const auto vertices = static_cast<double>(out.vertices.size());
  for (std::size_t i = 0; i < count; ++i) {
    CornerTriple triangle;
    bool isInRange = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const double corner = corners[cornersOf(mode, i)[k]];
      isInRange = isInRange && corner >= 0.0 && corner < vertices;
      triangle[k] = isInRange ? static_cast<std::uint32_t>(corner) : 0;
    }
    if (isInRange) {
      out.triangles.push_back(triangle);
    } else {
      ++out.skippedFaces;
    }
  }
}

std::vector<Vector3d> vectorsIn(const std::vector<double>& numbers) {
  std::vector<Vector3d> vectors;
  vectors.reserve(numbers.size() / 3);
  for (std::size_t i = 0; i + 2 < numbers.size(); i += 3) {
    vectors.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
  }
  return vectors;
}

/// 0, 1, 2 ...: a primitive without indices takes its vertices in order.
std::vector<double> inOrder(std::size_t count) {
  std::vector<double> corners(count);
  for (std::size_t i = 0; i < count; ++i) corners[i] = static_cast<double>(i);
  return corners;
}

}  // namespace

GltfScene::GltfScene(const std::string& path) : data_(openGltf(path)) {
  checkExtensions();
}

void GltfScene::note(const std::string& text) {
  if (std::find(notes_.begin(), notes_.end(), text) == notes_.end()) notes_.push_back(text);
}

void GltfScene::checkExtensions() {
  const auto inList = [&](const char* list, const auto& take) {
    const json* const names = memberOf(document(), list);
    if (names == nullptr) return;
    for (const json& name : *names) {
      const auto& text = name.get_ref<const std::string&>();
      if (!isUnderstood(text)) take(text);
    }
  };
  inList("extensionsRequired", [](const std::string& name) {
    refuseAt("extensionsRequired", "the file cannot be read without the extension " +
                                       inQuotes(name) + ", which is not understood");
  });
  inList("extensionsUsed", [&](const std::string& name) {
    note("the extension " + inQuotes(name) + " is not understood and passed over");
  });
}

GltfNode GltfScene::nodeAt(std::size_t index, std::int32_t parent) {
  const json& described = document()["nodes"][index];
  GltfNode node;
  node.index = index;
  node.parent = parent;
  const std::string place = placeIn("nodes", index);
  node.name = nameOf(described, place);
  node.toParent = frameOfNode(described);
  if (!node.toParent.linear.allFinite() || !node.toParent.translation.allFinite()) {
    refuse("the frame of node " + quotedName(node.name) + " is not finite");
  }
  node.mesh = indexIn(described, "mesh");
  node.skin = indexIn(described, "skin");
  node.isOnlooker = isOnlooker(described);
  return node;
}

std::vector<GltfNode> GltfScene::nodes(std::size_t limit) {
  const std::size_t scene = document().value("scene", std::size_t{0});
  if (scene >= sizeOf(document(), "scenes")) refuseAt("scenes", "expected a scene, found none");
  if (sizeOf(document(), "scenes") > 1) {
    note("of the file's " + std::to_string(sizeOf(document(), "scenes")) + " scenes only " +
         placeIn("scenes", scene) + " is read");
  }
  struct Pending {
    std::size_t index;
    std::int32_t parent;
  };
  std::vector<Pending> pending;
  const auto push = [&](const json* children, std::int32_t parent) {
    if (children == nullptr) return;
    for (std::size_t i = children->size(); i > 0; --i) {
      pending.push_back({(*children)[i - 1].get<std::size_t>(), parent});
    }
  };
  std::vector<GltfNode> visited;
  const json* const roots = memberOf(document()["scenes"][scene], "nodes");
  if (roots == nullptr || roots->size() != 1) {
    visited.emplace_back();
    visited.back().name = "ROOT";
  }
  push(roots, static_cast<std::int32_t>(visited.size()) - 1);
  std::vector<bool> isVisited(sizeOf(document(), "nodes"), false);
  while (!pending.empty()) {
    const Pending current = pending.back();
    pending.pop_back();
    if (visited.size() == limit) {
      throw Failure{ImportFailure::TooLarge, "more than " + std::to_string(limit) + " nodes"};
    }
    if (isVisited[current.index]) {
      refuseAt(placeIn("nodes", current.index), "expected one place in the scene, found several");
    }
    isVisited[current.index] = true;
    const auto position = static_cast<std::int32_t>(visited.size());
    visited.push_back(nodeAt(current.index, current.parent));
    push(memberOf(document()["nodes"][current.index], "children"), position);
  }
  return visited;
}

std::size_t GltfScene::numPrimitives() const {
  std::size_t count = 0;
  for (std::size_t i = 0; i < sizeOf(document(), "meshes"); ++i) {
    count += document()["meshes"][i]["primitives"].size();
  }
  return count;
}

const std::vector<GltfPrimitive>& GltfScene::primitivesOf(const GltfNode& node) {
  static const std::vector<GltfPrimitive> none;
  if (!node.mesh) return none;
  const json& mesh = document()["meshes"][*node.mesh];
  const json* const own = memberOf(document()["nodes"][*node.index], "weights");
  const auto key = std::make_pair(*node.mesh, own == nullptr ? std::nullopt : node.index);
  const auto found = meshes_.find(key);
  if (found != meshes_.end()) return found->second;
  std::vector<GltfPrimitive>& primitives = meshes_[key];
  const std::string place = placeIn("meshes", *node.mesh);
  const std::string name = nameOf(mesh, place);
  const json& parts = mesh["primitives"];
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const json* const weights = own != nullptr ? own : memberOf(mesh, "weights");
    primitives.push_back(read(parts[i], place + "." + placeIn("primitives", i), weights));
    primitives.back().name = parts.size() > 1 ? name + "-" + std::to_string(i) : name;
  }
  return primitives;
}

GltfPrimitive GltfScene::read(const json& primitive, const std::string& place,
                              const json* weights) {
  const json& attributes = primitive["attributes"];
  if (!attributes.contains("POSITION")) {
    refuseAt(place + ".attributes.POSITION", "expected this key, found none");
  }
  std::optional<DracoMesh> draco;
  const json* const compression = extensionOf(primitive, kDracoCompression);
  if (compression != nullptr) {
    draco.emplace(data_.bytesOfView((*compression)["bufferView"].get<std::size_t>()),
                  place + ".extensions." + kDracoCompression);
  }
  const auto numbersOf = [&](const std::string& name, std::string_view type) {
    const std::string user = attributeAt(place, name);
    const json* const compressed = draco ? memberOf((*compression)["attributes"], name) : nullptr;
    if (compressed == nullptr) return data_.numbers(attributes[name], type, user);
    const ElementLayout layout = data_.layoutOf(attributes[name], type, user);
    return GltfNumbers{layout.width(), draco->numbers(compressed->get<std::uint64_t>(), layout)};
  };
  GltfPrimitive out;
  out.vertices = vectorsIn(numbersOf("POSITION", "VEC3").values);
  addCorners(primitive, place, draco ? &*draco : nullptr, out);
  if (out.triangles.empty()) return out;
  for (int set = 0;; ++set) {
    const std::string joints = "JOINTS_" + std::to_string(set);
    const std::string shares = "WEIGHTS_" + std::to_string(set);
    if (!attributes.contains(joints) || !attributes.contains(shares)) break;
    out.influences.emplace_back(numbersOf(joints, "VEC4"), numbersOf(shares, "VEC4"));
    const auto& [joint, share] = out.influences.back();
    if (joint.count() != out.vertices.size() || share.count() != out.vertices.size()) {
      refuseAt(attributeAt(place, shares), "expected joints and weights of the " +
                                               std::to_string(out.vertices.size()) +
                                               " vertices, found " + std::to_string(joint.count()) +
                                               " and " + std::to_string(share.count()));
    }
  }
  morph(primitive, place, weights, out);
  return out;
}

void GltfScene::addCorners(const json& primitive, const std::string& place, const DracoMesh* draco,
                           GltfPrimitive& out) {
  const json* const indices = memberOf(primitive, "indices");
  std::vector<double> corners;
  if (draco != nullptr) {
    corners = draco->indices();
  } else if (indices != nullptr) {
    corners = data_.numbers(*indices, "SCALAR", place + ".indices").values;
  } else {
    corners = inOrder(out.vertices.size());
  }
  // Whatever the mode says, what Draco decodes is a list.
  const std::uint64_t mode = draco != nullptr ? kTriangles : primitive.value("mode", kTriangles);
  addTriangles(mode, corners, out);
  if (mode == kTriangles && corners.size() % 3 != 0) {
    note(place + " has " + std::to_string(corners.size()) +
         " corners, no multiple of 3: the last ones make no triangle");
  }
}

void GltfScene::morph(const json& primitive, const std::string& place, const json* weights,
                      GltfPrimitive& out) {
  const json* const targets = memberOf(primitive, "targets");
  if (targets == nullptr || targets->empty()) return;
  note("morph targets stand at their default weights");
  for (std::size_t i = 0; weights != nullptr && i < std::min(weights->size(), targets->size());
       ++i) {
    const json* const position = memberOf((*targets)[i], "POSITION");
    const double weight = (*weights)[i].get<double>();
    if (position == nullptr || weight == 0.0) continue;
    const std::string at = place + "." + placeIn("targets", i, "POSITION");
    const GltfNumbers moved = data_.numbers(*position, "VEC3", at);
    if (moved.count() != out.vertices.size()) {
      refuseAt(at, "expected as many elements as the " + std::to_string(out.vertices.size()) +
                       " vertices, found " + std::to_string(moved.count()));
    }
    for (std::size_t v = 0; v < out.vertices.size(); ++v) {
      out.vertices[v] += weight * Eigen::Map<const Vector3d>(moved.element(v));
    }
  }
}

std::vector<Affine> GltfScene::instancesOf(const GltfNode& node) {
  const json* const instancing =
      node.mesh ? extensionOf(document()["nodes"][*node.index], kInstancing) : nullptr;
  if (instancing == nullptr) return {Affine()};
  const std::string place = placeIn("nodes", *node.index, "extensions.") + kInstancing;
  if (node.skin) refuseAt(place, "expected no skin beside it, found one");
  const json& attributes = (*instancing)["attributes"];
  std::optional<std::size_t> count;
  const auto read = [&](const char* name, const char* type) {
    std::optional<GltfNumbers> numbers;
    const json* const accessor = memberOf(attributes, name);
    if (accessor == nullptr) return numbers;
    numbers = data_.numbers(*accessor, type, attributeAt(place, name));
    if (count && *count != numbers->count()) {
      refuseAt(attributeAt(place, name), "expected " + std::to_string(*count) +
                                             " elements as the others have, found " +
                                             std::to_string(numbers->count()));
    }
    count = numbers->count();
    return numbers;
  };
  const auto translations = read("TRANSLATION", "VEC3"), rotations = read("ROTATION", "VEC4"),
             scales = read("SCALE", "VEC3");
  if (!count)
    refuseAt(place + ".attributes", "expected TRANSLATION, ROTATION or SCALE, found none");
  std::vector<Affine> instances;
  using Map3 = Eigen::Map<const Vector3d>;
  using Map4 = Eigen::Map<const Eigen::Vector4d>;
  for (std::size_t i = 0; i < *count; ++i) {
    instances.push_back(placedBy(
        translations ? Vector3d(Map3(translations->element(i))) : Vector3d::Zero(),
        rotations ? Eigen::Vector4d(Map4(rotations->element(i))) : Eigen::Vector4d::UnitW(),
        scales ? Vector3d(Map3(scales->element(i))) : Vector3d::Ones()));
  }
  return instances;
}

}  // namespace foretouch::internal
