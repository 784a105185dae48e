#include "middleware/world/system_plan.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <utility>

#include "articulated/try.h"
#include "lss/index.h"
#include "middleware/surface/link_surface.h"

namespace foretouch::internal {
namespace {

using Volumes = std::vector<std::vector<Lss>>;
using LinkSurfacePtr = std::shared_ptr<const LinkSurface>;

/// The skeleton of the members on one chain; of all, if that is kEveryChain.
constexpr std::int32_t kEveryChain = -1;
Result<Skeleton> skeletonOf(const WorldParts& world, const std::vector<SystemMember>& members,
                            std::int32_t chain, std::vector<JointId>& first) {
  RawSkeleton raw;
  for (std::size_t i = 0; i < members.size(); ++i) {
    const SystemMember& member = members[i];
    if (chain != kEveryChain && member.chain != chain) continue;
    const JointId carrier =
        member.carrier < 0 ? kNoParent : first[slotOf(member.carrier)] + member.link;
    first[i] = appendChain(world.kinds[slotOf(member.kind)].skeleton, carrier, raw);
  }
  return Skeleton::build(raw);
}

/// Makes one plan.
class PlanMaker {
 public:
  PlanMaker(const WorldParts& world, const SystemSpans& spans, SystemPlan& plan)
      : world_(world), members_(spans.members()), plan_(plan) {}

  Result<Done> make(SystemQuestion question, std::int32_t a, std::int32_t b) {
    FORETOUCH_CHECK(makeChains(question));
    options_.tolerance = kAskedShare * world_.options.tolerance;
    switch (question) {
      case SystemQuestion::Boxes: return makeBoxes(a);
      case SystemQuestion::Still: return makeStill(a);
      case SystemQuestion::Self: return makeSelf(a);
      case SystemQuestion::Pair: return makePair(a, b);
      case SystemQuestion::Mesh: return makeMesh(a, b);
    }
    return Done{};
  }

 private:
  /// A mesh is a frame that all others are seen from: on one chain with it.
  Result<Done> makeChains(SystemQuestion question) {
    plan_.first.assign(members_.size(), 0);
    const bool areTwo = question == SystemQuestion::Pair && members_.back().chain > 0;
    for (std::int32_t chain = 0; chain <= (areTwo ? 1 : 0); ++chain) {
      const std::int32_t whose = areTwo ? chain : kEveryChain;
      FORETOUCH_TRY(auto skeleton, skeletonOf(world_, members_, whose, plan_.first));
      plan_.chains.push_back(std::move(skeleton));
    }
    clearLinks(plan_.chains.front());
    return Done{};
  }
  void clearLinks(const Skeleton& chain) {
    lss_.assign(countOf(chain.numJoints()), {});
    surfaces_.assign(lss_.size(), nullptr);
  }
  [[nodiscard]] const Skeleton& chainOf(std::int32_t place) const {
    return plan_.isMerged() ? plan_.chains.front() : plan_.chains[slotOf(member(place).chain)];
  }

  [[nodiscard]] const SystemMember& member(std::int32_t place) const {
    return members_[slotOf(place)];
  }
  [[nodiscard]] const BodyKind& kind(std::int32_t place) const {
    return world_.kinds[slotOf(member(place).kind)];
  }
  [[nodiscard]] LinkId linkOf(std::int32_t place, LinkId link) const {
    return plan_.first[slotOf(place)] + link;
  }

  void addVolumes(std::int32_t place) {
    const BodyKind& own = kind(place);
    for (std::size_t link = 0; link < own.volumes.size(); ++link) {
      const std::size_t i = slotOf(plan_.first[slotOf(place)]) + link;
      lss_[i] = own.volumes[link];
      if (own.surface) surfaces_[i] = own.surface->parts().links[link];
    }
  }

  void clear(LinkId link) {
    lss_[slotOf(link)].clear();
    surfaces_[slotOf(link)] = nullptr;
  }

  /// Links that bring triangles touch by them, all others by their LSS.
  void useSurfaces(const Avatar& avatar) {
    const auto isExact = [](const LinkSurfacePtr& own) {
      return own != nullptr && !own->triangles().empty();
    };
    if (std::none_of(surfaces_.begin(), surfaces_.end(), isExact)) return;
    auto parts = std::make_shared<SurfaceParts>();
    for (LinkId link = 0; link < avatar.numLinks(); ++link) {
      LinkSurfacePtr& own = surfaces_[slotOf(link)];
      const Fidelity fidelity = isExact(own) ? Fidelity::Exact : Fidelity::Link;
      options_.linkPolicies.push_back({options_.tolerance, fidelity});
      if (own == nullptr) own = noTriangles(avatar.lss(link).size());
      own->prepare();  // allocates, and so not while it is asked
      parts->numTriangles += own->triangles().size();
      parts->links.push_back(own);
    }
    options_.surface = AvatarSurface(std::move(parts));
  }

  static LinkSurfacePtr noTriangles(std::size_t numLss) {
    return std::make_shared<const LinkSurface>(std::vector<Triangle>(),
                                               std::vector<std::vector<std::int32_t>>(numLss));
  }

