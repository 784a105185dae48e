#include "middleware/solid_world/world_movers.h"

#include <algorithm>
#include <utility>

#include "articulated/try.h"
#include "lss/index.h"

namespace foretouch::internal {

std::int32_t KindNumbers::ofAvatar(std::uint64_t identity) {
  for (const auto& [known, number] : ofAvatars_) {
    if (known == identity) return number;
  }
  ofAvatars_.emplace_back(identity, next());
  return ofAvatars_.back().second;
}

bool KindNumbers::isOfAvatar(std::int32_t number) const {
  return std::any_of(ofAvatars_.begin(), ofAvatars_.end(),
                     [number](const auto& known) { return known.second == number; });
}

Result<Done> WorldMovers::collect(const WorldParts& world, const std::vector<std::uint8_t>& isMover,
                                  std::int64_t fromUs, std::int64_t toUs, KindNumbers& numbers) {
  bodies_.resize(world.bodies.size());
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    bodies_[i].begin(static_cast<BodyId>(i));
    if (isMover[i] == 0) continue;
    FORETOUCH_CHECK(collectBody(world, static_cast<BodyId>(i), fromUs, toUs, numbers, bodies_[i]));
  }
  return Done{};
}

Result<Done> WorldMovers::collectBody(const WorldParts& world, BodyId id, std::int64_t fromUs,
                                      std::int64_t toUs, KindNumbers& numbers, AroundBody& body) {
  spans_.begin(world, id, kStillScene, fromUs, toUs);
  std::int64_t endUs = fromUs;
  while (spans_.next()) {
    FORETOUCH_TRY(const SystemPlan* const plan,
                  plans_.planOf(world, spans_, SystemQuestion::Boxes, id, kStillScene, planKey_));
    spans_.poses(Eigen::Vector3d::Zero(), true, motions_, poses_);
    AroundLeg& leg = body.addLeg();
    leg.beginUs = spans_.beginUs();
    leg.endUs = endUs = spans_.endUs();
    leg.kind = &kindOf(world, id, *plan, numbers);
    leg.from = poses_.chains[0].from;
    leg.to = poses_.chains[0].to;
    leg.rounding = poses_.rounding;
    body.isAssumed = body.isAssumed || spans_.isAssumed();
    body.settle();
  }
  // It was there, and then nothing is known of it.
  if (endUs < toUs && world.body(id).episodeAt(endUs) != nullptr) body.isAssumed = true;
  return Done{};
}

const AroundKind& WorldMovers::kindOf(const WorldParts& world, BodyId id, const SystemPlan& plan,
                                      KindNumbers& numbers) {
  for (const Known& known : kinds_) {
    if (known.plan == &plan) return *known.kind;
  }
  const BodyKind& own = world.kindOf(id);
  AroundKind kind{numbers.next(), plan.chains[0], plan.first[slotOf(spans_.placeOf(id))], {},
                  own.mesh,       own.rho};
  kind.volumes.resize(countOf(plan.chains[0].numJoints()));
  for (std::size_t link = 0; link < own.volumes.size(); ++link) {
    kind.volumes[slotOf(kind.first) + link] = own.volumes[link];
  }
  kinds_.push_back({&plan, std::make_unique<AroundKind>(std::move(kind))});
  return *kinds_.back().kind;
}

}  // namespace foretouch::internal
