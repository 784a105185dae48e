#include "assets/import/model.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "assets/import/assimp.h"
#include "assets/import/fbx_pivots.h"
#include "assets/import/text.h"
#include "lss/index.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;

// assimp leaves 0 if a format states no rate; its own tools then use 25.
constexpr double kDefaultTicksPerSecond = 25.0;

bool isFinite(const Affine& affine) {
  return affine.linear.allFinite() && affine.translation.allFinite();
}

Vector3d vectorOf(const aiVector3D& v) {
  return {v.x, v.y, v.z};
}

/// Reads one file; a class as every part needs the file, the builder and the node numbers.
class AssimpModel {
 public:
  AssimpModel(const AssimpFile& file, ModelBuilder& builder)
      : scene_(*file.scene), unit_(file.frame.metresPerUnit), builder_(builder) {}

  void build() {
    addNodes();
    for (unsigned i = 0; i < scene_.mNumMeshes; ++i)
      cut_.push_back(trianglesOf(*scene_.mMeshes[i]));
    addMeshes();
    for (unsigned i = 0; i < scene_.mNumAnimations; ++i) addAnimation(*scene_.mAnimations[i]);
    countPivotsOnce(builder_.model);
    for (const std::string& name : nodesWithoutSomeCurve(builder_.model)) {
      builder_.note("the animation of " + quotedName(name) +
                    " has no curve for a part of its translation or rotation, which becomes 0");
    }
    for (const std::string& note : skippedNotes(skippedPrimitives_, skippedFaces_)) {
      builder_.note(note);
    }
  }

 private:
  /// Lengths are scaled, frames are not, so that nodes stay as the file turns them.
  [[nodiscard]] Affine inMetres(const aiMatrix4x4& matrix) const {
    Affine affine = transformOf(matrix);
    affine.translation *= unit_;
    return affine;
  }

  void addNodes() {
    visited_ = nodesOf(scene_, kMaxModelNodes);
    const std::set<std::string> onlookers = onlookerNames();
    for (const VisitedNode& visited : visited_) {
      ModelNode node;
      node.name = textOf(visited.node->mName);
      node.isOnlooker = onlookers.count(node.name) != 0;
      node.parent = visited.parent;
      node.toParent = inMetres(visited.node->mTransformation);
      if (!isFinite(node.toParent)) {
        throw Failure{ImportFailure::Refused,
                      "the frame of node " + quotedName(node.name) + " is not finite"};
      }
      ModelSize more;
      more.nodes = 1;
      more.nameBytes = node.name.size();
      builder_.count(more);
      const auto index = static_cast<std::int32_t>(builder_.model.nodes.size());
      addName(node.name, index, visited.node->mNumMeshes > 0);
      builder_.model.nodes.push_back(std::move(node));
    }
  }

  /// assimp says of a camera or a light which node has its name.
  [[nodiscard]] std::set<std::string> onlookerNames() const {
    std::set<std::string> names;
    for (unsigned i = 0; i < scene_.mNumCameras; ++i) {
      names.insert(textOf(scene_.mCameras[i]->mName));
    }
    for (unsigned i = 0; i < scene_.mNumLights; ++i) {
      names.insert(textOf(scene_.mLights[i]->mName));
    }
    return names;
  }

  void addName(const std::string& name, std::int32_t index, bool hasMesh) {
    const auto [entry, isNew] = nodesOfName_.emplace(name, NodeOfName{index, hasMesh, 1});
    if (isNew) return;
    NodeOfName& named = entry->second;
    ++named.count;
    if (named.hasMesh && !hasMesh) named = {index, false, named.count};
  }

  /// -1 if there is none. assimp refers to nodes by name alone; exporters name a mesh like the bone
  /// that it belongs to, so a node without a mesh is more likely.
  std::int32_t nodeNamed(const std::string& name, const char* what) {
    const auto found = nodesOfName_.find(name);
    if (found == nodesOfName_.end()) {
      builder_.note(std::string(what) + " names the node " + quotedName(name) +
                    ", which the file does not hold");
      return -1;
    }
    if (found->second.count > 1) {
      builder_.note("several nodes are named " + quotedName(name) +
                    ": bones and animations take the first without a mesh");
    }
    return found->second.index;
  }

  void addMeshes() {
    for (std::size_t i = 0; i < visited_.size(); ++i) {
      const aiNode& node = *visited_[i].node;
      for (unsigned k = 0; k < node.mNumMeshes; ++k) {
        checkMeshIndex(scene_, node.mMeshes[k]);
        addMesh(static_cast<std::int32_t>(i), node.mMeshes[k]);
      }
    }
  }

