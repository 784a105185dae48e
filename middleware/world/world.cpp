#include "middleware/world/world.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <utility>

#include "articulated/try.h"
#include "middleware/surface/skin_parts.h"
#include "middleware/world/world_parts.h"

namespace foretouch {
namespace {

using internal::BodyKind;
using internal::Episode;
using internal::WorldBody;
using internal::WorldParts;

constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();

std::uint64_t newIdentity() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

Error bodyError(BodyId body, ErrorCode code, const std::string& what) {
  Error error = Error::in("body", code, "body " + std::to_string(body) + " " + what);
  error.index = body;
  return error;
}

bool isGroup(BodyGroup group) {
  return group >= 0 && group < kNumBodyGroups;
}

Error groupError(BodyGroup group) {
  return Error::in("group", ErrorCode::OutOfRange,
                   "expected a group from 0 to 31, found " + std::to_string(group));
}

bool areAlike(const PairRules& x, const PairRules& y) {
  const auto isSamePair = [](const LeftOutPair& p, const LeftOutPair& q) {
    return p.a == q.a && p.b == q.b && p.reason == q.reason;
  };
  const auto isSameRadius = [](const PairRadius& p, const PairRadius& q) {
    return p.a == q.a && p.lssA == q.lssA && p.b == q.b && p.lssB == q.lssB && p.radius == q.radius;
  };
  return x.avatarIdentity() == y.avatarIdentity() &&
         std::equal(x.leftOut().begin(), x.leftOut().end(), y.leftOut().begin(), y.leftOut().end(),
                    isSamePair) &&
         std::equal(x.radii().begin(), x.radii().end(), y.radii().begin(), y.radii().end(),
                    isSameRadius);
}

/// Place of the rules among the world's.
std::int32_t placeOfRules(WorldParts& parts, const PairRules& own) {
  std::vector<PairRules>& rules = parts.rules;
  const auto known = std::find_if(rules.begin(), rules.end(),
                                  [&](const PairRules& other) { return areAlike(own, other); });
  const auto place = static_cast<std::int32_t>(known - rules.begin());
  if (known == rules.end()) rules.push_back(own);
  return place;
}

/// When what is known of the body ends; never, if it is held fast or taken to be somewhere.
std::int64_t knownUntil(const WorldBody& body) {
  if (body.episodes.empty() || body.options.whenSilent != WhenSilent::Wait) return kNever;
  const Episode& last = body.episodes.back();
  return last.isHeldFast() ? kNever : last.track.knownUntilUs();
}

/// The body, or one that carries it at any time from `utimeUs` on, is one that is looked for, or
/// carries more above it than any question can have (Skeleton::build()).
enum class Above : std::uint8_t { Fine, HangsOn, TooDeep };

Above whatIsAbove(const WorldParts& parts, BodyId carrier, BodyId carried, std::int64_t utimeUs) {
  std::vector<BodyId> chain;
  for (std::int64_t us = utimeUs; us != kNever; us = parts.chainEndUs(chain, us)) {
    parts.chainAt(carrier, us, chain);
    const bool isCircle = std::find(chain.begin(), chain.end(), carried) != chain.end();
    if (isCircle) return Above::HangsOn;
    if (chain.size() >= countOf(kMaxChainDepth)) return Above::TooDeep;
  }
  return Above::Fine;
}

Pose poseOf(const RigidPose& rigid) {
  return {{rigid.rotation}, {rigid.translation}};
}

Result<Done> checkedBody(const WorldParts& parts, BodyId body) {
  if (body >= 0 && slotOf(body) < parts.bodies.size()) return Done{};
  return bodyError(body, ErrorCode::UnknownName,
                   "is unknown; expected one of the " + std::to_string(parts.bodies.size()) +
                       " that were added");
}

Result<Done> checkedNew(const WorldParts& parts, const BodyOptions& options) {
  if (!isGroup(options.group)) return groupError(options.group);
  if (parts.bodies.size() < countOf(kMaxBodies)) return Done{};
  return Error::of(ErrorCode::LimitExceeded,
                   "expected at most " + std::to_string(kMaxBodies) + " bodies");
}

Result<Done> checkedSurface(const Avatar& avatar, const BodyOptions& options) {
  if (!options.surface) return Done{};
  if (options.surface->numLinks() != avatar.numLinks()) {
    return Error::in("surface", ErrorCode::Mismatch, "expected the surface of this avatar");
  }
  if (options.self && !options.self->radii().empty()) {
    return Error::in("self", ErrorCode::Mismatch,
                     "expected rules without pair radii beside a surface: a smaller LSS does not "
                     "hold its link's mesh");
  }
  return Done{};
}

Result<Done> checkedSkin(const Avatar& avatar, const BodyOptions& options) {
  if (!options.skin || options.skin->parts().avatarIdentity == avatar.identity()) return Done{};
  return Error::in("skin", ErrorCode::Mismatch, "expected the skin of this avatar");
}

template <typename Surface>
bool isSameSurface(const std::optional<Surface>& x, const std::optional<Surface>& y) {
  return x.has_value() == y.has_value() && (!x || &x->parts() == &y->parts());
}

/// The body may have another carrier from the instant on.
Result<Done> checkedChange(const WorldParts& parts, BodyId id, std::int64_t utimeUs) {
  const WorldBody& body = parts.body(id);
  if (utimeUs <= parts.forgottenUs) {
    return bodyError(id, ErrorCode::OutOfRange,
                     "cannot change its carrier at " + std::to_string(utimeUs) +
                         " us: it is in the past, all before " + std::to_string(parts.forgottenUs) +
                         " us is forgotten");
  }
  if (body.episodes.empty()) return Done{};
  const Episode& last = body.episodes.back();
  if (utimeUs <= last.beginUs) {
    return bodyError(id, ErrorCode::OutOfRange,
                     "changed its carrier, or appeared, at " + std::to_string(last.beginUs) +
                         " us; expected a later instant than that, found " +
                         std::to_string(utimeUs) + " us");
  }
  if (!last.isHeldFast() && utimeUs > last.track.knownUntilUs()) {
    return bodyError(id, ErrorCode::OutOfRange,
                     "is known until " + std::to_string(last.track.knownUntilUs()) +
                         " us; expected a pose at or after " + std::to_string(utimeUs) +
                         " us before its carrier changes");
  }
  return Done{};
}

Result<Done> checkedCarrier(const WorldParts& parts, BodyId id, const Carrier& carrier,
                            std::int64_t utimeUs) {
  FORETOUCH_CHECK(checkedBody(parts, carrier.body));
  if (utimeUs < parts.thinnedUs) {
    return bodyError(id, ErrorCode::OutOfRange,
                     "cannot be attached at " + std::to_string(utimeUs) + " us: all before " +
                         std::to_string(parts.thinnedUs) + " us is thinned");
  }
  const std::int32_t links = parts.kindOf(carrier.body).skeleton.numJoints();
  if (carrier.link < 0 || carrier.link >= links) {
    return bodyError(carrier.body, ErrorCode::UnknownName,
                     "has links 0 to " + std::to_string(links - 1) + "; expected one of them to " +
                         "carry body " + std::to_string(id) + ", found " +
                         std::to_string(carrier.link));
  }
  if (parts.body(carrier.body).episodeAt(utimeUs) == nullptr) {
    return bodyError(carrier.body, ErrorCode::OutOfRange,
                     "is not there at " + std::to_string(utimeUs) +
                         " us, when it is to carry body " + std::to_string(id));
  }
  switch (whatIsAbove(parts, carrier.body, id, utimeUs)) {
    case Above::Fine: return Done{};
    case Above::HangsOn:
      return bodyError(id, ErrorCode::BadHierarchy,
                       "carries body " + std::to_string(carrier.body) +
                           ", itself or through others, at or after " + std::to_string(utimeUs) +
                           " us; expected a carrier that does not hang on it");
    case Above::TooDeep: break;
  }
  return bodyError(id, ErrorCode::LimitExceeded,
                   "would hang on " + std::to_string(kMaxChainDepth) +
                       " bodies or more, one carried by the other; expected fewer");
}

Result<Done> beginEpisode(WorldParts& parts, BodyId id, std::optional<Carrier> carrier,
                          std::int64_t utimeUs, const Pose& pose) {
  ++parts.changes;
  Episode episode{utimeUs, carrier, Track(parts.kindOf(id).skeleton)};
  FORETOUCH_CHECK(episode.track.push(utimeUs, pose));
  parts.bodies[slotOf(id)].episodes.push_back(std::move(episode));
  return Done{};
}

}  // namespace

World::World(std::unique_ptr<internal::WorldParts> parts) : parts_(std::move(parts)) {}
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;
World::~World() = default;

Result<World> World::build(std::optional<Scene> still, const WorldOptions& options) {
  if (!(options.tolerance >= kMinWorldTolerance && options.tolerance <= kMaxTolerance)) {
    return Error::in("tolerance", ErrorCode::OutOfRange, "expected 1e-8 to 1e7 metres");
  }
  auto parts = std::make_unique<WorldParts>();
  parts->identity = newIdentity();
  parts->still = std::move(still);
  parts->options = options;
  parts->groups.others.fill(~std::uint32_t{0});
  parts->groups.still = ~std::uint32_t{0};
  return World(std::move(parts));
}

Result<BodyId> World::add(const Avatar& avatar, const BodyOptions& options) {
  ++parts_->changes;
  FORETOUCH_CHECK(checkedNew(*parts_, options));
  if (options.self && options.self->avatarIdentity() != avatar.identity()) {
    return Error::in("self", ErrorCode::Mismatch, "expected the pair rules of this avatar");
  }
  FORETOUCH_CHECK(checkedSurface(avatar, options));
  FORETOUCH_CHECK(checkedSkin(avatar, options));
  std::vector<BodyKind>& kinds = parts_->kinds;
  const auto known = std::find_if(kinds.begin(), kinds.end(), [&](const BodyKind& kind) {
    return kind.avatar && kind.avatar->identity() == avatar.identity() &&
           isSameSurface(kind.surface, options.surface) && isSameSurface(kind.skin, options.skin);
  });
  const auto kind = static_cast<std::int32_t>(known - kinds.begin());
  if (known == kinds.end()) kinds.push_back(internal::bodyKindOf(avatar, options));
  const std::int32_t rules = options.self ? placeOfRules(*parts_, *options.self) : -1;
  parts_->mostLss = std::max(parts_->mostLss, kinds[slotOf(kind)].linkOf.size());
  parts_->bodies.push_back({kind, options, rules, {}});
  return static_cast<BodyId>(parts_->bodies.size()) - 1;
}

Result<BodyId> World::add(const Scene& mesh, const BodyOptions& options) {
  ++parts_->changes;
  FORETOUCH_CHECK(checkedNew(*parts_, options));
  if (options.self) {
    return Error::in("self", ErrorCode::Mismatch, "expected none: a mesh has no links of its own");
  }
  if (options.surface || options.skin) {
    return Error::in(options.surface ? "surface" : "skin", ErrorCode::Mismatch,
                     "expected none: a mesh touches by its triangles anyway");
  }
  std::vector<BodyKind>& kinds = parts_->kinds;
  const auto known = std::find_if(kinds.begin(), kinds.end(), [&](const BodyKind& kind) {
    return kind.mesh && &kind.mesh->parts() == &mesh.parts();
  });
  const auto kind = static_cast<std::int32_t>(known - kinds.begin());
  if (known == kinds.end()) {
    FORETOUCH_TRY(BodyKind made, internal::bodyKindOf(mesh, parts_->options.askMeshes));
    kinds.push_back(std::move(made));
  }
  parts_->mostLss = std::max(parts_->mostLss, kinds[slotOf(kind)].linkOf.size());
  parts_->bodies.push_back({kind, options, -1, {}});
  return static_cast<BodyId>(parts_->bodies.size()) - 1;
}

std::int32_t World::numBodies() const {
  return static_cast<std::int32_t>(parts_->bodies.size());
}

Result<Done> World::push(BodyId body, std::int64_t utimeUs, const Pose& pose) {
  ++parts_->changes;
  FORETOUCH_CHECK(checkedBody(*parts_, body));
  std::vector<Episode>& episodes = parts_->bodies[slotOf(body)].episodes;
  if (episodes.empty()) {
    FORETOUCH_CHECK(checkedChange(*parts_, body, utimeUs));
    return beginEpisode(*parts_, body, std::nullopt, utimeUs, pose);
  }
  if (episodes.back().isHeldFast()) {
    return bodyError(body, ErrorCode::Mismatch,
                     "is held fast by body " + std::to_string(episodes.back().carrier->body) +
                         "; expected no pose until it is detached");
  }
  if (utimeUs <= parts_->forgottenUs) {
    return Error::in("utime", ErrorCode::OutOfRange,
                     "a knot at " + std::to_string(utimeUs) + " us is in the past; all before " +
                         std::to_string(parts_->forgottenUs) + " us is forgotten");
  }
  return episodes.back().track.push(utimeUs, pose);
}

Result<Done> World::push(BodyId body, std::int64_t utimeUs, const RigidPose& pose) {
  Pose& single = parts_->ofOneJoint;
  single.rotations.assign(1, pose.rotation);
  single.translations.assign(1, pose.translation);
  return push(body, utimeUs, single);
}

Result<Done> World::attach(BodyId body, const Carrier& carrier, std::int64_t utimeUs,
                           const Pose& pose) {
  FORETOUCH_CHECK(checkedBody(*parts_, body));
  FORETOUCH_CHECK(checkedChange(*parts_, body, utimeUs));
  FORETOUCH_CHECK(checkedCarrier(*parts_, body, carrier, utimeUs));
  return beginEpisode(*parts_, body, carrier, utimeUs, pose);
}

Result<Done> World::attach(BodyId body, const Carrier& carrier, std::int64_t utimeUs,
                           const RigidPose& pose) {
  return attach(body, carrier, utimeUs, poseOf(pose));
}

Result<Done> World::detach(BodyId body, std::int64_t utimeUs, const Pose& pose) {
  FORETOUCH_CHECK(checkedBody(*parts_, body));
  const std::vector<Episode>& episodes = parts_->body(body).episodes;
  if (episodes.empty() || !episodes.back().carrier) {
    return bodyError(body, ErrorCode::Mismatch, "is not carried; expected one that is");
  }
  FORETOUCH_CHECK(checkedChange(*parts_, body, utimeUs));
  return beginEpisode(*parts_, body, std::nullopt, utimeUs, pose);
}

Result<Done> World::detach(BodyId body, std::int64_t utimeUs, const RigidPose& pose) {
  return detach(body, utimeUs, poseOf(pose));
}

Result<Done> World::ask(BodyGroup a, BodyGroup b, bool isAsked) {
  if (!isGroup(a)) return groupError(a);
  if (!isGroup(b)) return groupError(b);
  const auto set = [&](BodyGroup row, BodyGroup column) {
    const std::uint32_t bit = 1U << static_cast<unsigned>(column);
    std::uint32_t& bits = parts_->groups.others[slotOf(row)];
    bits = isAsked ? bits | bit : bits & ~bit;
  };
  set(a, b);
  set(b, a);
  return Done{};
}

Result<Done> World::askStill(BodyGroup group, bool isAsked) {
  if (!isGroup(group)) return groupError(group);
  const std::uint32_t bit = 1U << static_cast<unsigned>(group);
  std::uint32_t& bits = parts_->groups.still;
  bits = isAsked ? bits | bit : bits & ~bit;
  return Done{};
}

std::optional<BodyId> World::waitsFor() const {
  std::optional<BodyId> slowest;
  std::int64_t until = kNever;
  for (BodyId id = 0; id < numBodies(); ++id) {
    const std::int64_t known = knownUntil(parts_->body(id));
    if (known < until) {
      until = known;
      slowest = id;
    }
  }
  return slowest;
}

std::optional<std::int64_t> World::knownUntilUs() const {
  if (const auto slowest = waitsFor()) return knownUntil(parts_->body(*slowest));
  std::optional<std::int64_t> latest;
  for (const WorldBody& body : parts_->bodies) {
    if (body.episodes.empty()) continue;
    const std::int64_t last = body.episodes.back().track.knownUntilUs();
    latest = latest ? std::max(*latest, last) : last;
  }
  return latest;
}

}  // namespace foretouch
