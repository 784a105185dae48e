#include "assets/model/model_ownership.h"

#include <algorithm>
#include <cmath>

#include "lss/index.h"

namespace foretouch::internal {
namespace {

using Influences = std::vector<NodeInfluence>;

/// Sorted by node, one entry per node, weights summing to one. Scales by the largest first, because
/// sums of the file's values may overflow.
void normalise(Influences& influences) {
  double largest = 0.0;
  for (const NodeInfluence& i : influences) largest = std::max(largest, i.weight);
  for (NodeInfluence& i : influences) i.weight /= largest;
  std::stable_sort(influences.begin(), influences.end(),
                   [](const auto& a, const auto& b) { return a.node < b.node; });
  Influences merged;
  double sum = 0.0;
  for (const NodeInfluence& i : influences) {
    sum += i.weight;
    if (!merged.empty() && merged.back().node == i.node) {
      merged.back().weight += i.weight;
    } else {
      merged.push_back(i);
    }
  }
  for (NodeInfluence& i : merged) i.weight /= sum;
  merged.erase(std::remove_if(merged.begin(), merged.end(),
                              [](const NodeInfluence& i) { return !(i.weight > 0.0); }),
               merged.end());
  influences = std::move(merged);
}

/// Puts the usable weights of a mesh's bones into `influences`, counts the others.
void collectWeights(const ModelMesh& mesh, std::vector<Influences>& influences,
                    ModelOwnership& all) {
  for (const ModelBone& bone : mesh.bones) {
    if (bone.node < 0) {
      all.unknownBones.push_back(bone.name);
      all.unknownBoneWeights += bone.weights.size();
      continue;
    }
    for (const ModelBone::Weight& w : bone.weights) {
      const bool isVertex = w.vertex >= 0 && slotOf(w.vertex) < influences.size();
      if (!isVertex || !std::isfinite(w.weight) || w.weight < 0.0) {
        ++all.badWeights;
      } else if (w.weight > 0.0) {
        influences[slotOf(w.vertex)].push_back({bone.node, w.weight});
      }
    }
  }
}

/// The owner of a triangle, and how many nodes move it.
struct Owner {
  std::int32_t node = 0;
  std::size_t nodes = 0;
};

Owner ownerOf(const std::array<std::int32_t, 3>& triangle,
              const std::vector<Influences>& influences) {
  Influences sums;  // short: a vertex follows a few nodes
  for (const std::int32_t vertex : triangle) {
    for (const NodeInfluence& i : influences[slotOf(vertex)]) {
      const auto same = std::find_if(sums.begin(), sums.end(),
                                     [&](const NodeInfluence& s) { return s.node == i.node; });
      if (same == sums.end()) {
        sums.push_back(i);
      } else {
        same->weight += i.weight;
      }
    }
  }
  const auto best = std::max_element(sums.begin(), sums.end(), [](const auto& a, const auto& b) {
    return a.weight < b.weight || (a.weight == b.weight && a.node > b.node);
  });
  return {best->node, sums.size()};
}

MeshOwnership skinOwnership(const ModelMesh& mesh, ModelOwnership& all) {
  MeshOwnership result;
  result.influences.resize(mesh.vertices.size());
  collectWeights(mesh, result.influences, all);
  std::vector<bool> hasWeights;
  for (Influences& influences : result.influences) {
    hasWeights.push_back(!influences.empty());
    if (influences.empty()) influences.push_back({mesh.node, 1.0});
    normalise(influences);
  }
  for (const auto& triangle : mesh.triangles) {
    const Owner owner = ownerOf(triangle, result.influences);
    result.ownerOfTriangle.push_back(owner.node);
    const bool isLoose = std::any_of(triangle.begin(), triangle.end(),
                                     [&](std::int32_t v) { return !hasWeights[slotOf(v)]; });
    if (isLoose) all.carries[slotOf(mesh.node)] = true;
    if (isLoose && owner.node == mesh.node) ++all.unweighted;
    if (owner.nodes > 1) ++all.shared;
  }
  return result;
}

}  // namespace

ModelOwnership ownershipOf(const Model& model) {
  ModelOwnership all;
  all.carries.assign(model.nodes.size(), false);
  for (const ModelMesh& mesh : model.meshes) {
    if (mesh.bones.empty()) {
      all.meshes.push_back({{}, std::vector<std::int32_t>(mesh.triangles.size(), mesh.node)});
    } else {
      all.meshes.push_back(skinOwnership(mesh, all));
    }
    for (const std::int32_t node : all.meshes.back().ownerOfTriangle) {
      all.carries[slotOf(node)] = true;
    }
  }
  return all;
}

}  // namespace foretouch::internal
