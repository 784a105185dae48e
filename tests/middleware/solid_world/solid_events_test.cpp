// A solid hand also tells: what it presses against enters and leaves once, where its shown motion
// meets its skin, by plain arithmetic on what was shown.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "middleware/solid_world/solid_world.h"
#include "middleware/triggers/triggers.h"

namespace foretouch::test {
namespace {

using Eigen::Vector3d;

constexpr double kRadius = 0.05, kSkin = 2e-3, kTolerance = 1e-3;
constexpr std::int64_t kTickUs = 11'111;

Avatar handOf(double radius) {
  RawSkeleton raw;
  raw.joints = {{"hand", kNoParent, Vector3d::Zero(), Quaternion::Identity()}};
  const Lss lss{Vector3d::Zero(), Vector3d::Zero(), radius};
  return Avatar::build(Skeleton::build(raw).value(), {{lss}}).value();
}

Scene boardAt(double z, double half) {
  RawScene raw;
  raw.objectNames = {"board"};
  const Vector3d a(-half, -half, z), b(half, -half, z), c(half, half, z), d(-half, half, z);
  raw.triangles = {{{a, b, c}}, {{a, c, d}}};
  raw.objectOf = {0, 0};
  return Scene::build(raw).value();
}

/// The shown hand at an instant, from the way of each tick.
struct ShownWay {
  std::vector<std::pair<double, Vector3d>> places;  // microseconds
  void add(double us, const Vector3d& place) {
    if (!places.empty() && us <= places.back().first) return;
    places.emplace_back(us, place);
  }
  [[nodiscard]] Vector3d at(double us) const {
    const auto next =
        std::lower_bound(places.begin(), places.end(), us,
                         [](const auto& p, double wanted) { return p.first < wanted; });
    if (next == places.begin()) return next->second;
    if (next == places.end()) return places.back().second;
    const auto& [t1, p1] = *next;
    const auto& [t0, p0] = *std::prev(next);
    return p0 + (us - t0) / (t1 - t0) * (p1 - p0);
  }
};

/// Times of day in microseconds at which `gap` comes within `near` and goes beyond `far`.
template <typename Gap>
std::vector<double> crossings(double endUs, double near, double far, const Gap& gap) {
  std::vector<double> times;
  bool isNear = false;
  for (double us = 0; us <= endUs; us += 20.0) {
    const double now = gap(us);
    if (isNear ? now > far : now <= near) {
      isNear = !isNear;
      times.push_back(us);
    }
  }
  return times;
}

struct Told {
  std::vector<WorldEvent> events;
  [[nodiscard]] std::vector<WorldEvent> of(BodyId a, BodyId b) const {
    std::vector<WorldEvent> own;
    for (const WorldEvent& event : events) {
      const bool isBoth =
          (event.a.body == a && event.b.body == b) || (event.a.body == b && event.b.body == a);
      if (isBoth) own.push_back(event);
    }
    return own;
  }
};

/// Enter and leave, in turns, at the instants of `times` as the shown way has them.
void expectTold(const std::vector<WorldEvent>& events, const std::vector<double>& times,
                double slackUs) {
  ASSERT_EQ(events.size(), times.size());
  for (std::size_t i = 0; i < events.size(); ++i) {
    EXPECT_EQ(events[i].kind, i % 2 == 0 ? EventKind::Enter : EventKind::Leave) << i;
    EXPECT_NEAR(microsecondsAfter(0, events[i].time), times[i], slackUs) << i;
  }
}

class SolidHand : public testing::Test {
 protected:
  void build(const Scene& room) {
    WorldOptions options;
    options.tolerance = kTolerance;
    world_.emplace(SolidWorld::build(room, 0, options).value());
    SolidOptions solid;
    solid.skin = kSkin;
    hand_ = world_->add(handOf(kRadius), solid).value();
  }
  /// One tick to the target; what happens is told.
  void tick(const Vector3d& target) {
    Pose pose{{Quaternion::Identity()}, {target}};
    const std::int64_t toUs = world_->utimeUs() + kTickUs;
    ASSERT_TRUE(world_->tick(toUs, {{hand_, &pose, nullptr}}, ticks_).ok());
    const SolidTick& own = ticks_[0].tick;
    for (std::size_t i = 0; i < own.numWay; ++i) {
      const double share = own.times[i];
      way_.add(static_cast<double>(toUs - kTickUs) + share * kTickUs, own.way[i].translations[0]);
    }
    way_.add(static_cast<double>(toUs), own.shown.translations[0]);
    ASSERT_TRUE(world_->follow(events_).ok());
    told_.events.insert(told_.events.end(), events_.events.begin(), events_.events.end());
    if (triggers_.numTriggers() > 0) {
      ASSERT_TRUE(triggers_.update(world_->world(), events_, triggered_).ok());
      inside_.insert(inside_.end(), triggered_.events.begin(), triggered_.events.end());
    }
    expectPressedIsOpen();
    world_->world().forgetBefore(toUs - kTickUs);
  }
  /// State beside events: what presses on it now is in contact with it now, since some instant.
  void expectPressedIsOpen() {
    const auto expectOpen = [&](BodyId other, double push) {
      if (!(push > 0.0)) return;
      ++pressed_;
      const std::vector<OpenPart>& open = world_->follower().open();
      const auto isIt = [&](const OpenPart& part) {
        return (part.a.body == hand_ && part.b.body == other) ||
               (part.a.body == other && part.b.body == hand_);
      };
      const auto part = std::find_if(open.begin(), open.end(), isIt);
      ASSERT_NE(part, open.end()) << "pressed by " << other << " at " << world_->utimeUs();
      EXPECT_FALSE(WorldTime{world_->utimeUs()} < part->since);
    };
    for (const SolidContact& held : ticks_[0].tick.contacts) expectOpen(kStillScene, held.push);
    for (const SolidBodyContact& held : ticks_[0].contacts) expectOpen(held.body, held.push);
  }
  [[nodiscard]] double endUs() const { return static_cast<double>(world_->utimeUs()); }

