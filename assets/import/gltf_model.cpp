// A model from glTF: assets/import/model.h.
#include <utility>

#include <Eigen/SVD>

#include "articulated/quoted.h"
#include "assets/import/failure.h"
#include "assets/import/gltf_json.h"
#include "assets/import/gltf_physics.h"
#include "assets/import/gltf_scene.h"
#include "assets/import/gltf_vrm.h"
#include "assets/import/model.h"
#include "assets/import/text.h"
#include "lss/index.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;
using nlohmann::json;

/// Reads one file; a class as every part needs the file, the builder and the node numbers.
class GltfModel {
 public:
  GltfModel(const std::string& path, ModelBuilder& builder)
      : scene_(path), vrm_(vrmIn(scene_.document())), builder_(builder) {}

  void build() {
    addNodes();
    const GltfColliders physics = gltfColliders(scene_.document());
    addColliders(physics.colliders);
    for (const std::string& note : physics.notes) builder_.note(note);
    addColliders(vrm_.colliders);
    noteBonesOutside();
    for (std::size_t i = 0; i < nodes_.size(); ++i) addMeshes(static_cast<std::int32_t>(i));
    for (std::size_t i = 0; i < sizeOf(scene_.document(), "animations"); ++i) addAnimation(i);
    for (const std::string& note : vrm_.notes) builder_.note(note);
    for (const std::string& note : scene_.notes()) builder_.note(note);
    for (const std::string& note : skippedNotes(skippedPrimitives_, skippedFaces_)) {
      builder_.note(note);
    }
  }

 private:
  void addNodes() {
    nodes_ = scene_.nodes(kMaxModelNodes);
    positions_.assign(sizeOf(scene_.document(), "nodes"), -1);
    for (const GltfNode& from : nodes_) {
      ModelNode node;
      node.name = from.index ? nameIn(vrm_, *from.index, from.name) : from.name;
      node.parent = from.parent;
      node.toParent = from.toParent;
      node.isOnlooker = from.isOnlooker;
      node.fileNode = from.index ? static_cast<std::int32_t>(*from.index) : -1;
      ModelSize more;
      more.nodes = 1;
      more.nameBytes = node.name.size();
      builder_.count(more);
      if (from.index) {
        positions_[*from.index] = static_cast<std::int32_t>(builder_.model.nodes.size());
      }
      builder_.model.nodes.push_back(std::move(node));
    }
  }

  void addColliders(const std::vector<NodeCollider>& colliders) {
    for (const NodeCollider& collider : colliders) {
      const std::int32_t position = positions_[collider.node];
      if (position < 0) {
        builder_.note(collider.place + ": its node is not in the scene, so it is left out");
        continue;
      }
      const GltfNode& node = nodes_[slotOf(position)];
      if (collider.isAlone && node.parent >= 0) {
        builder_.addLss(node.parent, placed(node.toParent, collider.lss));
      } else {
        builder_.addLss(position, collider.lss);
      }
    }
  }

