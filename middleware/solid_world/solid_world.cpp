#include "middleware/solid_world/solid_world.h"

#include <algorithm>
#include <string>
#include <utility>

#include "articulated/try.h"
#include "lss/index.h"
#include "lss/rounding.h"
#include "middleware/solid_world/solid_body.h"
#include "middleware/world/world_parts.h"

namespace foretouch {
namespace {

constexpr std::int64_t kLongestTickUs = 10'000'000;
/// A tick's way has fewer pieces.
constexpr std::size_t kRoomForTick = 4096;

std::string us(std::int64_t utimeUs) {
  return std::to_string(utimeUs) + " us";
}

Error ofBody(BodyId body, ErrorCode code, const std::string& what) {
  Error error = Error::in("body", code, "body " + std::to_string(body) + " " + what);
  error.index = body;
  return error;
}

/// The error for a target that was refused, with its body.
Error ofTarget(BodyId body, Error error) {
  error.message = "body " + std::to_string(body) + ": " + error.message;
  if (error.file.empty()) error.file = "target";
  return error;
}

}  // namespace

class SolidWorld::Parts {
 public:
  Parts(World world, WorldFollower follower, SolidReach reach, Scene still, std::int64_t beginUs)
      : world_(std::move(world)),
        follower_(std::move(follower)),
        reach_(reach),
        still_(std::move(still)),
        atUs_(beginUs) {}

  World& world() { return world_; }
  WorldFollower& follower() { return follower_; }
  Result<Done> follow(WorldEvents& events) { return follower_.follow(world_, atUs_, events); }
  [[nodiscard]] std::int64_t utimeUs() const { return atUs_; }

  Result<BodyId> add(const Avatar& avatar, const SolidOptions& options, const BodyOptions& body) {
    FORETOUCH_TRY(auto solid, internal::SolidBody::build(world_.numBodies(), avatar, still_,
                                                         options, numbers_));
    Avatar met = avatar;
    if (reach_ == SolidReach::Skin && !body.self && !body.surface) {
      FORETOUCH_TRY(met, avatar.grownBy(options.skin));
    }
    // Memory runs out before the world has the body, or not at all.
    auto made = std::make_unique<internal::SolidBody>(std::move(solid));
    solids_.reserve(solids_.size() + 1);
    signatures_.resize(solids_.size() + 1);
    FORETOUCH_TRY(const BodyId id, world_.add(met, body));
    solids_.push_back(std::move(made));
    return id;
  }

  Result<Done> tick(std::int64_t utimeUs, const std::vector<SolidBodyTarget>& targets,
                    std::vector<SolidBodyTick>& ticks) {
    FORETOUCH_CHECK(checkedInstant(utimeUs));
    FORETOUCH_CHECK(checkedTargets(targets));
    sortBodies();
    FORETOUCH_CHECK(checkedBodies(utimeUs));
    FORETOUCH_CHECK(movers_.collect(world_.parts(), isMover_, atUs_, utimeUs, numbers_));
    FORETOUCH_CHECK(handTools(utimeUs));
    for (const auto& solid : solids_) {
      lookAround(*solid);
      FORETOUCH_CHECK(solid->prepare(around_));
      for (const auto& other : solids_) {
        if (other == solid || !parts().isAsked(solid->id(), other->id())) continue;
        FORETOUCH_CHECK(solid->prepare(*other));
      }
    }
    for (const SolidBodyTarget& target : targets) solidOf(target.body)->takeTarget();
    std::size_t count = 0;
    for (const auto& solid : solids_) count += solid->hasTarget() ? 1 : 0;
    ticks.resize(count);
    count = 0;
    for (const auto& solid : solids_) {
      if (!solid->hasTarget()) continue;
      lookAround(*solid);
      solid->move(atUs_, utimeUs, around_, ticks[count++]);
    }
    shareClearances(ticks);
    const std::int64_t fromUs = std::exchange(atUs_, utimeUs);
    for (const SolidBodyTick& tick : ticks) FORETOUCH_CHECK(pushWay(fromUs, tick));
    return Done{};
  }

