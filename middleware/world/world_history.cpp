// What a world remembers: forgets, and thins (world.md 7).
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "lss/index.h"
#include "lss/rounding.h"
#include "middleware/world/world.h"
#include "middleware/world/world_parts.h"

namespace foretouch {
namespace {

using internal::Episode;
using internal::WorldBody;
using internal::WorldParts;

/// A pose of n joints has 32 for a rotation and 24 for a translation each; the rest is the knot's
/// own, in a ring that may be half empty, and an allocator's. AskHistory.* hold it.
constexpr std::size_t kBytesPerJoint = 56, kBytesPerPose = 256;

std::size_t bytesPerPose(const WorldParts& world, const WorldBody& body) {
  const auto joints = countOf(world.kinds[slotOf(body.kind)].skeleton.numJoints());
  return kBytesPerJoint * joints + kBytesPerPose;
}

/// How many episodes end at or before the instant.
std::size_t countForgotten(const WorldBody& body, std::int64_t utimeUs) {
  std::size_t over = 0;
  while (over + 1 < body.episodes.size() && body.episodes[over + 1].beginUs <= utimeUs) ++over;
  return over;
}

/// What is left if all before the instant is forgotten.
std::size_t bytesAfter(const WorldParts& world, std::int64_t utimeUs) {
  std::size_t sum = 0;
  for (const WorldBody& body : world.bodies) {
    std::size_t knots = 0;
    for (std::size_t i = countForgotten(body, utimeUs - 1); i < body.episodes.size(); ++i) {
      const Track& track = body.episodes[i].track;
      const std::size_t until = track.countUntil(utimeUs - 1);
      knots += track.numKnots() - (until > 0 ? until - 1 : 0);
    }
    sum += knots * bytesPerPose(world, body);
  }
  return sum;
}

/// An episode as long as it is thinned.
struct Stay {
  BodyId body;
  const Episode* episode;
  std::int64_t beginUs, endUs;
  /// Both, while both are.
  [[nodiscard]] Stay during(const Stay& other) const {
    return {body, episode, std::max(beginUs, other.beginUs), std::min(endUs, other.endUs)};
  }
  [[nodiscard]] bool isEmpty() const { return beginUs >= endUs; }
  [[nodiscard]] int moves() const { return episode->isHeldFast() ? 0 : 1; }
};

/// What hangs on what, and when. No body hangs on itself at an instant, so a search along chains
/// of stays that share one ends.
class Hanging {
 public:
  Hanging(const WorldParts& world, std::int64_t untilUs) : world_(world), untilUs_(untilUs) {
    for (BodyId body = 0; slotOf(body) < world.bodies.size(); ++body) {
      const std::size_t episodes = world.body(body).episodes.size();
      for (std::size_t i = 0; i < episodes; ++i) {
        const Stay stay = stayOf(body, i);
        if (stay.episode->carrier && !stay.isEmpty()) carried_.push_back(stay);
      }
    }
    std::sort(carried_.begin(), carried_.end(), [](const Stay& x, const Stay& y) {
      return x.episode->carrier->body < y.episode->carrier->body;
    });
  }

  [[nodiscard]] Stay stayOf(BodyId body, std::size_t episode) const {
    const std::vector<Episode>& episodes = world_.body(body).episodes;
    const std::int64_t end =
        episode + 1 < episodes.size() ? episodes[episode + 1].beginUs : untilUs_;
    return {body, &episodes[episode], episodes[episode].beginUs, std::min(end, untilUs_)};
  }

  /// Per link of the body: no point of it, or of what hangs on it meanwhile, is farther from the
  /// link's origin (m).
  [[nodiscard]] std::vector<double> reachOf(const Stay& stay) const {
    const internal::BodyKind& kind = world_.kindOf(stay.body);
    std::vector<double> reach(kind.volumes.size(), 0.0);
    for (std::size_t link = 0; link < reach.size(); ++link) {
      reach[link] = internal::reachOf(kind.volumes[link]);
      if (kind.skin) {
        reach[link] = std::max(reach[link], internal::reachOf(kind.carried[link]));
      }
    }
    forEachOn(stay, [&](const Stay& carried) {
      double& most = reach[slotOf(carried.episode->carrier->link)];
      most = std::max(most, extentOf(carried));
    });
    return reach;
  }

  /// How many bodies of the longest chain through this one have motions of their own.
  [[nodiscard]] int levels(const Stay& stay) const {
    return above(stay) + stay.moves() + below(stay);
  }

