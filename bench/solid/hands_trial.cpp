#include "bench/solid/hands_trial.h"

#include <algorithm>

#include "articulated/motion.h"
#include "bench/judged.h"
#include "bench/solid/figure.h"

namespace foretouch::tools {
namespace {

constexpr double kInsideBy = 1e-4;

/// An LSS of a link, in a frame in its middle, the frame's axes as the link's.
struct CentredHand {
  Eigen::Vector3d middle_L;
  Lss lss;
};

CentredHand centred(const Lss& lss) {
  const Eigen::Vector3d middle = 0.5 * (lss.a + lss.b);
  return {middle, {lss.a - middle, lss.b - middle, lss.radius}};
}

std::vector<RigidPose> placesOf(const SolidActor& actor, LinkId link, const CentredHand& hand,
                                const std::vector<Pose>& poses) {
  std::vector<RigidPose> places;
  std::vector<LinkState> states;
  for (const Pose& pose : poses) {
    ChainMotion(actor.avatar.skeleton(), pose, pose).statesAt(0.0, states);
    const LinkState& state = states[slotOf(link)];
    places.push_back({Quaternion(state.R_WL), state.pointAt(hand.middle_L)});
  }
  return places;
}

/// Looks only at a hand.
class HandJudge {
 public:
  HandJudge(const SolidStage& stage, const Lss& hand_L)
      : hand_L_(hand_L),
        judge_(stage.judged, {{-1}, {{{{plain(hand_L.a), plain(hand_L.b)}, hand_L.radius}}}, {}}) {}

  void look(const RigidPose& tracked, const RigidPose& shown, HandsTally& tally) {
    const auto& q = shown.rotation;
    const oracle::PlainPose pose{{{q.w(), q.x(), q.y(), q.z()}}, {plain(shown.pivot)}};
    const double depth = std::max(0.0, -judge_.at(pose, 0.0).least);
    double off = 0.0;
    for (const Eigen::Vector3d& end : {hand_L_.a, hand_L_.b}) {
      off = std::max(
          off,
          (shown.rotation * end + shown.pivot - tracked.rotation * end - tracked.pivot).norm());
    }
    tally.deviation.push_back(off);
    tally.depth.push_back(depth);
    ++tally.ticks;
    tally.inside += depth > kInsideBy ? 1 : 0;
  }

 private:
  Lss hand_L_;
  oracle::WayJudge judge_;
};

}  // namespace

HandsTrial::HandsTrial(const SolidStage& stage)
    : stage_(stage), engine_(finiteTriangles(stage.scene)) {}

HandsTally& HandsTrial::tallyOf(const std::string& name) {
  for (HandsTally& tally : tallies_) {
    if (tally.name == name) return tally;
  }
  tallies_.emplace_back();
  tallies_.back().name = name;
  return tallies_.back();
}

void HandsTrial::add(const SolidActor& actor, const std::vector<Pose>& tracked,
                     const ShownPoses& shown, double rateHz) {
  const SolidLinks links = solidLinks(actor.avatar);
  for (LinkId link = 0; link < actor.avatar.numLinks(); ++link) {
    if (!links.hands[slotOf(link)] || actor.avatar.lss(link).empty()) continue;
    addHand(actor, link, tracked, shown, rateHz);
  }
}

void HandsTrial::addHand(const SolidActor& actor, LinkId link, const std::vector<Pose>& tracked,
                         const ShownPoses& shown, double rateHz) {
  const CentredHand hand = centred(actor.avatar.lss(link).front());
  const auto wanted = placesOf(actor, link, hand, tracked);
  const auto bySolid = placesOf(actor, link, hand, shown.poses);
  HandJudge judge(stage_, hand.lss);
  for (std::size_t i = 1; i < wanted.size(); ++i) {
    judge.look(wanted[i], wanted[i], tallyOf("as tracked"));
    RigidPose lifted = wanted[i];
    lifted.pivot.y() += shown.lift[i];
    judge.look(lifted, bySolid[i], tallyOf("Foretouch, solid"));
  }
  // At lower rates an engine's hands are far off, and its continuous detection takes minutes.
  if (rateHz < kTrialRateHz) return;
  for (const auto& follower : engine_.of(hand.lss)) {
    follower->begin(wanted.front());
    for (std::size_t i = 1; i < wanted.size(); ++i) {
      judge.look(wanted[i], follower->follow(wanted[i], 1.0 / rateHz), tallyOf(follower->name()));
    }
  }
}

}  // namespace foretouch::tools