  Result<Done> makeBoxes(std::int32_t a) {
    addVolumes(a);
    plan_.table.assign(lss_);
    return Done{};
  }

  Result<Done> makeStill(std::int32_t a) {
    FORETOUCH_CHECK(makeBoxes(a));
    FORETOUCH_TRY(const Avatar avatar, Avatar::build(plan_.chains.front(), lss_));
    FORETOUCH_TRY(options_.self, ownRules(a, avatar));
    useSurfaces(avatar);
    FORETOUCH_TRY(plan_.query, Query::build(avatar, *world_.still, options_));
    return Done{};
  }

  Result<Done> makeSelf(std::int32_t a) {
    FORETOUCH_CHECK(makeBoxes(a));
    FORETOUCH_TRY(const Avatar avatar, Avatar::build(plan_.chains.front(), lss_));
    FORETOUCH_TRY(options_.self, ownRules(a, avatar));
    useSurfaces(avatar);
    FORETOUCH_TRY(plan_.one, SidePlan::make(avatar, options_));
    plan_.asked = PairsAsked(avatar, plan_.one->table, *options_.self);
    return Done{};
  }

  Result<Done> makePair(std::int32_t a, std::int32_t b) {
    const std::int32_t one = std::min(a, b), other = std::max(a, b);
    plan_.isEmpty = isBare(one) || isBare(other);
    if (plan_.isEmpty) return Done{};
    FORETOUCH_TRY(plan_.one, sideOf(one));
    FORETOUCH_TRY(plan_.other, sideOf(other));
    if (plan_.isMerged()) {
      plan_.asked = PairsAsked(plan_.one->avatar, plan_.one->table, plan_.other->avatar,
                               plan_.other->table, leftOut(one, other));
    } else {
      plan_.asked = PairsAsked(plan_.one->table, plan_.other->table);
    }
    plan_.isEmpty = !plan_.asked.isAsked();
    return Done{};
  }

  [[nodiscard]] bool isBare(std::int32_t place) const {
    const Volumes& own = kind(place).volumes;
    return std::all_of(own.begin(), own.end(), [](const auto& l) { return l.empty(); });
  }

  Result<SidePlan> sideOf(std::int32_t place) {
    clearLinks(chainOf(place));
    options_.linkPolicies.clear();
    options_.surface.reset();
    addVolumes(place);
    FORETOUCH_TRY(const Avatar avatar, Avatar::build(chainOf(place), lss_));
    useSurfaces(avatar);
    return SidePlan::make(avatar, options_);
  }

  Result<Done> makeMesh(std::int32_t a, std::int32_t b) {
    addVolumes(a);
    // The link that carries the mesh, or that the mesh carries, is not asked.
    if (member(b).carrier == a) clear(linkOf(a, member(b).link));
    if (member(a).carrier == b) clearJoined(a);
    plan_.isEmpty = std::all_of(lss_.begin(), lss_.end(), [](const auto& l) { return l.empty(); });
    if (plan_.isEmpty) return Done{};
    FORETOUCH_TRY(plan_.seen, RelativeChain::build(plan_.chains.front(), linkOf(b, 0)));
    lookFromMesh();
    FORETOUCH_TRY(const Avatar avatar, Avatar::build(plan_.seen->skeleton(), lss_));
    useSurfaces(avatar);
    FORETOUCH_TRY(plan_.query, Query::build(avatar, *kind(b).mesh, options_));
    return Done{};
  }

  /// Goes from links of the system to those of the chain.
  void lookFromMesh() {
    const std::size_t count = countOf(plan_.seen->skeleton().numJoints());
    Volumes lss(count);
    std::vector<LinkSurfacePtr> surfaces(count);
    for (std::size_t link = 0; link < lss_.size(); ++link) {
      const auto seen = slotOf(plan_.seen->linkOf(static_cast<LinkId>(link)));
      lss[seen] = std::move(lss_[link]);
      surfaces[seen] = std::move(surfaces_[link]);
    }
    lss_ = std::move(lss);
    surfaces_ = std::move(surfaces);
  }

  /// The body's own, for the system's avatar; nothing if it has none.
  Result<std::optional<PairRules>> ownRules(std::int32_t a, const Avatar& avatar) const {
    const std::int32_t place = world_.body(member(a).body).ownRules;
    if (place < 0) return std::optional<PairRules>();
    const PairRules* const own = &world_.rules[slotOf(place)];
    std::vector<LeftOutPair> leftOut = own->leftOut();
    for (LeftOutPair& pair : leftOut) {
      pair.a = linkOf(a, pair.a);
      pair.b = linkOf(a, pair.b);
    }
    std::vector<PairRadius> radii = own->radii();
    for (PairRadius& pair : radii) {
      pair.a = linkOf(a, pair.a);
      pair.b = linkOf(a, pair.b);
    }
    FORETOUCH_TRY(PairRules rules,
                  PairRules::leavingOut(avatar, std::move(leftOut), std::move(radii)));
    return std::optional<PairRules>(std::move(rules));
  }

