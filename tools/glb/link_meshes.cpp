#include <map>

#include <fmt/format.h>

#include "assets/mesh/link_mesh.h"
#include "lss/index.h"
#include "tools/glb/replay_scene.h"

namespace foretouch::tools {
namespace {

constexpr GlbMaterial kSolid{"LSS", {0.16, 0.36, 0.70, 1.0}};
constexpr GlbMaterial kVeil{"LSS around a mesh", {0.16, 0.36, 0.70, 0.25}};
constexpr GlbMaterial kGhost{"tracked", {0.85, 0.55, 0.10, 0.30}};
constexpr GlbMaterial kMesh{"mesh of a link", {0.55, 0.58, 0.62, 1.0}};

/// The materials of the document, each added on first use.
class Materials {
 public:
  explicit Materials(GlbContent& content) : content_(content) {}
  std::size_t operator[](const GlbMaterial& material) {
    const auto found = known_.find(material.name);
    if (found != known_.end()) return found->second;
    return known_[material.name] = content_.addMaterial(material);
  }

 private:
  GlbContent& content_;
  std::map<std::string, std::size_t> known_;
};

/// The triangles of links that have a mesh; without a surface in the inputs, from its file.
std::vector<std::vector<Triangle>> trianglesOfLinks(const ReplayInputs& inputs,
                                                    std::vector<std::string>& notes) {
  const Avatar& avatar = inputs.avatar;
  if (inputs.query.surface) {
    std::vector<std::vector<Triangle>> triangles;
    for (LinkId link = 0; link < avatar.numLinks(); ++link) {
      triangles.push_back(inputs.query.surface->triangles(link));
    }
    return triangles;
  }
  auto loaded = loadLinkMeshes(avatar, inputs.request.avatarPath);
  if (loaded.ok()) return std::move(loaded).value();
  notes.push_back("the meshes of links are left out: " + describe(loaded.error()));
  return std::vector<std::vector<Triangle>>(countOf(avatar.numLinks()));
}

}  // namespace

std::vector<std::size_t> addLinkMeshes(const Stage& stage, GlbContent& content,
                                       TriangleBudget& budget, std::vector<std::string>& notes) {
  const Avatar& avatar = stage.inputs.avatar;
  const auto triangles = trianglesOfLinks(stage.inputs, notes);
  Materials materials(content);
  std::size_t lssLeftOut = 0, meshesLeftOut = 0;
  std::vector<std::size_t> meshes;
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    std::vector<MeshPart> parts;
    const auto& surface = triangles[slotOf(link)];
    const bool hasMesh = !surface.empty() && budget.take(surface.size());
    meshesLeftOut += !surface.empty() && !hasMesh ? 1 : 0;
    if (hasMesh) parts.push_back({meshOf(surface), materials[kMesh]});
    GlbMesh volume;
    for (const Lss& lss : avatar.lss(link)) {
      const bool fits = budget.take(trianglesOfLss());
      if (fits) appendLss(lss, volume);
      lssLeftOut += fits ? 0 : 1;
    }
    if (volume.triangles() > 0)
      parts.push_back({std::move(volume), materials[hasMesh ? kVeil : kSolid]});
    meshes.push_back(parts.empty() ? kNoMesh
                                   : content.addMesh(avatar.skeleton().name(link), parts));
  }
  if (lssLeftOut + meshesLeftOut > 0) {
    notes.push_back(
        fmt::format("{} LSS and the meshes of {} links are left out", lssLeftOut, meshesLeftOut));
  }
  if (stage.inputs.query.fidelity == Fidelity::Skinned) {
    notes.emplace_back("the skin is not shown, but the LSS and meshes of links");
  }
  return meshes;
}

std::vector<std::size_t> addLssMeshes(const Avatar& avatar, const std::string& prefix,
                                      std::size_t material, GlbContent& content,
                                      TriangleBudget& budget, std::size_t& leftOut) {
  std::vector<std::size_t> meshes;
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    GlbMesh volume;
    for (const Lss& lss : avatar.lss(link)) {
      const bool fits = budget.take(trianglesOfLss());
      if (fits) appendLss(lss, volume);
      leftOut += fits ? 0 : 1;
    }
    meshes.push_back(volume.triangles() == 0
                         ? kNoMesh
                         : content.addMesh(prefix + avatar.skeleton().name(link),
                                           {{std::move(volume), material}}));
  }
  return meshes;
}

std::vector<std::size_t> addGhostMeshes(const Stage& stage, GlbContent& content,
                                        TriangleBudget& budget, std::vector<std::string>& notes) {
  std::size_t leftOut = 0;
  auto meshes = addLssMeshes(stage.inputs.avatar, "tracked ", content.addMaterial(kGhost), content,
                             budget, leftOut);
  if (leftOut > 0) notes.push_back(fmt::format("{} LSS of the tracked body are left out", leftOut));
  return meshes;
}

}  // namespace foretouch::tools
