#include "tests/oracle/solid_campaign.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "bench/solid/busy_places.h"
#include "middleware/solid/solid_avatar.h"
#include "tests/support/random_geometry.h"

namespace foretouch::test {
namespace {

constexpr double kNewTargetS = 1.0 / 3.0;

/// Rules of the avatar's own links, if asked and if it has pairs.
std::optional<PairRules> rulesOf(const Avatar& avatar) {
  auto rules = PairRules::derive(avatar);
  if (!rules.ok()) return std::nullopt;
  return std::move(rules).value();
}

/// The targets of one place, made from the clip's poses there.
class TargetMaker {
 public:
  TargetMaker(const SolidCampaign& campaign, std::vector<Pose> poses, std::uint64_t seed)
      : campaign_(campaign),
        poses_(std::move(poses)),
        random_(seed),
        isTracked_(poses_.front().rotations.size(), 1) {}

  [[nodiscard]] std::size_t count() const { return poses_.size(); }
  [[nodiscard]] const std::vector<std::uint8_t>& isTracked() const { return isTracked_; }

  Pose at(std::size_t i) {
    std::fill(isTracked_.begin(), isTracked_.end(), std::uint8_t{1});
    if (i == 0 || campaign_.targets == SolidTargets::Clip) return poses_[i];
    return campaign_.targets == SolidTargets::Random ? randomAt(i) : hostileAt(i);
  }

 private:
  Pose anywhere() {
    Pose pose = poses_.front();
    for (Quaternion& q : pose.rotations) q = (q * random_.turn(random_.uniform(0.0, 1.5)));
    pose.translations[0] += random_.inBox(0.8);
    return pose;
  }

  Pose randomAt(std::size_t i) {
    const auto every = static_cast<std::size_t>(std::max(1.0, kNewTargetS * campaign_.rateHz));
    if ((i - 1) % every == 0) {
      from_ = i == 1 ? poses_.front() : to_;
      to_ = anywhere();
    }
    const double t = static_cast<double>((i - 1) % every + 1) / static_cast<double>(every);
    Pose pose = to_;
    for (std::size_t j = 0; j < pose.rotations.size(); ++j) {
      pose.rotations[j] = from_.rotations[j].slerp(t, to_.rotations[j]).normalized();
      pose.translations[j] = (1 - t) * from_.translations[j] + t * to_.translations[j];
    }
    return pose;
  }

  Pose hostileAt(std::size_t i) {
    Pose pose = poses_[frozen_ > 0 ? frozenAt_ : i];
    if (frozen_ > 0) --frozen_;
    const auto joint = static_cast<std::size_t>(random_.below(static_cast<int>(isTracked_.size())));
    switch (random_.below(12)) {
      case 0: pose.translations[0] += random_.magnitude(0.1, 100.0) * random_.direction(); break;
      case 1: pose.rotations[0] = pose.rotations[0] * random_.turn(kPi); break;
      case 2:
        isTracked_[joint] = 0;
        pose.rotations[joint] = random_.rotation();
        break;
      case 3:
        frozen_ = 1 + random_.below(20);
        frozenAt_ = i;
        break;
      case 4:
        for (Quaternion& q : pose.rotations) q.coeffs() = -q.coeffs();
        break;
      case 5: pose = anywhere(); break;
      default:
        for (Quaternion& q : pose.rotations) q = q * random_.turn(random_.magnitude(1e-6, 0.05));
    }
    for (Quaternion& q : pose.rotations) q.normalize();
    return pose;
  }

  const SolidCampaign& campaign_;
  std::vector<Pose> poses_;
  Random random_;
  std::vector<std::uint8_t> isTracked_;
  Pose from_, to_;
  int frozen_ = 0;
  std::size_t frozenAt_ = 0;
};

}  // namespace

const char* toString(SolidTargets targets) {
  constexpr std::array<const char*, kNumSolidTargets> kWords = {"clip", "random", "hostile"};
  return kWords[static_cast<std::size_t>(targets)];
}

void SolidCampaignTally::add(const SolidCampaignTally& other) {
  way.add(other.way);
  motion.add(other.motion);
  places += other.places;
  refused += other.refused;
}

std::string SolidCampaignTally::summary() const {
  std::string text = fmt::format(
      "{} places, {} ticks ({} moved), {} instants, {} penetrations, least {:.3g} m, {} "
      "discontinuous, {} clearances too high, {} uncertified, {} appeared, {} refused;",
      places, way.ticks, way.moved, way.instants, way.inside, way.least, way.broken,
      way.overclaimed, way.uncertified, way.appeared, refused);
  for (std::size_t i = 0; i < kNumSolidStates; ++i) {
    text += fmt::format(" {} {}", way.states[i], toString(static_cast<SolidState>(i)));
  }
  return text;
}

SolidCampaignTally judgeSolid(const tools::SolidStage& stage, const tools::SolidActor& actor,
                              const SolidCampaign& campaign) {
  SolidCampaignTally tally;
  SolidOptions options;
  options.skin = campaign.skin;
  options.tolerance = campaign.skin / 4.0;
  std::vector<std::array<int, 2>> ownPairs;
  if (campaign.self) {
    options.self = rulesOf(actor.avatar);
    if (!options.self) return tally;
    ownPairs = tools::askedPairs(actor.avatar, *options.self);
  }
  tools::BusyPlaceRequest request;
  request.count = campaign.places;
  request.seconds = std::min(campaign.seconds, actor.clip.durationS());
  request.seed = campaign.seed;
  const bool isBeside = campaign.beside != Obstacles::None;
  if (isBeside) request.leastInside = 0.0;  // what is beside makes any place busy
  std::uint64_t seed = campaign.seed;
  for (const tools::BusyPlace& place : tools::busyPlaces(stage, actor, request)) {
    auto poses =
        tools::trackedPoses(actor, place.placement, campaign.rateHz, place.fromS, request.seconds);
    if (poses.size() < 2) continue;
    std::optional<tools::SolidStage> made;
    if (isBeside) made = withObstacles(stage, campaign.beside, actor.avatar, poses, seed + 1);
    const tools::SolidStage& here = isBeside ? *made : stage;
    auto solid = SolidAvatar::build(actor.avatar, here.scene, options);
    if (!solid.ok()) continue;
    ++tally.places;
    TargetMaker targets(campaign, std::move(poses), ++seed);
    tools::WayAudit audit(here.judged, actor.avatar, ownPairs);
    const std::string name = fmt::format(
        "{} in {}, {} targets, {:g} Hz, skin {:g}, sunk {:g}, self {}, seed {}, place "
        "{}",
        actor.name, here.name, toString(campaign.targets), campaign.rateHz, campaign.skin,
        campaign.sunk, campaign.self, campaign.seed, tally.places);
    audit.begin(name);
    const bool isPerson = campaign.targets != SolidTargets::Hostile;
    MotionAudit motion(here.judged, actor.avatar, options);
    motion.begin(name);
    SolidTick tick;
    for (std::size_t i = 0; i < targets.count(); ++i) {
      Pose target = targets.at(i);
      target.translations[0] -= campaign.sunk * options.up;
      if (solid.value().follow({target, 1.0 / campaign.rateHz, &targets.isTracked()}, tick).ok()) {
        audit.look(tick);
        if (isPerson) motion.look(target, tick, 1.0 / campaign.rateHz);
      } else {
        ++tally.refused;
      }
    }
    tally.way.add(audit.tally());
    tally.motion.add(motion.tally());
  }
  return tally;
}

}  // namespace foretouch::test