 private:
  [[nodiscard]] const internal::WorldParts& parts() const { return world_.parts(); }

  [[nodiscard]] internal::SolidBody* solidOf(BodyId body) const {
    for (const auto& solid : solids_) {
      if (solid->id() == body) return solid.get();
    }
    return nullptr;
  }

  Result<Done> checkedInstant(std::int64_t utimeUs) const {
    if (utimeUs <= atUs_ || utimeUs - atUs_ > kLongestTickUs || utimeUs > kMostUtimeUs) {
      return Error::in("utime", ErrorCode::OutOfRange,
                       "expected an instant 1 us to 10 s after the last one, at " + us(atUs_) +
                           ", found " + us(utimeUs));
    }
    if (atUs_ < parts().forgottenUs) {
      return Error::in("utime", ErrorCode::OutOfRange,
                       "the tick begins at " + us(atUs_) + "; all before " +
                           us(parts().forgottenUs) + " is forgotten");
    }
    return Done{};
  }

  /// Each is checked, and kept aside, by its solid avatar.
  Result<Done> checkedTargets(const std::vector<SolidBodyTarget>& targets) const {
    for (std::size_t i = 0; i < targets.size(); ++i) {
      const BodyId body = targets[i].body;
      internal::SolidBody* const solid = solidOf(body);
      if (solid == nullptr) {
        return ofBody(body, ErrorCode::UnknownName,
                      "is no solid avatar; expected one that was added as one");
      }
      const auto isSame = [body](const SolidBodyTarget& other) { return other.body == body; };
      if (std::any_of(targets.begin(), targets.begin() + static_cast<std::ptrdiff_t>(i), isSame)) {
        return ofBody(body, ErrorCode::DuplicateName, "has two targets; expected one");
      }
      if (targets[i].pose == nullptr) {
        return ofBody(body, ErrorCode::Empty, "has a target without a pose; expected one");
      }
      const auto checked = solid->checkTarget(targets[i]);
      if (!checked.ok()) return ofTarget(body, checked.error());
    }
    return Done{};
  }

  /// Finds what is a solid avatar, what one holds, and what moves by itself.
  void sortBodies() {
    const auto n = countOf(world_.numBodies());
    isSolid_.assign(n, 0);
    for (const auto& solid : solids_) isSolid_[slotOf(solid->id())] = 1;
    isMover_.assign(n, 1);
    holders_.assign(n, {});
    for (std::size_t i = 0; i < n; ++i) {
      if (parts().bodies[i].options.isVolume) {
        isMover_[i] = 0;
        continue;
      }
      holders_[i] = internal::holderOf(parts(), isSolid_, static_cast<BodyId>(i), atUs_);
      if (isSolid_[i] != 0 || holders_[i].body != kStillScene) isMover_[i] = 0;
    }
  }

  Result<Done> checkedBodies(std::int64_t utimeUs) const {
    for (BodyId id = 0; id < world_.numBodies(); ++id) {
      const internal::WorldBody& body = parts().body(id);
      if (body.episodes.empty()) continue;
      const internal::Episode& last = body.episodes.back();
      if (isSolid_[slotOf(id)] != 0) {
        if (last.carrier) {
          return ofBody(id, ErrorCode::Mismatch,
                        "is a solid avatar and carried; expected that nobody carries it");
        }
        if (last.track.numKnots() + kRoomForTick > kMaxKnots) {
          return ofBody(id, ErrorCode::LimitExceeded,
                        "has too many poses; expected that the world forgets old ones");
        }
        if (last.track.knownUntilUs() > atUs_) {
          return ofBody(id, ErrorCode::Mismatch,
                        "is a solid avatar, and a pose of it was pushed; expected that ticks alone "
                        "move it");
        }
        continue;
      }
      FORETOUCH_CHECK(checkedHolder(id, utimeUs));
      const bool waits = body.options.whenSilent == WhenSilent::Wait && !last.isHeldFast();
      if (waits && last.track.knownUntilUs() < utimeUs) {
        return ofBody(id, ErrorCode::OutOfRange,
                      "is known until " + us(last.track.knownUntilUs()) +
                          "; expected poses until " + us(utimeUs) + ", where the tick ends");
      }
    }
    return Done{};
  }

