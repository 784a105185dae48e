#include "middleware/world/world_parts.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

#include "lss/fit.h"
#include "lss/rounding.h"
#include "middleware/surface/link_surface.h"

namespace foretouch::internal {
namespace {

double reachOf(const std::vector<std::vector<Lss>>& volumes) {
  double reach = 0.0;
  for (const std::vector<Lss>& link : volumes) {
    for (const Lss& lss : link) {
      reach = std::max(reach, std::max(lss.a.norm(), lss.b.norm()) + lss.radius);
    }
  }
  return reach * kInflation;
}

void measure(BodyKind& kind) {
  for (std::size_t link = 0; link < kind.volumes.size(); ++link) {
    kind.linkOf.insert(kind.linkOf.end(), kind.volumes[link].size(), static_cast<LinkId>(link));
  }
  kind.rho = reachOf(kind.volumes);
}

/// Of one link, whose one LSS holds the triangles that `held` names.
AvatarSurface surfaceOf(std::vector<Triangle> triangles, std::vector<std::int32_t> held) {
  auto parts = std::make_shared<SurfaceParts>();
  parts->numTriangles = triangles.size();
  parts->links.push_back(std::make_shared<const LinkSurface>(
      std::move(triangles), std::vector<std::vector<std::int32_t>>{std::move(held)}));
  parts->links.front()->prepareWide();  // so that no window waits for it
  return AvatarSurface(std::move(parts));
}

}  // namespace

BodyKind bodyKindOf(const Avatar& avatar, const std::optional<AvatarSurface>& surface) {
  BodyKind kind{avatar.skeleton(), avatar, std::nullopt, {}, surface, {}, 0.0};
  for (LinkId link = 0; link < avatar.numLinks(); ++link) kind.volumes.push_back(avatar.lss(link));
  measure(kind);
  return kind;
}

BodyKind bodyKindOf(const Scene& mesh, bool meetsMeshes) {
  RawSkeleton raw;
  raw.joints = {{"mesh", kNoParent, Eigen::Vector3d::Zero(), Quaternion::Identity()}};
  BodyKind kind{Skeleton::build(raw).value(), std::nullopt, mesh, {}, {}, {}, 0.0};
  std::vector<Eigen::Vector3d> points;
  std::vector<Triangle> triangles(mesh.numTriangles());
  std::vector<std::int32_t> finite;
  for (std::size_t i = 0; i < mesh.numTriangles(); ++i) {
    const Triangle& triangle = mesh.triangle(static_cast<TriangleId>(i));
    if (!isFinite(triangle)) continue;
    points.insert(points.end(), triangle.vertices.begin(), triangle.vertices.end());
    triangles[i] = triangle;
    finite.push_back(static_cast<std::int32_t>(i));
  }
  kind.volumes = {{fitLss(points)}};
  if (meetsMeshes || finite.size() <= kMostSpinningTriangles) {
    kind.surface = surfaceOf(std::move(triangles), std::move(finite));
  }
  measure(kind);
  return kind;
}

const Episode* WorldBody::episodeAt(std::int64_t utimeUs) const {
  const Episode* found = nullptr;
  for (const Episode& episode : episodes) {
    if (episode.beginUs <= utimeUs) found = &episode;
  }
  return found;
}

std::int64_t WorldBody::nextEpisodeUs(std::int64_t utimeUs) const {
  for (const Episode& episode : episodes) {
    if (episode.beginUs > utimeUs) return episode.beginUs;
  }
  return std::numeric_limits<std::int64_t>::max();
}

bool WorldParts::isAsked(BodyId a, BodyId b) const {
  if (!options.askMeshes && !kindOf(a).avatar && !kindOf(b).avatar) return false;
  const auto row = asked[slotOf(body(a).options.group)];
  return (row >> static_cast<unsigned>(body(b).options.group) & 1U) != 0;
}

bool WorldParts::isStillAsked(BodyId id) const {
  return still && (options.askMeshes || kindOf(id).avatar) &&
         (askedStill >> static_cast<unsigned>(body(id).options.group) & 1U) != 0;
}

}  // namespace foretouch::internal
