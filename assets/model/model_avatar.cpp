#include "assets/model/model_avatar.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <Eigen/SVD>

#include "articulated/try.h"
#include "assets/model/model_links.h"
#include "assets/model/model_ownership.h"
#include "assets/model/model_surface.h"
#include "lss/index.h"
#include "lss/lss_cover.h"

namespace foretouch {
namespace {

using internal::ModelLinks;

/// Distance from the identity: the rounding of a chain of frames without scale stays below it, and
/// such frames leave the file's values unchanged.
constexpr double kNoScale = 1e-9;

/// The node's own LSS in the link's frame. An uneven scale does not turn an LSS into an LSS: the
/// largest scale makes one that contains it.
std::vector<Lss> statedLss(const ModelNode& node, const Eigen::Matrix3d& shape) {
  if ((shape - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() <= kNoScale) return node.lss;
  const double largest = Eigen::JacobiSVD<Eigen::Matrix3d>(shape).singularValues()[0];
  std::vector<Lss> lss;
  for (const Lss& stated : node.lss) {
    lss.push_back({shape * stated.a, shape * stated.b, largest * stated.radius});
  }
  return lss;
}

void noteWeights(const internal::ModelOwnership& ownership, std::vector<std::string>& notes) {
  if (ownership.unknownBones.empty()) return;
  notes.push_back(std::to_string(ownership.unknownBoneWeights) +
                  " weights belong to bones that the file does not hold and are left out: " +
                  internal::listed(ownership.unknownBones));
}

std::vector<std::string> bonesWithoutTriangles(const Model& model, const ModelLinks& links,
                                               const internal::ModelSurface& surface) {
  std::vector<bool> isBone(model.nodes.size(), false);
  for (const ModelMesh& mesh : model.meshes) {
    for (const ModelBone& bone : mesh.bones) {
      if (bone.node >= 0) isBone[slotOf(bone.node)] = true;
    }
  }
  std::vector<std::string> names;
  for (std::size_t link = 0; link < surface.triangles.size(); ++link) {
    if (surface.triangles[link].empty() && isBone[slotOf(links.nodeOfLink[link])]) {
      names.push_back(links.skeleton.name(static_cast<LinkId>(link)));
    }
  }
  return names;
}

ModelAvatarReport reportOn(const Model& model, const ModelLinks& links,
                           const internal::ModelOwnership& ownership,
                           const internal::ModelSurface& surface) {
  ModelAvatarReport report;
  for (const auto& triangles : surface.triangles) report.triangles += triangles.size();
  report.droppedNonFinite = surface.dropped;
  report.unweighted = ownership.unweighted;
  report.badWeights = ownership.badWeights;
  report.shared = ownership.shared;
  report.bonesWithoutTriangles = bonesWithoutTriangles(model, links, surface);
  report.notes = links.notes;
  noteWeights(ownership, report.notes);
  return report;
}

Result<Done> checkOptions(const ModelAvatarOptions& options) {
  const bool isCount =
      options.maxLssPerLink >= 1 && slotOf(options.maxLssPerLink) <= kMaxLssPerLink;
  if (isCount) return Done{};
  return Error::of(ErrorCode::OutOfRange, "expected 1 to " + std::to_string(kMaxLssPerLink) +
                                              " LSS per link, found " +
                                              std::to_string(options.maxLssPerLink));
}

}  // namespace

Result<ModelAvatar> avatarFromModel(const Model& model, const ModelAvatarOptions& options) {
  for (const auto& checked : {checkOptions(options), internal::checkModel(model)}) {
    if (!checked.ok()) return checked.error();
  }
  const internal::ModelOwnership ownership = internal::ownershipOf(model);
  FORETOUCH_TRY(auto links, internal::modelLinks(model, ownership));
  internal::ModelSurface surface = internal::surfaceOf(model, links, ownership);
  ModelAvatarReport report = reportOn(model, links, ownership, surface);

  std::vector<std::vector<Lss>> lss;
  std::vector<MeshReference> meshes;
  bool any = false;
  for (std::size_t link = 0; link < surface.triangles.size(); ++link) {
    const auto& triangles = surface.triangles[link];
    const std::vector<Lss> fitted = coverTriangles(triangles, options.maxLssPerLink);
    const CoverMeasure measure = measureCover(fitted, triangles);
    report.hullVolume += measure.hullVolume;
    report.excessVolume += std::max(0.0, measure.lssVolume - measure.hullVolume);
    lss.push_back(statedLss(model.nodes[slotOf(links.nodeOfLink[link])], links.shape[link]));
    lss.back().insert(lss.back().end(), fitted.begin(), fitted.end());
    any = any || !lss.back().empty();
    const bool isReferred = !options.meshFile.empty() && !triangles.empty();
    meshes.push_back(
        isReferred ? MeshReference{options.meshFile, links.skeleton.name(static_cast<LinkId>(link))}
                   : MeshReference{});
  }
  if (!any) {
    return Error::of(ErrorCode::Empty,
                     "the model has no surface; expected a node that carries triangles, spheres or "
                     "capsules");
  }
  FORETOUCH_TRY(auto avatar, Avatar::build(links.skeleton, std::move(lss), std::move(meshes)));
  return ModelAvatar{std::move(avatar), std::move(surface.triangles), std::move(surface.skin),
                     links.nodeOfLink, std::move(report)};
}

}  // namespace foretouch