  /// No hand takes or lets go of anything within a tick, and what is held is held fast.
  Result<Done> checkedHolder(BodyId id, std::int64_t utimeUs) const {
    if (parts().body(id).options.isVolume) return Done{};
    const internal::Holder& holder = holders_[slotOf(id)];
    if (holder.body != kStillScene && !holder.isHeldFast) {
      return ofBody(id, ErrorCode::Mismatch,
                    "moves in the hand of body " + std::to_string(holder.body) +
                        "; expected that what a solid avatar carries is held fast");
    }
    for (const internal::Episode& episode : parts().body(id).episodes) {
      if (episode.beginUs <= atUs_ || episode.beginUs >= utimeUs) continue;
      const auto then = internal::holderOf(parts(), isSolid_, id, episode.beginUs);
      if (then.body == holder.body && then.link == holder.link) continue;
      return ofBody(id, ErrorCode::OutOfRange,
                    "changes hands at " + us(episode.beginUs) + ", within the tick from " +
                        us(atUs_) + " to " + us(utimeUs) + "; expected that at its begin or end");
    }
    return Done{};
  }

  /// What each hand holds at the tick's begin.
  Result<Done> handTools(std::int64_t utimeUs) {
    for (const auto& solid : solids_) solid->stand(atUs_, utimeUs);
    for (std::size_t i = 0; i < solids_.size(); ++i) {
      internal::SolidBody& solid = *solids_[i];
      signature_.clear();
      for (BodyId id = 0; id < world_.numBodies(); ++id) {
        if (holders_[slotOf(id)].body == solid.id()) appendSignature(id);
      }
      const bool isNew = signature_ != signatures_[i];
      held_.clear();
      for (BodyId id = 0; isNew && id < world_.numBodies(); ++id) {
        if (holders_[slotOf(id)].body != solid.id()) continue;
        held_.push_back(internal::toolOf(parts(), isSolid_, id, atUs_, covers_));
      }
      lookAround(solid);
      const std::int32_t before = solid.kindNumber();
      FORETOUCH_CHECK(solid.hold(isNew, held_, around_, atUs_, numbers_));
      if (solid.kindNumber() != before && !numbers_.isOfAvatar(before)) {
        for (const auto& other : solids_) other->forget(before);
      }
      signatures_[i] = signature_;
      solid.stand(atUs_, utimeUs);
    }
    return Done{};
  }

  /// Changes where anything on the way from the body to the hand does.
  void appendSignature(BodyId id) {
    for (BodyId at = id; isSolid_[slotOf(at)] == 0;) {
      const internal::Episode& episode = *parts().body(at).episodeAt(atUs_);
      signature_.push_back(at);
      signature_.push_back(episode.beginUs);
      at = episode.carrier->body;
    }
  }

  /// Finds what the solid avatar may meet, by body.
  void lookAround(const internal::SolidBody& solid) {
    around_.bodies.clear();
    around_.isAssumed = false;
    for (const internal::AroundBody& body : movers_.bodies()) {
      if (isMover_[slotOf(body.body)] == 0 || !parts().isAsked(solid.id(), body.body)) continue;
      around_.isAssumed = around_.isAssumed || body.isAssumed;
      if (body.numLegs() != 0) around_.bodies.push_back(&body);
    }
    for (const auto& other : solids_) {
      if (other->id() == solid.id() || other->trace().numLegs() == 0) continue;
      if (parts().isAsked(solid.id(), other->id())) around_.bodies.push_back(&other->trace());
    }
    std::sort(around_.bodies.begin(), around_.bodies.end(),
              [](const auto* x, const auto* y) { return x->body < y->body; });
  }