  /// Whether a carried body's link is not asked about the link that carries it: each, if the body
  /// is held fast; its roots, if it moves there by itself.
  [[nodiscard]] bool isJoined(std::int32_t place, LinkId link) const {
    return member(place).episode->isHeldFast() || kind(place).skeleton.parent(link) == kNoParent;
  }

  void clearJoined(std::int32_t place) {
    for (JointId joint = 0; joint < kind(place).skeleton.numJoints(); ++joint) {
      if (isJoined(place, joint)) clear(linkOf(place, joint));
    }
  }

  /// The pairs of the carried one's links and the link that carries them, if one of the two carries
  /// the other.
  [[nodiscard]] std::vector<LinksOfSides> leftOut(std::int32_t one, std::int32_t other) const {
    std::vector<LinksOfSides> pairs;
    const bool isOneCarried = member(one).carrier == other;
    if (!isOneCarried && member(other).carrier != one) return pairs;
    const std::int32_t carried = isOneCarried ? one : other, carrier = isOneCarried ? other : one;
    const LinkId holding = linkOf(carrier, member(carried).link);
    for (JointId joint = 0; joint < kind(carried).skeleton.numJoints(); ++joint) {
      if (!isJoined(carried, joint)) continue;
      const LinkId held = linkOf(carried, joint);
      pairs.push_back(isOneCarried ? LinksOfSides{held, holding} : LinksOfSides{holding, held});
    }
    return pairs;
  }

  const WorldParts& world_;
  const std::vector<SystemMember>& members_;
  SystemPlan& plan_;
  Volumes lss_;                           // per joint of a chain, of those that are asked
  std::vector<LinkSurfacePtr> surfaces_;  // the same; null: by their LSS
  QueryOptions options_;
};

/// The rules of own links are a body's, not its kind's.
std::int64_t ownRulesOf(const WorldParts& world, SystemQuestion question, BodyId a) {
  const bool asksOwn = question == SystemQuestion::Still || question == SystemQuestion::Self;
  return asksOwn ? world.body(a).ownRules : -1;
}

std::uint64_t mixed(const std::vector<std::int64_t>& key) {
  std::uint64_t sum = 0;
  for (const std::int64_t part : key) {
    sum = (sum ^ static_cast<std::uint64_t>(part)) * 0x9E37'79B9'7F4A'7C15U;
    sum ^= sum >> 32U;
  }
  return sum;
}

bool comesBeforeKey(const std::unique_ptr<SystemPlan>& plan, const std::vector<std::int64_t>& key) {
  return plan->key < key;
}

}  // namespace

std::uint64_t SystemPlans::newGeneration() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

void SystemPlans::clear() {
  plans_.clear();
  generation_ = newGeneration();
}

const SystemPlan* SystemPlans::find(const std::vector<std::int64_t>& key) const {
  const auto place = std::lower_bound(plans_.begin(), plans_.end(), key, comesBeforeKey);
  return place != plans_.end() && (*place)->key == key ? place->get() : nullptr;
}

Result<const SystemPlan*> SystemPlans::planOf(const WorldParts& world, const SystemSpans& spans,
                                              SystemQuestion question, BodyId a, BodyId b,
                                              std::vector<std::int64_t>& key, LatePlans* late) {
  const std::int32_t placeOfA = spans.placeOf(a);
  const std::int32_t placeOfB = b == kStillScene ? -1 : spans.placeOf(b);
  key.clear();
  key.push_back(static_cast<std::int64_t>(question));
  key.push_back(ownRulesOf(world, question, a));
  key.push_back(placeOfA);
  key.push_back(placeOfB);
  for (const SystemMember& member : spans.members()) {
    key.push_back(member.kind);
    key.push_back(member.carrier);
    key.push_back(member.link);
    key.push_back(member.episode->isHeldFast() ? 1 : 0);
  }
  if (late == nullptr) return ofAll(world, spans, question, key);
  if (std::exchange(late->generation_, generation_) != generation_) late->plans_ = {};
  const SystemPlan*& plan = late->plans_[mixed(key) % LatePlans::kKept];
  if (plan != nullptr && plan->key == key) return plan;
  FORETOUCH_TRY(plan, ofAll(world, spans, question, key));
  return plan;
}

/// A plan that any thread has asked for, or a new one.
Result<const SystemPlan*> SystemPlans::ofAll(const WorldParts& world, const SystemSpans& spans,
                                             SystemQuestion question,
                                             const std::vector<std::int64_t>& key) {
  {
    const std::shared_lock<std::shared_mutex> lock(mutex_);
    if (const SystemPlan* const known = find(key)) return known;
  }
  const auto placeOfA = static_cast<std::int32_t>(key[2]),
             placeOfB = static_cast<std::int32_t>(key[3]);
  auto made = std::make_unique<SystemPlan>();
  made->key = key;
  FORETOUCH_CHECK(PlanMaker(world, spans, *made).make(question, placeOfA, placeOfB));
  const std::unique_lock<std::shared_mutex> lock(mutex_);
  if (const SystemPlan* const known = find(key)) return known;  // another thread was faster
  const auto place = std::lower_bound(plans_.begin(), plans_.end(), key, comesBeforeKey);
  return plans_.insert(place, std::move(made))->get();
}

}  // namespace foretouch::internal
