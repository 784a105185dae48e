#include "bench/solid/followers.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "articulated/try.h"
#include "lss/index.h"
#include "middleware/query/query.h"

namespace foretouch::tools {
namespace {

class SolidFollower final : public Follower {
 public:
  explicit SolidFollower(SolidAvatar solid) : solid_(std::move(solid)) {}
  Result<Done> follow(const Pose& tracked, double dtS, SolidTick& tick) override {
    return solid_.follow({tracked, dtS, nullptr}, tick);
  }

 private:
  SolidAvatar solid_;
};

/// A limb is a chain of links between branchings; its first joint hangs on the limb above.
struct HeldLimbs {
  std::vector<int> limbOf;  ///< Per link.
  std::vector<int> above;   ///< Per limb; -1: a root's.
};

HeldLimbs limbsOf(const Skeleton& skeleton) {
  std::vector<int> children(countOf(skeleton.numJoints()), 0);
  for (JointId j = 0; j < skeleton.numJoints(); ++j) {
    if (skeleton.parent(j) != kNoParent) ++children[slotOf(skeleton.parent(j))];
  }
  HeldLimbs limbs;
  for (JointId j = 0; j < skeleton.numJoints(); ++j) {
    const JointId parent = skeleton.parent(j);
    if (parent != kNoParent && children[slotOf(parent)] == 1) {
      limbs.limbOf.push_back(limbs.limbOf[slotOf(parent)]);
      continue;
    }
    limbs.above.push_back(parent == kNoParent ? -1 : limbs.limbOf[slotOf(parent)]);
    limbs.limbOf.push_back(static_cast<int>(limbs.above.size()) - 1);
  }
  return limbs;
}

class HoldingFollower final : public Follower {
 public:
  explicit HoldingFollower(Query query)
      : query_(std::move(query)), limbs_(limbsOf(query_.avatar().skeleton())) {}

  Result<Done> follow(const Pose& tracked, double dtS, SolidTick& tick) override {
    static_cast<void>(dtS);
    tick.numWay = 0;
    tick.times.clear();
    tick.hasAppeared = false;
    tick.counters = {};
    tick.isCertified = true;
    tick.clearance = 0.0;
    if (shown_.rotations.empty()) return appear(tracked, tick);
    std::vector<bool> held(limbs_.above.size(), false);
    for (std::size_t pass = 0; pass <= limbs_.above.size(); ++pass) {
      const Pose target = heldTarget(tracked, held);
      motion_.assign(query_.avatar().skeleton(), shown_, target);
      query_.answer(motion_, scratch_, step_);
      ++tick.counters.queries;
      const LinkContact* const first = firstOf(step_);
      if (first == nullptr) {
        moveTo(target, tick);
        break;
      }
      if (!hold(first->link, held)) break;
    }
    tick.shown = shown_;
    tick.state = isAt(tracked) ? SolidState::Equal : SolidState::Held;
    return Done{};
  }

 private:
  Result<Done> appear(const Pose& tracked, SolidTick& tick) {
    shown_ = tracked;
    if (tick.way.empty()) tick.way.resize(1);
    tick.way[0] = shown_;
    tick.numWay = 1;
    tick.times.assign(1, 0.0);
    tick.hasAppeared = true;
    tick.shown = shown_;
    tick.state = SolidState::Equal;
    return Done{};
  }

  [[nodiscard]] Pose heldTarget(const Pose& tracked, const std::vector<bool>& held) const {
    Pose target = tracked;
    for (std::size_t j = 0; j < limbs_.limbOf.size(); ++j) {
      if (!held[static_cast<std::size_t>(limbs_.limbOf[j])]) continue;
      target.rotations[j] = shown_.rotations[j];
      target.translations[j] = shown_.translations[j];
    }
    return target;
  }

  /// The link that stops the motion first; nullptr if none does.
  static const LinkContact* firstOf(const StepContacts& step) {
    const LinkContact* first = nullptr;
    for (const LinkContact& contact : step.links) {
      if (contact.verdict == Verdict::Clear) continue;
      if (first == nullptr || contact.freeUntil < first->freeUntil) first = &contact;
    }
    return first;
  }

  /// The link's limb, or the nearest one above that is not held yet. False if all are.
  bool hold(LinkId link, std::vector<bool>& held) const {
    int limb = limbs_.limbOf[slotOf(link)];
    while (limb >= 0 && held[static_cast<std::size_t>(limb)]) {
      limb = limbs_.above[static_cast<std::size_t>(limb)];
    }
    if (limb < 0) return false;
    held[static_cast<std::size_t>(limb)] = true;
    return true;
  }

  void moveTo(const Pose& target, SolidTick& tick) {
    if (plainPose(target) == plainPose(shown_)) return;
    shown_ = target;
    if (tick.way.empty()) tick.way.resize(1);
    tick.way[0] = shown_;
    tick.numWay = 1;
    tick.times.assign(1, 1.0);
  }

  [[nodiscard]] bool isAt(const Pose& tracked) const {
    return plainPose(tracked) == plainPose(shown_);
  }

  Query query_;
  HeldLimbs limbs_;
  Pose shown_;
  ChainMotion motion_;
  Scratch scratch_;
  StepContacts step_;
};

}  // namespace

Result<std::unique_ptr<Follower>> solidFollower(const Avatar& avatar, const Scene& scene,
                                                const SolidOptions& options) {
  FORETOUCH_TRY(auto solid, SolidAvatar::build(avatar, scene, options));
  return std::unique_ptr<Follower>(std::make_unique<SolidFollower>(std::move(solid)));
}

Result<std::unique_ptr<Follower>> holdingFollower(const Avatar& avatar, const Scene& scene,
                                                  double skin) {
  QueryOptions options;
  options.tolerance = skin;
  options.passSeparating = true;
  FORETOUCH_TRY(auto query, Query::build(avatar, scene, options));
  return std::unique_ptr<Follower>(std::make_unique<HoldingFollower>(std::move(query)));
}

}  // namespace foretouch::tools
