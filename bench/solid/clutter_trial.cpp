#include "bench/solid/clutter_trial.h"

#include <algorithm>

#include "articulated/try.h"
#include "bench/judged.h"
#include "bench/machine.h"
#include "bench/solid/arm_targets.h"

namespace foretouch::tools {
namespace {

constexpr double kFreeBy = 5e-4;
constexpr int kTicksPerGoal = 90, kTicksOnTheWay = 30;

Pose towards(const Pose& from, const Pose& to, double t) {
  Pose pose = to;
  for (std::size_t j = 0; j < pose.rotations.size(); ++j) {
    pose.rotations[j] = from.rotations[j].slerp(t, to.rotations[j]).normalized();
  }
  return pose;
}

bool saysWhy(const SolidTick& tick) {
  switch (tick.state) {
    case SolidState::Equal:
    case SolidState::Snapped: return false;
    case SolidState::Following: return tick.limit != SolidLimit::None;
    case SolidState::Placing:
    case SolidState::Sliding:
    case SolidState::Held:
    case SolidState::Around: return true;
  }
  return false;
}

}  // namespace

RawScene clutter() {
  RawScene raw;
  addSheet(raw, {-1.0, 0.7, -0.75}, {1.4, 0, 0}, {0, 1.3, 0});
  addBox(raw, {-0.9, 1.13, -0.75}, {0.3, 1.15, -0.28});
  addBox(raw, {-0.9, 1.55, -0.75}, {0.3, 1.57, -0.28});
  addBox(raw, {-0.45, 1.15, -0.75}, {-0.43, 1.55, -0.28});
  addBox(raw, {-0.13, 0.7, -0.31}, {-0.11, 2.0, -0.29});
  addBox(raw, {-0.35, 1.15, -0.6}, {-0.2, 1.3, -0.42});
  return raw;
}

Result<ClutterTally> tryClutter(Follower& follower, int goals, std::uint64_t seed) {
  const Avatar avatar = figure();
  const RightArm right(avatar);
  const oracle::Scene judged(plain(clutter().triangles));
  oracle::WayJudge judge(judged, plainBody(avatar));
  WayAudit audit(judged, avatar);
  audit.begin("clutter");
  PortableRandom random(seed);
  ClutterTally tally;
  SolidTick tick;
  Pose from = restPose(avatar.skeleton());
  FORETOUCH_CHECK(follower.follow(from, 1.0 / kTrialRateHz, tick));
  audit.look(tick);
  while (static_cast<int>(tally.goals) < goals) {
    const Pose goal = pointingAnywhere(avatar, right, random);
    if (judge.at(plainPose(goal), kFreeBy).link >= 0) continue;
    ++tally.goals;
    tally.straight += judge.along(plainPose(from), plainPose(goal), kFreeBy).link < 0 ? 1 : 0;
    for (int i = 1; i <= kTicksPerGoal; ++i) {
      const double t = std::min(1.0, static_cast<double>(i) / kTicksOnTheWay);
      const Pose tracked = t < 1.0 ? towards(from, goal, t) : goal;
      const ThreadStopwatch watch;
      FORETOUCH_CHECK(follower.follow(tracked, 1.0 / kTrialRateHz, tick));
      tally.us.push_back(watch.us());
      audit.look(tick);
    }
    const bool isThere = plainPose(tick.shown) == plainPose(goal);
    tally.reached += isThere ? 1 : 0;
    tally.untold += !isThere && !saysWhy(tick) ? 1 : 0;
    from = goal;
  }
  tally.way = audit.tally();
  return tally;
}

}  // namespace foretouch::tools
