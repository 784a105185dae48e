// middleware/world/world_parts.h: the contents of a World. Not installed.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/result.h"
#include "articulated/track.h"
#include "lss/index.h"
#include "middleware/scene/scene.h"
#include "middleware/surface/link_surface.h"
#include "middleware/world/world_options.h"
#include "tessellation/aabb.h"

namespace foretouch::internal {

/// What bodies of one avatar or of one mesh have in common.
struct BodyKind {
  Skeleton skeleton;
  std::optional<Avatar> avatar;
  std::optional<Scene> mesh;              // where there is no avatar
  std::vector<std::vector<Lss>> volumes;  // per link: contain what touches
  // For an avatar that brings one, and for a mesh that is a link with triangles; else nothing.
  std::optional<AvatarSurface> surface;
  std::vector<LinkId> linkOf;  // the link of each of them
  // For an avatar that brings one; and, per link, what it carries of it (BlendTable::carried()).
  std::optional<SkinnedSurface> skin;
  std::vector<std::vector<Lss>> carried;
  double rho = 0.0;  // no point of all these is farther from its link's origin

  /// What questions at an instant meet is within these.
  [[nodiscard]] const std::vector<std::vector<Lss>>& asked() const {
    return skin ? carried : volumes;
  }
};
/// A skin's weights do not add up to 1 to the last bit, so a box around what its links carry does
/// not hold it to the last bit either: by how much it is to grow (m); 0 without a skin.
[[nodiscard]] double skinSlack(const BodyKind& kind, const Aabb& box);

/// No point of a link's volumes is farther from its origin (m).
[[nodiscard]] double reachOf(const std::vector<Lss>& volumes);

/// Larger meshes are frames that others are seen from, however they turn (world.md 1): their
/// hierarchies take seconds to build.
inline constexpr std::size_t kMostSpinningTriangles = 100'000;

/// The triangles by which a link touches; null: by its LSS.
[[nodiscard]] const LinkSurface* surfaceOf(const BodyKind& kind, LinkId link);

/// The kind of an avatar, which touches by its LSS or by its surface; and of a mesh.
[[nodiscard]] BodyKind bodyKindOf(const Avatar& avatar, const BodyOptions& options);
/// Error (OutOfRange): the LSS around the mesh, which is larger than the mesh, leaves the limit.
Result<BodyKind> bodyKindOf(const Scene& mesh, bool meetsMeshes);

/// A body between two changes of its carrier.
struct Episode {
  std::int64_t beginUs = 0;
  std::optional<Carrier> carrier;
  Track track;  // in the frame of the carrier's link; the first knot is at beginUs
  /// Whether it keeps its place in the carrier's frame.
  [[nodiscard]] bool isHeldFast() const { return carrier && !carrier->movesInFrame; }
};

struct WorldBody {
  std::int32_t kind = 0;
  BodyOptions options;
  std::int32_t ownRules = -1;     // place in WorldParts::rules, if own links are asked
  std::vector<Episode> episodes;  // none before the first pose

  /// The episode at an instant; null before the first one. O(log episodes), as the next one.
  [[nodiscard]] const Episode* episodeAt(std::int64_t utimeUs) const;
  /// When the episode after that of the instant begins, or the first one; INT64_MAX if none does.
  [[nodiscard]] std::int64_t nextEpisodeUs(std::int64_t utimeUs) const;
};

/// Which groups are asked: World::ask(), World::askStill().
struct GroupsAsked {
  std::array<std::uint32_t, kNumBodyGroups> others{};  // bit b of row a
  std::uint32_t still = 0;
  [[nodiscard]] bool has(BodyGroup a, BodyGroup b) const {
    return (others[slotOf(a)] >> static_cast<unsigned>(b) & 1U) != 0;
  }
  [[nodiscard]] bool hasStill(BodyGroup group) const {
    return (still >> static_cast<unsigned>(group) & 1U) != 0;
  }
};

struct WorldParts {
  std::uint64_t identity = 0;  // different for every world of the process
  std::uint64_t changes = 0;   // so far: what is kept of a world holds until the next one
  std::optional<Scene> still;
  WorldOptions options;
  std::vector<BodyKind> kinds;
  std::size_t mostLss = 0;       // of any kind
  std::vector<PairRules> rules;  // for own links, no two alike
  std::vector<WorldBody> bodies;
  GroupsAsked groups;
  std::int64_t forgottenUs = -kMostUtimeUs - 1;
  std::int64_t thinnedUs = -kMostUtimeUs - 1;
  double thinnedBy = 0.0;  // no point has been moved farther by thinning (m)
  Pose ofOneJoint;         // memory of push()

  [[nodiscard]] const WorldBody& body(BodyId id) const { return bodies[slotOf(id)]; }
  [[nodiscard]] const BodyKind& kindOf(BodyId id) const { return kinds[slotOf(body(id).kind)]; }
  /// The body, its carrier at the instant, that one's carrier, and so on up; they replace `chain`.
  /// One that is not there is the last one. Never a circle: World::attach() refuses those.
  void chainAt(BodyId id, std::int64_t utimeUs, std::vector<BodyId>& chain) const;
  /// Until when the chain of the instant is the same: one of it appears, or changes its carrier,
  /// there. INT64_MAX if none does.
  [[nodiscard]] std::int64_t chainEndUs(const std::vector<BodyId>& chain,
                                        std::int64_t utimeUs) const;
  /// Whether two different bodies are asked, by their groups and by what they are made of.
  [[nodiscard]] bool isAsked(BodyId a, BodyId b) const;
  /// The same for a body and the static scene.
  [[nodiscard]] bool isStillAsked(BodyId id) const;
};

}  // namespace foretouch::internal
