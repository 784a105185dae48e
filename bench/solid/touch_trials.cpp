#include "bench/solid/touch_trials.h"

#include <algorithm>
#include <cmath>

#include "articulated/try.h"
#include "bench/judged.h"
#include "bench/solid/arm_targets.h"
#include "bench/solid/figure.h"
#include "middleware/solid/solid_avatar.h"

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;

constexpr double kPressedIn = 0.1, kSlideSpeed = 0.74, kHalfWay = 0.33;
/// The wrist, in front of the shoulder; from there to the tip of the hand; the arm's way in.
constexpr double kWrist = 0.4, kTip = 0.155, kPressStep = 1e-3;
constexpr double kHalfTurn = 3.14159265358979323846;

/// Leads the figure in front of a wall, and lets the judge look.
class AtWall {
 public:
  static Result<AtWall> build(const SolidOptions& options, double z, int fineness) {
    RawScene raw = wallAt(z, fineness);
    RawScene copy = raw;
    FORETOUCH_TRY(auto scene, Scene::build(std::move(copy)));
    FORETOUCH_TRY(auto solid, SolidAvatar::build(figure(), scene, options));
    return AtWall(std::move(solid), raw);
  }

  [[nodiscard]] const RightArm& right() const { return right_; }
  [[nodiscard]] const SolidTick& tick() const { return tick_; }
  [[nodiscard]] const WayTally& way() const { return audit_->tally(); }

  Result<Done> reachFor(const Vector3d& wrist, double dtS) {
    tracked_ = reachingFor(solid_.avatar(), right_, wrist);
    FORETOUCH_CHECK(solid_.follow({tracked_, dtS, nullptr}, tick_));
    audit_->look(tick_);
    return Done{};
  }
  [[nodiscard]] Vector3d shownTip() { return tipAt(tick_.shown); }
  [[nodiscard]] Vector3d trackedTip() { return tipAt(tracked_); }

 private:
  AtWall(SolidAvatar solid, const RawScene& raw)
      : solid_(std::move(solid)),
        right_(solid_.avatar()),
        judged_(std::make_unique<oracle::Scene>(plain(raw.triangles))),
        audit_(std::make_unique<WayAudit>(*judged_, solid_.avatar())),
        judge_(std::make_unique<oracle::WayJudge>(*judged_, plainBody(solid_.avatar()))) {
    audit_->begin("wall");
  }

  Vector3d tipAt(const Pose& pose) {
    const auto& ends = judge_->endsAt(plainPose(pose));
    for (std::size_t c = 0; c < ends.size(); ++c) {
      if (static_cast<std::size_t>(judge_->linkOf()[c]) != right_.hand) continue;
      return {ends[c][1].x, ends[c][1].y, ends[c][1].z};
    }
    return Vector3d::Zero();
  }

  SolidAvatar solid_;
  RightArm right_;
  std::unique_ptr<oracle::Scene> judged_;  // where the judges find it, even if this moves
  std::unique_ptr<WayAudit> audit_;
  std::unique_ptr<oracle::WayJudge> judge_;
  Pose tracked_;
  SolidTick tick_;
};

double alongWall(const Vector3d& from, const Vector3d& to) {
  return std::hypot(to.x() - from.x(), to.y() - from.y());
}

double slantDeg(const Vector3d& normal) {
  return std::acos(std::clamp(normal.z(), -1.0, 1.0)) * 180.0 / kHalfTurn;
}

void lookAtPress(AtWall& wall, Vector3d& lastPush, PressTally& tally) {
  const SolidTick& tick = wall.tick();
  Vector3d push = Vector3d::Zero();
  for (const SolidContact& contact : tick.contacts) {
    push += contact.push * contact.nhat_W;
    tally.mostSlantDeg = std::max(tally.mostSlantDeg, slantDeg(contact.nhat_W));
  }
  const bool isEqual = tick.state == SolidState::Equal;
  const bool isHeld = tick.state == SolidState::Held || tick.state == SolidState::Sliding;
  tally.untrue += (isEqual && push.norm() > 0.0) || (isHeld && !(push.norm() > 0.0)) ? 1 : 0;
  tally.mostPush = std::max(tally.mostPush, push.norm());
  tally.mostJump = std::max(tally.mostJump, (push - lastPush).norm());
  lastPush = push;
  ++tally.ticks;
}

}  // namespace

Result<SlideTally> trySlide(const SolidOptions& options, double rateHz, int fineness) {
  FORETOUCH_TRY(auto wall, AtWall::build(options, -(kWrist + kTip - kPressedIn), fineness));
  const Vector3d shoulder = wall.right().shoulder;
  const auto wristAt = [&](double along, double ahead) {
    return Vector3d(shoulder + Vector3d(along, 0, -ahead));
  };
  SlideTally tally;
  // Straight in, from where it touches nothing.
  const int ticksIn = static_cast<int>(std::ceil(0.5 * rateHz));
  for (int i = 0; i <= ticksIn; ++i) {
    const double share = static_cast<double>(i) / ticksIn;
    const double ahead = kWrist - (1.0 - share) * 2.0 * kPressedIn;
    FORETOUCH_CHECK(wall.reachFor(wristAt(-kHalfWay * share, ahead), 1.0 / rateHz));
  }
  const int ticks = static_cast<int>(std::ceil(2.0 * kHalfWay / kSlideSpeed * rateHz));
  for (int i = 1; i <= ticks; ++i) {
    const Vector3d shown = wall.shownTip(), tracked = wall.trackedTip();
    const double along = kHalfWay * (2.0 * i / ticks - 1.0);
    FORETOUCH_CHECK(wall.reachFor(wristAt(along, kWrist), 1.0 / rateHz));
    tally.shown.push_back(wall.tick().shown);
    if (wall.tick().contacts.empty()) continue;
    tally.ratio.push_back(alongWall(shown, wall.shownTip()) /
                          alongWall(tracked, wall.trackedTip()));
  }
  tally.way = wall.way();
  return tally;
}

Result<PressTally> tryPress(const SolidOptions& options) {
  // The wrist comes as far as kWrist, slightly to the side so that the arm stays bent.
  FORETOUCH_TRY(auto wall, AtWall::build(options, -(kWrist + kTip - kPressedIn), 1));
  const Vector3d shoulder = wall.right().shoulder;
  const auto pressTo = [&](double inside) {
    const Vector3d wrist = shoulder + Vector3d(-0.1, -0.05, -(kWrist - kPressedIn + inside));
    return wall.reachFor(wrist, 1.0 / kTrialRateHz);
  };
  const int steps = static_cast<int>(std::lround(kPressedIn / kPressStep));
  const int before = steps / 5;
  PressTally tally;
  Vector3d lastPush = Vector3d::Zero();
  for (int i = -before; i <= 2 * steps + before; ++i) {
    const int depth = i <= steps ? i : 2 * steps - i;
    FORETOUCH_CHECK(pressTo(kPressStep * depth));
    lookAtPress(wall, lastPush, tally);
    if (i != steps) continue;
    const Avatar avatar = figure();
    for (std::size_t link = 0; link < wall.tick().linkDeviation.size(); ++link) {
      const RightArm& right = wall.right();
      if (link == right.arm || link == right.foreArm || link == right.hand) continue;
      tally.otherLinks = std::max(tally.otherLinks, wall.tick().linkDeviation[link]);
    }
    tally.head = wall.tick().linkDeviation[slotOf(*avatar.skeleton().find("Head"))];
  }
  tally.way = wall.way();
  return tally;
}

}  // namespace foretouch::tools