 private:
  template <typename Take>
  void forEachOn(const Stay& stay, const Take& take) const {
    auto next = std::lower_bound(
        carried_.begin(), carried_.end(), stay.body,
        [](const Stay& x, BodyId body) { return x.episode->carrier->body < body; });
    for (; next != carried_.end() && next->episode->carrier->body == stay.body; ++next) {
      const Stay shared = next->during(stay);
      if (!shared.isEmpty()) take(shared);
    }
  }
  /// How far it and what hangs on it reach from the frame that it hangs in (m).
  [[nodiscard]] double extentOf(const Stay& stay) const {
    const Track& track = stay.episode->track;
    const std::vector<double> reach = reachOf(stay);
    std::vector<double> arms(reach.size(), 0.0);
    for (std::int64_t us = track.knownFromUs(); us != std::numeric_limits<std::int64_t>::max();
         us = track.nextKnotUs(us)) {
      const Pose& pose = *track.pieceAt(us).from;
      for (std::size_t j = 0; j < arms.size(); ++j) {
        arms[j] = std::max(arms[j], pose.translations[j].norm());
      }
    }
    double extent = 0.0;
    for (std::size_t j = 0; j < arms.size(); ++j) {
      const JointId parent = track.skeleton().parents()[j];
      if (parent != kNoParent) arms[j] += arms[slotOf(parent)];
      extent = std::max(extent, arms[j] + reach[j]);
    }
    return extent * internal::kInflation;
  }
  [[nodiscard]] int below(const Stay& stay) const {
    int most = 0;
    forEachOn(stay, [&](const Stay& on) { most = std::max(most, on.moves() + below(on)); });
    return most;
  }
  [[nodiscard]] int above(const Stay& stay) const {
    if (!stay.episode->carrier) return 0;
    const BodyId carrier = stay.episode->carrier->body;
    int most = 0;
    for (std::size_t i = 0; i < world_.body(carrier).episodes.size(); ++i) {
      const Stay shared = stayOf(carrier, i).during(stay);
      if (!shared.isEmpty()) most = std::max(most, shared.moves() + above(shared));
    }
    return most;
  }

  const WorldParts& world_;
  std::int64_t untilUs_;
  std::vector<Stay> carried_;  // by their carriers
};

}  // namespace

void World::forgetBefore(std::int64_t utimeUs) {
  ++parts_->changes;
  parts_->forgottenUs = std::max(parts_->forgottenUs, utimeUs);
  // Keeps the motions that end there, too: a body put elsewhere there has its last place reported.
  const std::int64_t keptUs = std::max(utimeUs, -kMostUtimeUs) - 1;
  for (WorldBody& body : parts_->bodies) {
    std::vector<Episode>& episodes = body.episodes;
    const auto over = static_cast<std::ptrdiff_t>(countForgotten(body, keptUs));
    episodes.erase(episodes.begin(), episodes.begin() + over);
    for (Episode& episode : episodes) episode.track.forgetBefore(keptUs);
  }
}

std::int64_t World::forgetBeyond(std::size_t bytes) {
  std::int64_t low = std::max(parts_->forgottenUs, -kMostUtimeUs);
  std::int64_t high = std::max(low, knownUntilUs().value_or(low));
  if (bytesAfter(*parts_, low) > bytes) {
    while (high - low > 1) {
      const std::int64_t middle = low + (high - low) / 2;
      (bytesAfter(*parts_, middle) > bytes ? low : high) = middle;
    }
    low = high;
  }
  forgetBefore(low);
  return low;
}

std::size_t World::poseBytes() const {
  return bytesAfter(*parts_, std::max(parts_->forgottenUs, -kMostUtimeUs));
}

Result<Done> World::thinBefore(std::int64_t utimeUs, double metres) {
  if (!(std::isfinite(metres) && metres >= 0.0)) {
    return Error::in("metres", ErrorCode::OutOfRange,
                     "expected a length of 0 or more, found " + std::to_string(metres));
  }
  ++parts_->changes;
  parts_->thinnedUs = std::max(parts_->thinnedUs, utimeUs);
  parts_->thinnedBy = std::max(parts_->thinnedBy, metres);
  // As forgetBefore(): the motions that end there are kept.
  const std::int64_t keptUs = std::max(utimeUs, -kMostUtimeUs) - 1;
  const Hanging hanging(*parts_, utimeUs);
  for (BodyId body = 0; body < numBodies(); ++body) {
    std::vector<Episode>& episodes = parts_->bodies[slotOf(body)].episodes;
    for (std::size_t i = 0; i < episodes.size(); ++i) {
      if (episodes[i].track.numKnots() < 3) continue;
      const Stay stay = hanging.stayOf(body, i);
      const double share = metres / std::max(1, hanging.levels(stay));
      episodes[i].track.thinBefore(keptUs, hanging.reachOf(stay), share);
    }
  }
  return Done{};
}

}  // namespace foretouch