  /// What moves comes nearer to those that saw it standing, and to those that count on it to have
  /// proven that they may stay: what either has proven of the two counts for both.
  void shareClearances(std::vector<SolidBodyTick>& ticks) const {
    for (SolidBodyTick& tick : ticks) {
      const internal::SolidBody& one = *solidOf(tick.body);
      for (const SolidBodyTick& moved : ticks) {
        const internal::SolidBody& other = *solidOf(moved.body);
        if (moved.body == tick.body || moved.tick.numWay == 0 || !one.isPlaced()) continue;
        if (!parts().isAsked(one.id(), other.id()) || !other.isPlaced()) continue;
        const double ofBoxes = one.trace().box().exteriorDistance(other.trace().box());
        const double apart = std::max(other.proven(), ofBoxes / internal::kInflation);
        tick.tick.clearance = std::min(tick.tick.clearance, apart);
      }
    }
  }

  Result<Done> pushWay(std::int64_t fromUs, const SolidBodyTick& tick) {
    const internal::SolidBody& solid = *solidOf(tick.body);
    if (!solid.isPlaced()) return Done{};
    const SolidTick& own = tick.tick;
    std::int64_t lastUs = fromUs;
    for (std::size_t i = 0; i < own.numWay; ++i) {
      lastUs = solid.endsUs()[i];
      // Where it appears at what was forgotten since, it is there from its next pose on.
      if (lastUs <= parts().forgottenUs) continue;
      FORETOUCH_CHECK(world_.push(tick.body, lastUs, own.way[i]));
    }
    if (lastUs < atUs_) FORETOUCH_CHECK(world_.push(tick.body, atUs_, own.shown));
    return Done{};
  }

  World world_;
  WorldFollower follower_;
  SolidReach reach_;
  Scene still_;
  std::int64_t atUs_;
  internal::KindNumbers numbers_;
  internal::WorldMovers movers_;
  internal::MeshCovers covers_;
  std::vector<std::unique_ptr<internal::SolidBody>> solids_;  // by body
  std::vector<std::vector<std::int64_t>> signatures_;         // of what each holds
  std::vector<std::int64_t> signature_;
  std::vector<internal::HeldTool> held_;
  std::vector<std::uint8_t> isSolid_, isMover_;
  std::vector<internal::Holder> holders_;
  internal::Surroundings around_;
};

Result<SolidWorld> SolidWorld::build(const Scene& still, std::int64_t beginUs,
                                     const WorldOptions& options, SolidReach reach) {
  if (beginUs < -kMostUtimeUs || beginUs >= kMostUtimeUs) {
    return Error::in(
        "begin", ErrorCode::OutOfRange,
        "expected an instant within " + us(kMostUtimeUs) + " of zero, found " + us(beginUs));
  }
  FORETOUCH_TRY(World world, World::build(still, options));
  FORETOUCH_TRY(auto follower, WorldFollower::start(beginUs));
  return SolidWorld(
      std::make_unique<Parts>(std::move(world), std::move(follower), reach, still, beginUs));
}

SolidWorld::SolidWorld(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
SolidWorld::SolidWorld(SolidWorld&&) noexcept = default;
SolidWorld& SolidWorld::operator=(SolidWorld&&) noexcept = default;
SolidWorld::~SolidWorld() = default;

World& SolidWorld::world() {
  return parts_->world();
}

const World& SolidWorld::world() const {
  return parts_->world();
}

Result<BodyId> SolidWorld::add(const Avatar& avatar, const SolidOptions& options,
                               const BodyOptions& body) {
  return parts_->add(avatar, options, body);
}

Result<Done> SolidWorld::follow(WorldEvents& events) {
  return parts_->follow(events);
}

WorldFollower& SolidWorld::follower() {
  return parts_->follower();
}

std::int64_t SolidWorld::utimeUs() const {
  return parts_->utimeUs();
}

Result<Done> SolidWorld::tick(std::int64_t utimeUs, const std::vector<SolidBodyTarget>& targets,
                              std::vector<SolidBodyTick>& ticks) {
  return parts_->tick(utimeUs, targets, ticks);
}

}  // namespace foretouch
