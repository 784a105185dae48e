#include "middleware/world/world_parts.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <memory>
#include <utility>

#include "articulated/try.h"
#include "lss/fit.h"
#include "lss/rounding.h"
#include "middleware/surface/blend_table.h"
#include "middleware/surface/link_surface.h"
#include "middleware/surface/skin_parts.h"

namespace foretouch::internal {
namespace {

/// The reach of the axes of clusters and parts.
double reachOfAxes(const BlendTable& blends) {
  double reach = 0.0;
  const auto take = [&](const BlendedLss& blend) {
    for (std::int32_t i = 0; i < blend.numShares; ++i) {
      reach = std::max(reach, blends.shares(blend)[i].rho);
    }
  };
  for (std::int32_t i = 0; i < blends.size(); ++i) take(blends[i]);
  for (std::int32_t i = 0; i < blends.numParts(); ++i) take(blends.part(i));
  return reach;
}

void measure(BodyKind& kind) {
  for (std::size_t link = 0; link < kind.volumes.size(); ++link) {
    kind.linkOf.insert(kind.linkOf.end(), kind.volumes[link].size(), static_cast<LinkId>(link));
    kind.rho = std::max(kind.rho, reachOf(kind.volumes[link]));
  }
  for (const std::vector<Lss>& link : kind.carried) kind.rho = std::max(kind.rho, reachOf(link));
}

/// The surface of one link, whose one LSS holds the triangles that `held` names.
AvatarSurface surfaceOf(std::vector<Triangle> triangles, std::vector<std::int32_t> held) {
  auto parts = std::make_shared<SurfaceParts>();
  parts->numTriangles = triangles.size();
  parts->links.push_back(std::make_shared<const LinkSurface>(
      std::move(triangles), std::vector<std::vector<std::int32_t>>{std::move(held)}));
  parts->links.front()->prepareWide();  // so that no window waits for it
  return AvatarSurface(std::move(parts));
}

/// The first episode that begins after the instant.
std::vector<Episode>::const_iterator episodeAfter(const std::vector<Episode>& episodes,
                                                  std::int64_t utimeUs) {
  return std::upper_bound(
      episodes.begin(), episodes.end(), utimeUs,
      [](std::int64_t us, const Episode& episode) { return us < episode.beginUs; });
}

}  // namespace

double reachOf(const std::vector<Lss>& volumes) {
  double reach = 0.0;
  for (const Lss& lss : volumes) {
    reach = std::max(reach, std::max(lss.a.norm(), lss.b.norm()) + lss.radius);
  }
  return reach * kInflation;
}

const LinkSurface* surfaceOf(const BodyKind& kind, LinkId link) {
  if (!kind.surface) return nullptr;
  const LinkSurface& own = *kind.surface->parts().links[slotOf(link)];
  return own.triangles().empty() ? nullptr : &own;
}

double skinSlack(const BodyKind& kind, const Aabb& box) {
  if (!kind.skin || box.min.x() > box.max.x()) return 0.0;
  return kind.skin->parts().blends->sumError() * (box.min.norm() + box.max.norm()) * kInflation;
}

BodyKind bodyKindOf(const Avatar& avatar, const BodyOptions& options) {
  BodyKind kind{avatar.skeleton(), avatar, std::nullopt, {}, options.surface, {},
                options.skin,      {},     0.0};
  for (LinkId link = 0; link < avatar.numLinks(); ++link) kind.volumes.push_back(avatar.lss(link));
  if (kind.skin) {
    kind.carried.resize(kind.volumes.size());
    const LssTable& carried = kind.skin->parts().blends->carried();
    for (std::int32_t i = 0; i < carried.size(); ++i) {
      const LssTable::Entry& one = carried[i];
      kind.carried[slotOf(one.link)].push_back(
          {Eigen::Vector3d(one.a), Eigen::Vector3d(one.b), one.radius});
    }
  }
  measure(kind);
  if (kind.skin) kind.rho = std::max(kind.rho, reachOfAxes(*kind.skin->parts().blends));
  return kind;
}

Result<BodyKind> bodyKindOf(const Scene& mesh, bool meetsMeshes) {
  RawSkeleton raw;
  raw.joints = {{"mesh", kNoParent, Eigen::Vector3d::Zero(), Quaternion::Identity()}};
  FORETOUCH_TRY(Skeleton skeleton, Skeleton::build(raw));
  BodyKind kind{std::move(skeleton), std::nullopt, mesh, {}, {}, {}, {}, {}, 0.0};
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
  // Chains are made of it later, where no error could be returned.
  if (!Avatar::build(kind.skeleton, kind.volumes).ok()) {
    return Error::in("mesh", ErrorCode::OutOfRange,
                     "the LSS around the mesh has a coordinate or radius beyond 1e7 m; expected a "
                     "smaller mesh; is the unit right?");
  }
  if (meetsMeshes || finite.size() <= kMostSpinningTriangles) {
    kind.surface = surfaceOf(std::move(triangles), std::move(finite));
  }
  measure(kind);
  return kind;
}

const Episode* WorldBody::episodeAt(std::int64_t utimeUs) const {
  const auto next = episodeAfter(episodes, utimeUs);
  return next == episodes.begin() ? nullptr : &*std::prev(next);
}

std::int64_t WorldBody::nextEpisodeUs(std::int64_t utimeUs) const {
  const auto next = episodeAfter(episodes, utimeUs);
  return next == episodes.end() ? std::numeric_limits<std::int64_t>::max() : next->beginUs;
}

void WorldParts::chainAt(BodyId id, std::int64_t utimeUs, std::vector<BodyId>& chain) const {
  chain.assign(1, id);
  for (const Episode* episode = body(id).episodeAt(utimeUs); episode != nullptr && episode->carrier;
       episode = body(chain.back()).episodeAt(utimeUs)) {
    chain.push_back(episode->carrier->body);
  }
}

std::int64_t WorldParts::chainEndUs(const std::vector<BodyId>& chain, std::int64_t utimeUs) const {
  std::int64_t end = std::numeric_limits<std::int64_t>::max();
  for (const BodyId id : chain) end = std::min(end, body(id).nextEpisodeUs(utimeUs));
  return end;
}

bool WorldParts::isAsked(BodyId a, BodyId b) const {
  if (!options.askMeshes && !kindOf(a).avatar && !kindOf(b).avatar) return false;
  return groups.has(body(a).options.group, body(b).options.group);
}

bool WorldParts::isStillAsked(BodyId id) const {
  return still && (options.askMeshes || kindOf(id).avatar) &&
         groups.hasStill(body(id).options.group);
}

}  // namespace foretouch::internal