  void addMesh(std::int32_t node, unsigned index) {
    const aiMesh& from = *scene_.mMeshes[index];
    const MeshTriangles& cut = cut_[index];
    skippedPrimitives_ += cut.skippedPrimitives;
    skippedFaces_ += cut.skippedFaces;
    if (from.mNumAnimMeshes > 0) builder_.note("morph targets are not applied");
    if (cut.triangles.empty()) return;
    ModelSize more;
    more.meshes = 1;
    more.vertices = from.mNumVertices;
    more.triangles = cut.triangles.size();
    more.bones = from.mNumBones;
    more.nameBytes = from.mName.length;
    builder_.count(more);
    ModelMesh mesh;
    mesh.name = textOf(from.mName);
    mesh.node = node;
    mesh.vertices.reserve(from.mNumVertices);
    for (unsigned v = 0; v < from.mNumVertices; ++v) {
      mesh.vertices.push_back(vertexOf(from, v) * unit_);
    }
    mesh.triangles.reserve(cut.triangles.size());
    for (const CornerTriple& t : cut.triangles) {
      mesh.triangles.push_back({static_cast<std::int32_t>(t[0]), static_cast<std::int32_t>(t[1]),
                                static_cast<std::int32_t>(t[2])});
    }
    for (unsigned b = 0; b < from.mNumBones; ++b) addBone(*from.mBones[b], mesh);
    builder_.model.meshes.push_back(std::move(mesh));
  }

  void addBone(const aiBone& from, ModelMesh& mesh) {
    ModelBone bone;
    bone.name = textOf(from.mName);
    bone.node = nodeNamed(bone.name, "a bone");
    bone.meshToBone = inMetres(from.mOffsetMatrix);
    if (!isFinite(bone.meshToBone)) {
      throw Failure{ImportFailure::Refused,
                    "the bind frame of bone " + quotedName(bone.name) + " is not finite"};
    }
    ModelSize more;
    more.weights = from.mNumWeights;
    more.nameBytes = bone.name.size();
    builder_.count(more);
    for (unsigned w = 0; from.mWeights != nullptr && w < from.mNumWeights; ++w) {
      const aiVertexWeight& weight = from.mWeights[w];
      if (weight.mVertexId >= mesh.vertices.size()) {
        builder_.note("bone weights of vertices that their mesh does not hold are left out");
        continue;
      }
      bone.weights.push_back({static_cast<std::int32_t>(weight.mVertexId), weight.mWeight});
    }
    mesh.bones.push_back(std::move(bone));
  }

  void addAnimation(const aiAnimation& from) {
    ModelSize more;
    more.animations = 1;
    more.tracks = from.mNumChannels;
    more.nameBytes = from.mName.length;
    builder_.count(more);
    ModelAnimation animation;
    animation.name = textOf(from.mName);
    const bool stated = from.mTicksPerSecond > 0.0 && std::isfinite(from.mTicksPerSecond);
    if (!stated) builder_.note("an animation states no rate: read as 25 ticks per second");
    const double rate = stated ? from.mTicksPerSecond : kDefaultTicksPerSecond;
    const double durationS = from.mDuration / rate;
    animation.durationS = std::isfinite(durationS) ? durationS : 0.0;
    for (unsigned c = 0; c < from.mNumChannels; ++c) {
      addTrack(*from.mChannels[c], rate, animation);
    }
    if (from.mNumMeshChannels + from.mNumMorphMeshChannels > 0) {
      builder_.note("animations of vertices (morph targets) are left out");
    }
    builder_.model.animations.push_back(std::move(animation));
  }

  void addTrack(const aiNodeAnim& from, double rate, ModelAnimation& animation) {
    ModelTrack track;
    track.node = nodeNamed(textOf(from.mNodeName), "an animation track");
    if (track.node < 0) return;
    ModelSize more;
    more.keys = std::uint64_t{from.mNumPositionKeys} + from.mNumScalingKeys + from.mNumRotationKeys;
    builder_.count(more);
    for (unsigned k = 0; k < from.mNumPositionKeys; ++k) {
      const aiVectorKey& key = from.mPositionKeys[k];
      track.positions.push_back({key.mTime / rate, vectorOf(key.mValue) * unit_});
    }
    for (unsigned k = 0; k < from.mNumScalingKeys; ++k) {
      const aiVectorKey& key = from.mScalingKeys[k];
      track.scales.push_back({key.mTime / rate, vectorOf(key.mValue)});
    }
    for (unsigned k = 0; k < from.mNumRotationKeys; ++k) {
      const aiQuatKey& key = from.mRotationKeys[k];
      const aiQuaternion& q = key.mValue;
      track.rotations.push_back({key.mTime / rate, Quaternion(q.w, q.x, q.y, q.z)});
    }
    animation.tracks.push_back(std::move(track));
  }

  struct NodeOfName {
    std::int32_t index;
    bool hasMesh;
    int count;
  };

  const aiScene& scene_;
  double unit_;
  ModelBuilder& builder_;
  std::vector<VisitedNode> visited_;
  std::map<std::string, NodeOfName> nodesOfName_;  // the first without a mesh, else the first
  std::vector<MeshTriangles> cut_;
  std::uint64_t skippedPrimitives_ = 0, skippedFaces_ = 0;
};

}  // namespace

Model readModel(const ModelQuestion& question) {
  const AssimpFile file = readWithAssimp(question.path, Animations::Read);
  ModelBuilder builder;
  builder.model.frame = file.frame.frame;
  for (const std::string& note : file.notes) builder.note(note);
  AssimpModel(file, builder).build();
  return builder.take();
}

}  // namespace foretouch::internal