  /// An uneven scale makes one that holds the result.
  static Lss placed(const Affine& frame, const Lss& lss) {
    const Eigen::Matrix3d square = frame.linear.transpose() * frame.linear;
    const bool isRigid = (square - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() <= 1e-12;
    const double largest =
        isRigid ? 1.0 : Eigen::JacobiSVD<Eigen::Matrix3d>(frame.linear).singularValues()[0];
    return {frame * lss.a, frame * lss.b, largest * lss.radius};
  }

  void noteBonesOutside() {
    for (const auto& [node, bone] : vrm_.boneOfNode) {
      if (positions_[node] >= 0) continue;
      builder_.note("the bone " + inQuotes(bone) + " is a node that the scene does not hold");
    }
  }

  void addMeshes(std::int32_t position) {
    const GltfNode& node = nodes_[slotOf(position)];
    const auto& primitives = scene_.primitivesOf(node);
    for (const Affine& instance : scene_.instancesOf(node)) {
      for (const GltfPrimitive& primitive : primitives) {
        skippedPrimitives_ += primitive.skippedPrimitives;
        skippedFaces_ += primitive.skippedFaces;
        if (!primitive.triangles.empty()) addMesh(position, primitive, instance);
      }
    }
  }

  void addMesh(std::int32_t position, const GltfPrimitive& from, const Affine& instance) {
    std::vector<Vector3d> vertices = from.vertices;
    // Bit for bit, where there is nothing to move.
    if (!instance.linear.isIdentity(0.0) || !instance.translation.isZero(0.0)) {
      for (Vector3d& vertex : vertices) vertex = instance * vertex;
    }
    std::vector<std::array<std::int32_t, 3>> triangles;
    triangles.reserve(from.triangles.size());
    for (const CornerTriple& t : from.triangles) {
      triangles.push_back({static_cast<std::int32_t>(t[0]), static_cast<std::int32_t>(t[1]),
                           static_cast<std::int32_t>(t[2])});
    }
    builder_.addMesh(position, from.name, std::move(vertices), triangles);
    const GltfNode& node = nodes_[slotOf(position)];
    if (node.skin && !from.influences.empty()) addBones(*node.skin, from);
  }

  void addBones(std::size_t index, const GltfPrimitive& from) {
    ModelMesh& mesh = builder_.model.meshes.back();
    const json& joints = scene_.document()["skins"][index]["joints"];
    for (std::size_t j = 0; j < joints.size(); ++j) {
      mesh.bones.push_back(boneOf(index, j, joints[j].get<std::size_t>()));
    }
    for (const auto& [bones, weights] : from.influences) {
      for (std::size_t v = 0; v < from.vertices.size(); ++v) {
        for (std::size_t k = 0; k < bones.width; ++k) {
          addWeight(mesh, bones.element(v)[k], static_cast<std::int32_t>(v), weights.element(v)[k]);
        }
      }
    }
    ModelSize more;
    for (const ModelBone& bone : mesh.bones) more.weights += bone.weights.size();
    builder_.count(more);
  }

  void addWeight(ModelMesh& mesh, double joint, std::int32_t vertex, double weight) {
    if (weight == 0.0) return;  // four places per vertex, used or not
    if (!(joint >= 0.0 && joint < static_cast<double>(mesh.bones.size()))) {
      builder_.note("bone weights of joints that their skin does not hold are left out");
      return;
    }
    mesh.bones[static_cast<std::size_t>(joint)].weights.push_back({vertex, weight});
  }

  ModelBone boneOf(std::size_t skin, std::size_t joint, std::size_t node) {
    ModelBone bone;
    bone.name = nameOf(scene_.document()["nodes"][node], placeIn("nodes", node));
    bone.node = positions_[node];
    if (bone.node < 0) {
      builder_.note("a bone is the node " + quotedName(bone.name) +
                    ", which the scene does not hold");
    }
    bone.meshToBone = bindFrame(skin, joint);
    if (!bone.meshToBone.linear.allFinite() || !bone.meshToBone.translation.allFinite()) {
      refuse("the bind frame of bone " + quotedName(bone.name) + " is not finite");
    }
    ModelSize more;
    more.bones = 1;
    more.nameBytes = bone.name.size();
    builder_.count(more);
    return bone;
  }

  /// Identities where the file leaves them out.
  Affine bindFrame(std::size_t skin, std::size_t joint) {
    const json& described = scene_.document()["skins"][skin];
    const json* const accessor = memberOf(described, "inverseBindMatrices");
    if (accessor == nullptr) return {};
    const std::string place = placeIn("skins", skin, "inverseBindMatrices");
    auto found = bindMatrices_.find(skin);
    if (found == bindMatrices_.end()) {
      found = bindMatrices_.emplace(skin, scene_.data().numbers(*accessor, "MAT4", place)).first;
    }
    const GltfNumbers& matrices = found->second;
    if (joint >= matrices.count()) {
      refuseAt(place, "expected a matrix for each of the " +
                          std::to_string(described["joints"].size()) + " joints, found " +
                          std::to_string(matrices.count()));
    }
    const Eigen::Map<const Eigen::Matrix4d> matrix(matrices.element(joint));
    return {matrix.topLeftCorner<3, 3>(), matrix.topRightCorner<3, 1>()};
  }

  void addAnimation(std::size_t index) {
    ModelAnimation animation;
    const json& from = scene_.document()["animations"][index];
    const std::string place = placeIn("animations", index);
    animation.name = nameOf(from, place);
    std::map<std::int32_t, std::size_t> trackOf;  // by node
    const json& channels = from["channels"];
    for (std::size_t c = 0; c < channels.size(); ++c) {
      const json& target = channels[c]["target"];
      const json* const node = memberOf(target, "node");
      const auto& path = target["path"].get_ref<const std::string&>();
      if (!isOfNodes(path)) continue;
      if (node == nullptr) continue;  // the format's way to leave a channel out
      const std::int32_t position = positions_[node->get<std::size_t>()];
      if (position < 0) {
        builder_.note("animations of nodes that the scene does not hold are left out");
        continue;
      }
      const auto [entry, isNew] = trackOf.emplace(position, animation.tracks.size());
      if (isNew) {
        animation.tracks.emplace_back();
        animation.tracks.back().node = position;
      }
      const auto sampler = channels[c]["sampler"].get<std::size_t>();
      addKeys(from["samplers"][sampler], place + "." + placeIn("samplers", sampler), path,
              animation.tracks[entry->second]);
    }
    ModelSize more;
    more.animations = 1;
    more.tracks = animation.tracks.size();
    more.nameBytes = animation.name.size();
    builder_.count(more);
    for (const ModelTrack& track : animation.tracks) {
      for (const auto& key : track.positions) endAt(animation, key.timeS);
      for (const auto& key : track.scales) endAt(animation, key.timeS);
      for (const auto& key : track.rotations) endAt(animation, key.timeS);
    }
    builder_.model.animations.push_back(std::move(animation));
  }

  bool isOfNodes(const std::string& path) {
    if (path == "translation" || path == "rotation" || path == "scale") return true;
    builder_.note(path == "weights" ? "animations of vertices (morph targets) are left out"
                                    : "animations of " + inQuotes(path) + " are left out");
    return false;
  }

  static void endAt(ModelAnimation& animation, double timeS) {
    if (timeS > animation.durationS && std::isfinite(timeS)) animation.durationS = timeS;
  }

  void addKeys(const json& sampler, const std::string& place, const std::string& path,
               ModelTrack& track) {
    const bool turns = path == "rotation";
    const GltfNumbers times = scene_.data().numbers(sampler["input"], "SCALAR", place + ".input");
    const GltfNumbers values =
        scene_.data().numbers(sampler["output"], turns ? "VEC4" : "VEC3", place + ".output");
    const std::string way = sampler.value("interpolation", std::string("LINEAR"));
    const std::size_t perKey = way == "CUBICSPLINE" ? 3 : 1;
    if (values.count() != perKey * times.count()) {
      refuseAt(place + ".output", "expected " + std::to_string(perKey * times.count()) +
                                      " elements for the " + std::to_string(times.count()) +
                                      " keys of its input, found " +
                                      std::to_string(values.count()));
    }
    ModelSize more;
    more.keys = (way == "STEP" ? 2 : 1) * times.count();
    builder_.count(more);
    if (turns) {
      track.rotations = keysOf<ModelTrack::RotationKey>(times, values, way);
      track.rotationTangents = tangentsOf<Eigen::Vector4d>(values, way);
    } else if (path == "translation") {
      track.positions = keysOf<ModelTrack::VectorKey>(times, values, way);
      track.positionTangents = tangentsOf<Vector3d>(values, way);
    } else {
      track.scales = keysOf<ModelTrack::VectorKey>(times, values, way);
    }
  }

  static void put(const double* from, Vector3d& value) { value = {from[0], from[1], from[2]}; }
  static void put(const double* from, Eigen::Vector4d& value) {
    value = {from[0], from[1], from[2], from[3]};
  }
  static void put(const double* from, Quaternion& value) {
    value = Quaternion(from[3], from[0], from[1], from[2]);
  }

  /// What holds a value until the next key does so in two keys: one at each end of that time.
  template <typename Key>
  static std::vector<Key> keysOf(const GltfNumbers& times, const GltfNumbers& values,
                                 const std::string& way) {
    std::vector<Key> keys;
    const bool isCubic = way == "CUBICSPLINE";
    for (std::size_t i = 0; i < times.count(); ++i) {
      Key key;
      key.timeS = times.values[i];
      if (way == "STEP" && !keys.empty()) {
        key.value = keys.back().value;
        keys.push_back(key);
      }
      put(values.element(isCubic ? 3 * i + 1 : i), key.value);
      keys.push_back(key);
    }
    return keys;
  }

  template <typename Value>
  static std::vector<ModelTrack::Tangents<Value>> tangentsOf(const GltfNumbers& values,
                                                             const std::string& way) {
    std::vector<ModelTrack::Tangents<Value>> tangents;
    for (std::size_t i = 0; way == "CUBICSPLINE" && 3 * i < values.count(); ++i) {
      tangents.emplace_back();
      put(values.element(3 * i), tangents.back().in);
      put(values.element(3 * i + 2), tangents.back().out);
    }
    return tangents;
  }

  GltfScene scene_;
  Vrm vrm_;
  ModelBuilder& builder_;
  std::vector<GltfNode> nodes_;
  std::vector<std::int32_t> positions_;  // of the file's nodes in the walk; -1: not in the scene
  std::map<std::size_t, GltfNumbers> bindMatrices_;
  std::uint64_t skippedPrimitives_ = 0, skippedFaces_ = 0;
};

}  // namespace

Model readGltf(const ModelQuestion& question) {
  ModelBuilder builder;
  builder.model.frame = gltfFrame();
  GltfModel(question.path, builder).build();
  return builder.take();
}

}  // namespace foretouch::internal