  std::optional<SolidWorld> world_;
  BodyId hand_ = 0;
  std::vector<SolidBodyTick> ticks_;
  WorldEvents events_;
  int pressed_ = 0;  // so many pushes of single contacts were looked at
  ShownWay way_;
  Told told_;
  Triggers triggers_;
  TriggerEvents triggered_;
  std::vector<TriggerEvent> inside_;
};

TEST_F(SolidHand, EntersAWallThatStopsItAndLeavesIt) {
  build(boardAt(-1.0, 3.0));
  // Towards the wall, 0.3 m deep into it for half a second, and back.
  for (int i = 0; i < 180; ++i) {
    const double z = i < 60 ? -0.02 * i : i < 110 ? -1.2 : -1.2 + 0.02 * (i - 110);
    tick({0.0, 1.0, std::max(z, -1.3)});
  }
  EXPECT_GT(way_.at(1e6).z(), -1.0 + kRadius) << "it is stopped";
  const auto gap = [&](double us) { return way_.at(us).z() + 1.0 - kRadius - kSkin; };
  const std::vector<double> times = crossings(endUs(), kTolerance, kTolerance, gap);
  ASSERT_EQ(times.size(), 2U);
  EXPECT_GT(times[1] - times[0], 400'000.0);
  // At 2 m/s the tolerance is half a millisecond; a contact may last until twice the tolerance.
  expectTold(told_.of(hand_, kStillScene), times, 1'500.0);
  EXPECT_GT(pressed_, 40);
}

TEST_F(SolidHand, EntersAndLeavesWhatMoves) {
  build(boardAt(-5.0, 1.0));
  const BodyId lift = world_->world().add(boardAt(0.0, 1.0)).value();
  const auto liftAt = [](double us) { return -1.0 + 0.4 * std::sin(3e-6 * us); };
  const auto poseAt = [&](std::int64_t us) {
    return RigidPose{Quaternion::Identity(), Vector3d(0, 0, liftAt(static_cast<double>(us)))};
  };
  ASSERT_TRUE(world_->world().push(lift, 0, poseAt(0)).ok());
  // The hand stays where the board comes and goes.
  for (int i = 0; i < 360; ++i) {
    ASSERT_TRUE(world_->world()
                    .push(lift, world_->utimeUs() + kTickUs, poseAt(world_->utimeUs() + kTickUs))
                    .ok());
    tick({0.0, 0.0, -0.75});
  }
  const auto boardZ = [&](double us) {  // linear from tick to tick
    const double tick = std::floor(us / kTickUs), t = us / kTickUs - tick;
    return (1.0 - t) * liftAt(tick * kTickUs) + t * liftAt((tick + 1.0) * kTickUs);
  };
  const auto gap = [&](double us) { return way_.at(us).z() - boardZ(us) - kRadius - kSkin; };
  const std::vector<double> near = crossings(endUs() - 1.0, kTolerance, 2 * kTolerance, gap);
  ASSERT_GE(near.size(), 3U);
  std::vector<WorldEvent> events = told_.of(hand_, lift);
  expectTold(events, near, 8'000.0);
  EXPECT_GT(pressed_, 40);
}

TEST_F(SolidHand, GoesThroughVolumesThatTellOfIt) {
  build(boardAt(-1.0, 3.0));
  // One that stands in its way, and one that it carries.
  const TriggerId zone = triggers_.add(world_->world(), TriggerVolume::sphere(0.2).value()).value();
  const TriggerId about =
      triggers_.add(world_->world(), TriggerVolume::sphere(0.3).value()).value();
  ASSERT_TRUE(triggers_.stand(world_->world(), zone, 0, {}).ok());
  const RigidPose inHand{Quaternion::Identity(), Vector3d(0.4, 0, 0)};
  tick({0.0, 0.0, 1.0});
  const std::int64_t taken = world_->utimeUs();
  ASSERT_TRUE(world_->world().attach(triggers_.body(about), {hand_, 0, false}, taken, inHand).ok());
  for (int i = 1; i <= 150; ++i) {
    const Vector3d target(0.0, 0.0, 1.0 - 0.0125 * i);  // from 1 m before the zone to 0.875 behind
    tick(target);
    EXPECT_TRUE(ticks_[0].tools.empty());
    EXPECT_EQ(ticks_[0].tick.shown.translations[0], target) << i;
  }
  std::vector<TriggerEvent> ofZone;
  for (const TriggerEvent& event : inside_) {
    if (event.trigger == zone && event.body == hand_) ofZone.push_back(event);
  }
  const auto gap = [&](double us) { return std::abs(way_.at(us).z()) - 0.2 - kRadius - kSkin; };
  const std::vector<double> times = crossings(endUs(), 0.0, 0.0, gap);
  ASSERT_EQ(times.size(), 2U);
  ASSERT_EQ(ofZone.size(), 2U);
  EXPECT_EQ(ofZone[0].kind, EventKind::Enter);
  EXPECT_EQ(ofZone[1].kind, EventKind::Leave);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(microsecondsAfter(0, ofZone[i].time), times[i], 3'000.0);
  }
}

TEST_F(SolidHand, OrdinaryBodiesAreToldBesideIt) {
  build(boardAt(-1.0, 3.0));
  const BodyId ball = world_->world().add(handOf(0.1)).value();
  const auto ballAt = [](std::int64_t us) {
    const double z = 1.0 - 2e-6 * static_cast<double>(us);  // at 2 m/s through the board
    return RigidPose{Quaternion::Identity(), Vector3d(1.0, 0.0, z)};
  };
  ASSERT_TRUE(world_->world().push(ball, 0, ballAt(0)).ok());
  for (int i = 0; i < 120; ++i) {
    const std::int64_t toUs = world_->utimeUs() + kTickUs;
    ASSERT_TRUE(world_->world().push(ball, toUs, ballAt(toUs)).ok());
    tick({0.0, 0.0, 0.0});
  }
  EXPECT_TRUE(told_.of(hand_, kStillScene).empty());
  const std::vector<WorldEvent> events = told_.of(ball, kStillScene);
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].kind, EventKind::Enter);
  EXPECT_NEAR(microsecondsAfter(0, events[0].time), 950'000.0, 600.0) << "without a skin";
  EXPECT_EQ(events[1].kind, EventKind::Leave);
  EXPECT_NEAR(microsecondsAfter(0, events[1].time), 1'050'000.0, 1'200.0);
}

TEST_F(SolidHand, TheFirstTickMayNotBeEmpty) {
  build(boardAt(-1.0, 3.0));
  EXPECT_TRUE(world_->follow(events_).ok()) << "nothing has happened yet";
  EXPECT_TRUE(events_.events.empty());
}

}  // namespace
}  // namespace foretouch::test
