#include "assets/import/fbx_pivots.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <string_view>

#include "lss/index.h"

namespace foretouch::internal {
namespace {

constexpr std::string_view kTag = "_$AssimpFbx$_";

/// What a track of the node itself has to know of the chain that was folded.
struct Chain {
  Eigen::Matrix3d unpost = Eigen::Matrix3d::Identity();  ///< The inverse post-rotation.
  Eigen::Vector3d scaleSigns = Eigen::Vector3d::Ones();  ///< Those of the scale at rest.
  bool hasPost = false;
};

/// The part of the chain of `of` that `name` is; empty if it is none.
std::string_view partOf(std::string_view name, std::string_view of) {
  const std::size_t tagged = of.size() + kTag.size();
  if (name.size() <= tagged || name.substr(0, of.size()) != of) return {};
  return name.substr(of.size(), kTag.size()) == kTag ? name.substr(tagged) : std::string_view();
}

/// Moves the chain above `index` into the node: its nodes stay, without a frame of their own.
Chain foldInto(Model& model, std::int32_t index) {
  ModelNode& node = model.nodes[slotOf(index)];
  Chain chain;
  for (std::int32_t at = node.parent; at >= 0; at = model.nodes[slotOf(at)].parent) {
    ModelNode& above = model.nodes[slotOf(at)];
    const std::string_view part = partOf(above.name, node.name);
    if (part.empty()) break;
    if (part == "PostRotation") {
      chain.unpost = above.toParent.linear;
      chain.hasPost = true;
    }
    if (part == "Scaling") chain.scaleSigns = above.toParent.linear.diagonal().cwiseSign();
    node.toParent = above.toParent * node.toParent;
    above.toParent = Affine();
  }
  return chain;
}

/// The keys hold Rpre * R * Rpost, decomposed from a product with the scale: a scale with a
/// mirrored axis comes back with all three negative and the rotation turned to match.
void correctPost(const Chain& chain, ModelTrack& track) {
  const Eigen::Matrix3d unpostTwice = chain.unpost * chain.unpost;
  const bool mirrors = chain.scaleSigns.prod() < 0.0;
  const Eigen::Matrix3d signs = (mirrors ? Eigen::Vector3d(-chain.scaleSigns) : chain.scaleSigns)
                                    .asDiagonal()
                                    .toDenseMatrix();
  const Quaternion after(Eigen::Matrix3d(signs * unpostTwice * signs));
  for (auto& key : track.rotations) key.value = key.value * after;
}

/// Is a component 0 in all keys, but not at rest? For rotations, a component of the axis.
template <typename Keys, typename Vector>
bool lacksComponent(const Keys& keys, const Vector& valueOf, const Eigen::Vector3d& rest) {
  constexpr double kSome = 1e-4;  // above what a turn about another axis leaves in single precision
  for (Eigen::Index i = 0; i < 3; ++i) {
    const bool isNothing = std::all_of(keys.begin(), keys.end(),
                                       [&](const auto& key) { return valueOf(key)[i] == 0.0; });
    if (isNothing && std::abs(rest[i]) > kSome) return true;
  }
  return false;
}

}  // namespace

std::vector<std::string> nodesWithoutSomeCurve(const Model& model) {
  std::vector<std::string> names;
  for (const ModelAnimation& animation : model.animations) {
    for (const ModelTrack& track : animation.tracks) {
      const ModelNode& node = model.nodes[slotOf(track.node)];
      const std::size_t tag = node.name.find(kTag);
      if (tag == std::string::npos) continue;
      const std::string part = node.name.substr(tag + kTag.size());
      const Eigen::Vector3d turn = Quaternion(node.toParent.linear).vec();
      const bool lacks =
          (part == "Translation" && lacksComponent(
                                        track.positions, [](const auto& key) { return key.value; },
                                        node.toParent.translation)) ||
          (part == "Rotation" &&
           lacksComponent(
               track.rotations, [](const auto& key) -> Eigen::Vector3d { return key.value.vec(); },
               turn));
      if (lacks) names.push_back(node.name.substr(0, tag));
    }
  }
  return names;
}

void countPivotsOnce(Model& model) {
  std::map<std::int32_t, Chain> folded;
  for (ModelAnimation& animation : model.animations) {
    for (ModelTrack& track : animation.tracks) {
      auto found = folded.find(track.node);
      if (found == folded.end()) {
        found = folded.emplace(track.node, foldInto(model, track.node)).first;
      }
      if (found->second.hasPost) correctPost(found->second, track);
    }
  }
}

}  // namespace foretouch::internal
