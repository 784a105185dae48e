#include "assets/model/model_surface.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <utility>

#include "lss/index.h"
#include "lss/single.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;

/// In a GLB's precision; nothing if it is not finite or too far out.
std::optional<Vector3d> asFloat(const Vector3d& p) {
  if (!p.allFinite() || p.cwiseAbs().maxCoeff() > kMaxCoordinate) return std::nullopt;
  return nearestFloat(p);
}

/// Triangles as indices into Skin::vertices, per link.
using Corners = std::vector<std::array<std::int32_t, 3>>;

class SurfaceBuilder {
 public:
  SurfaceBuilder(const Model& model, const ModelLinks& links, const ModelOwnership& ownership)
      : model_(model), links_(links), ownership_(ownership), corners_(links.nodeOfLink.size()) {
    surface_.triangles.resize(links.nodeOfLink.size());
  }

  ModelSurface build() {
    for (std::size_t m = 0; m < model_.meshes.size(); ++m) addMesh(m);
    for (const Corners& corners : corners_) {
      surface_.skin.triangles.insert(surface_.skin.triangles.end(), corners.begin(), corners.end());
    }
    return std::move(surface_);
  }

 private:
  void addMesh(std::size_t m);
  void findPlacings(const ModelMesh& mesh);
  /// A vertex as a point of a node's link.
  [[nodiscard]] std::optional<Vector3d> placed(std::int32_t node, const Vector3d& vertex) {
    const auto [found, isNew] = placings_.try_emplace(node);
    if (isNew) found->second.linear = links_.shape[slotOf(links_.linkOfNode[slotOf(node)])];
    return asFloat(found->second * vertex);
  }
  std::int32_t skinVertex(std::size_t m, std::int32_t vertex);
  std::optional<std::vector<SkinInfluence>> influencesOf(std::size_t m, std::int32_t vertex);

  static constexpr std::int32_t kUnseen = -1, kNowhere = -2;

  const Model& model_;
  const ModelLinks& links_;
  const ModelOwnership& ownership_;
  ModelSurface surface_;
  std::vector<Corners> corners_;
  std::unordered_map<std::int32_t, Affine> placings_;  ///< This mesh's: node -> mesh to link.
  std::vector<std::int32_t> skinVertices_;             ///< Per vertex of this mesh.
};

/// For bones from bind time; if a bone is listed twice, the first counts.
void SurfaceBuilder::findPlacings(const ModelMesh& mesh) {
  placings_.clear();
  for (const ModelBone& bone : mesh.bones) {
    if (bone.node < 0) continue;
    const Affine shape{links_.shape[slotOf(links_.linkOfNode[slotOf(bone.node)])],
                       Vector3d::Zero()};
    placings_.try_emplace(bone.node, shape * bone.meshToBone);
  }
}

std::optional<std::vector<SkinInfluence>> SurfaceBuilder::influencesOf(std::size_t m,
                                                                       std::int32_t vertex) {
  const ModelMesh& mesh = model_.meshes[m];
  const MeshOwnership& owned = ownership_.meshes[m];
  const std::vector<NodeInfluence> rigid = {{mesh.node, 1.0}};
  const auto& nodes = mesh.bones.empty() ? rigid : owned.influences[slotOf(vertex)];
  std::vector<SkinInfluence> influences;
  for (const NodeInfluence& influence : nodes) {
    const LinkId link = links_.linkOfNode[slotOf(influence.node)];
    const auto p_L = placed(influence.node, mesh.vertices[slotOf(vertex)]);
    if (!p_L) return std::nullopt;
    influences.push_back({link, influence.weight, *p_L});
  }
  std::stable_sort(influences.begin(), influences.end(),
                   [](const auto& a, const auto& b) { return a.weight > b.weight; });
  return influences;
}

std::int32_t SurfaceBuilder::skinVertex(std::size_t m, std::int32_t vertex) {
  std::int32_t& known = skinVertices_[slotOf(vertex)];
  if (known != kUnseen) return known;
  auto influences = influencesOf(m, vertex);
  if (!influences) return known = kNowhere;
  known = static_cast<std::int32_t>(surface_.skin.vertices.size());
  surface_.skin.vertices.push_back(*std::move(influences));
  return known;
}

void SurfaceBuilder::addMesh(std::size_t m) {
  const ModelMesh& mesh = model_.meshes[m];
  findPlacings(mesh);
  skinVertices_.assign(mesh.vertices.size(), kUnseen);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::int32_t owner = ownership_.meshes[m].ownerOfTriangle[t];
    Triangle triangle;
    std::array<std::int32_t, 3> corners{};
    bool isPlaced = true;
    for (std::size_t k = 0; k < 3 && isPlaced; ++k) {
      const std::int32_t vertex = mesh.triangles[t][k];
      const auto p_L = placed(owner, mesh.vertices[slotOf(vertex)]);
      corners[k] = skinVertex(m, vertex);
      isPlaced = p_L.has_value() && corners[k] != kNowhere;
      if (isPlaced) triangle.vertices[k] = *p_L;
    }
    if (!isPlaced) {
      ++surface_.dropped;
      continue;
    }
    const LinkId link = links_.linkOfNode[slotOf(owner)];
    surface_.triangles[slotOf(link)].push_back(triangle);
    corners_[slotOf(link)].push_back(corners);
  }
}

}  // namespace

ModelSurface surfaceOf(const Model& model, const ModelLinks& links,
                       const ModelOwnership& ownership) {
  return SurfaceBuilder(model, links, ownership).build();
}

}  // namespace foretouch::internal
