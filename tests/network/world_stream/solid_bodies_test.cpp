// Solid bodies of a live world: what they show, what they enter, press against and leave, by plain
// arithmetic on what was shown; and what streams that are lost, late or hostile do to them.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "tests/network/world_stream/small_world.h"
#include "tests/support/random_geometry.h"

namespace foretouch::test {
namespace {

using Eigen::Vector3d;

constexpr double kSkin = 2e-3, kTolerance = 1e-3;
constexpr BodyNumber kFist = 1, kBall = 7;

/// A wall at x = 1; avatar 1, a ball of 10 cm, is solid.
WorldSetup fistWorld() {
  WorldSetup setup;
  setup.still = farWall();
  setup.options.tolerance = kTolerance;
  setup.shapes.push_back({"fist", ball(), std::nullopt, 0, std::nullopt});
  setup.shapes.push_back({"ball", ball(), std::nullopt, 0, std::nullopt});
  SolidOptions solid;
  solid.skin = kSkin;
  setup.avatars.push_back({kFist, 0, solid});
  return setup;
}

/// Links that are asked about each other.
Avatar ballsInARow() {
  RawSkeleton raw;
  for (JointId i = 0; i < 4; ++i) {
    raw.joints.push_back(
        {"ball" + std::to_string(i), i - 1, {0.0, 1.0, 0.0}, Quaternion::Identity()});
  }
  const Lss lss{Vector3d::Zero(), Vector3d::Zero(), kBallRadius};
  return Avatar::build(Skeleton::build(raw).value(), {{lss}, {lss}, {lss}, {lss}}).value();
}

/// Where the shown fist is, by what was sent.
struct ShownWay {
  std::vector<std::pair<double, Vector3d>> places;  // microseconds
  void add(const SolidMessage& message) {
    for (std::size_t i = 0; i < message.way.size(); ++i) {
      const double share =
          message.way.size() == 1 && message.times[0] == 0.0 ? 1.0 : message.times[i];
      const double us = static_cast<double>(message.utimeUs - message.stepUs) +
                        share * static_cast<double>(message.stepUs);
      places.emplace_back(us, message.way[i].translations[0]);
    }
  }
  [[nodiscard]] Vector3d at(double us) const {
    const auto next =
        std::lower_bound(places.begin(), places.end(), us,
                         [](const auto& place, double wanted) { return place.first < wanted; });
    if (next == places.begin()) return next->second;
    if (next == places.end()) return places.back().second;
    const auto& [t1, p1] = *next;
    const auto& [t0, p0] = *std::prev(next);
    return t1 > t0 ? Vector3d(p0 + (us - t0) / (t1 - t0) * (p1 - p0)) : p1;
  }
};

class SolidBodiesTest : public testing::Test {
 protected:
  void build(const WorldPolicy& policy = {}) {
    solver_.emplace(WorldSolver::make(fistWorld(), policy).value());
  }
  /// The fist's next pose; what is not known: its only joint.
  Reject reach(std::int64_t utimeUs, const Vector3d& place,
               UndecidedReason unknown = UndecidedReason::None,
               StepKind kind = StepKind::Consecutive) {
    to_ = {{Quaternion::Identity()}, {place}};
    unknown_.assign(1, unknown);
    StreamStep step;
    step.kind = sequence_ == 0 ? StepKind::First : kind;
    step.session = 5;
    step.sequenceTo = ++sequence_;
    step.utimeFromUs = lastUs_;
    step.utimeToUs = lastUs_ = utimeUs;
    step.from = step.to = &to_;
    step.unknown = step.unknownJoints = &unknown_;
    const Reject reason = solver_->take(kFist, step, utimeUs + 100);
    hear();
    return reason;
  }
  Reject throwBall(std::int64_t n, std::int64_t utimeUs, const Vector3d& place) {
    const Reject reason =
        solver_->take(rigidPoses(n, utimeUs, {ballAt(kBall, place)}), utimeUs + 100);
    hear();
    return reason;
  }
  void hear() {
    told_.hear(*solver_);
    for (const ShownBody& body : solver_->shown()) {
      way_.add(body.solid);
      shown_.push_back(body);
      // What is sent can be read.
      Bytes payload;
      encode(body.solid, payload);
      SolidMessage solid;
      EXPECT_EQ(decode(payload, solid), Reject::None);
      encode(body.pushes, payload);
      PushesMessage pushes;
      EXPECT_EQ(decode(payload, pushes), Reject::None);
    }
  }
  [[nodiscard]] std::vector<WorldEvent> eventsWith(BodyId other) const {
    std::vector<WorldEvent> found;
    for (const ToldEvent& told : told_.events()) {
      const WorldEvent& event = told.event;
      const bool isOf = (event.a.body == kFist && event.b.body == other) ||
                        (event.b.body == kFist && event.a.body == other);
      if (isOf) found.push_back(event);
    }
    return found;
  }
  static double usOf(const WorldTime& time) { return static_cast<double>(time.us) + time.fraction; }

  std::optional<WorldSolver> solver_;
  ToldWorld told_;
  std::vector<ShownBody> shown_;
  ShownWay way_;
  Pose to_;
  std::vector<UndecidedReason> unknown_;
  std::int64_t sequence_ = 0, lastUs_ = 0;
};

TEST_F(SolidBodiesTest, EntersStaysAtAndLeavesAWallWhereItsSkinDoes) {
  build();
  const auto tracked = [](std::int64_t n) {
    return 0.5 + 0.7 * std::sin(M_PI * static_cast<double>(n) / 100.0);
  };
  for (std::int64_t n = 0; n <= 100; ++n) {
    ASSERT_EQ(reach(tick(n), {tracked(n), 1.0, 0.0}), Reject::None);
  }
  const auto gap = [&](double us) { return 1.0 - kBallRadius - way_.at(us).x(); };
  const std::vector<WorldEvent> events = eventsWith(kStillScene);
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].kind, EventKind::Enter);
  EXPECT_EQ(events[1].kind, EventKind::Leave);
  // In contact from the skin and the tolerance on; free at twice the tolerance at the latest.
  EXPECT_GE(gap(usOf(events[0].time) - 1.0), kSkin - 1e-6);
  EXPECT_LE(gap(usOf(events[0].time)), kSkin + kTolerance + 1e-6);
  EXPECT_LE(gap(usOf(events[1].time)), kSkin + 2.0 * kTolerance + 1e-6);
  EXPECT_GE(gap(usOf(events[1].time) + 1.0), kSkin + kTolerance - 1e-6);
  int stays = 0;
  for (const ShownBody& body : shown_) {
    EXPECT_TRUE(body.solid.isCertified) << "at " << body.solid.utimeUs;
    EXPECT_GT(gap(static_cast<double>(body.solid.utimeUs)), 0.0);
    for (const ShownContact& contact : body.solid.contacts) {
      EXPECT_EQ(contact.otherName, "wall");
      EXPECT_GT(contact.contact.push, 0.0);
      const auto us = static_cast<double>(body.solid.utimeUs);
      EXPECT_TRUE(us >= usOf(events[0].time) && us <= usOf(events[1].time) + kTick)
          << "it presses between enter and leave";
      ++stays;
    }
  }
  EXPECT_GT(stays, 30);
  EXPECT_EQ(told_.answers.back().toUs, tick(100));
}

TEST_F(SolidBodiesTest, ShowsItsTrackedPosesBitForBitWhileItIsFree) {
  build();
  ASSERT_EQ(solver_->take(ballMessage(kBall), kStart), Reject::None);
  // The ball is told of less often: an advance of the watermark has several poses of the fist.
  for (std::int64_t n = 0; n <= 40; ++n) {
    ASSERT_EQ(reach(tick(n), {0.01 * static_cast<double>(n) / 3.0, 1.0, 0.0}), Reject::None);
    if (n % 4 != 0) continue;
    ASSERT_EQ(throwBall(n / 4, tick(n), {-3.0, 1.0, 0.0}), Reject::None);
  }
  ASSERT_EQ(shown_.size(), 40U);
  for (std::size_t i = 0; i < shown_.size(); ++i) {
    const SolidMessage& message = shown_[i].solid;
    const auto n = static_cast<std::int64_t>(i) + 1;
    EXPECT_EQ(message.utimeUs, tick(n));
    EXPECT_EQ(message.sequence, n + 1);
    EXPECT_EQ(message.session, 5);
    EXPECT_EQ(message.stepUs, kTick);
    EXPECT_EQ(message.kind, i == 0 ? StepKind::First : StepKind::Consecutive);
    EXPECT_EQ(message.state, SolidState::Equal);
    EXPECT_EQ(message.shown().translations[0].x(), 0.01 * static_cast<double>(n) / 3.0);
    EXPECT_TRUE(shown_[i].pushes.contacts.empty());
    EXPECT_EQ(shown_[i].pushes.utimeUs, message.utimeUs);
    EXPECT_EQ(shown_[i].pushes.sequence, message.sequence);
  }
  EXPECT_TRUE(told_.events().empty());
}

TEST_F(SolidBodiesTest, IsPushedByWhatMovesFromEnterToLeave) {
  build();
  ASSERT_EQ(solver_->take(ballMessage(kBall), kStart), Reject::None);
  const auto ballX = [](double n) { return -0.6 + 0.5 * std::sin(M_PI * n / 100.0); };
  for (std::int64_t n = 0; n <= 100; ++n) {
    ASSERT_EQ(reach(tick(n), {0.0, 1.0, 0.0}), Reject::None);
    ASSERT_EQ(throwBall(n, tick(n), {ballX(static_cast<double>(n)), 1.0, 0.0}), Reject::None);
  }
  const auto gap = [&](double us) {
    const double n = (us - static_cast<double>(kStart)) / kTick, i = std::floor(n);
    const double x = ballX(i) + (n - i) * (ballX(i + 1.0) - ballX(i));
    return (way_.at(us) - Vector3d(x, 1.0, 0.0)).norm() - 2.0 * kBallRadius;
  };
  const std::vector<WorldEvent> events = eventsWith(kBall);
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].kind, EventKind::Enter);
  EXPECT_EQ(events[1].kind, EventKind::Leave);
  EXPECT_GE(gap(usOf(events[0].time) - 1.0), kSkin - 1e-5);
  EXPECT_LE(gap(usOf(events[0].time)), kSkin + kTolerance + 1e-5);
  EXPECT_LE(gap(usOf(events[1].time)), kSkin + 2.0 * kTolerance + 1e-5);
  int stays = 0;
  double farthest = 0.0;
  for (const ShownBody& body : shown_) {
    EXPECT_TRUE(body.solid.isCertified);
    EXPECT_GT(gap(static_cast<double>(body.solid.utimeUs)), 0.0);
    farthest = std::max(farthest, body.solid.shown().translations[0].x());
    for (const ToldPush& told : body.pushes.contacts) {
      EXPECT_EQ(told.contact.body, kBall);
      EXPECT_EQ(told.linkName, "ball");
      EXPECT_GT(told.contact.push, 0.0);
      // It comes along the normal: nothing slips.
      EXPECT_LT(told.contact.slipSpeed, 1e-3);
      EXPECT_GT(told.contact.nhat_W.x(), 0.99);
      ++stays;
    }
  }
  EXPECT_GT(stays, 20);
  EXPECT_GT(farthest, 0.09) << "the ball comes to 10 cm before the place that is tracked";
}

TEST_F(SolidBodiesTest, SaysHowFastWhatMovesSlipsAlongIt) {
  build();
  ASSERT_EQ(solver_->take(ballMessage(kBall), kStart), Reject::None);
  // The fist presses against a ball from above, which turns about its middle with 2 rad/s.
  int slips = 0;
  for (std::int64_t n = 0; n <= 60; ++n) {
    const double y = 1.0 - 0.1 * std::min(1.0, static_cast<double>(n) / 20.0);
    ASSERT_EQ(reach(tick(n), {0.0, y, 0.0}), Reject::None);
    BodyPose pose = ballAt(kBall, {0.0, 0.75, 0.0});
    const double angle = 2.0 * 1e-6 * static_cast<double>(n * kTick);
    pose.pose.rotation = Quaternion(Eigen::AngleAxisd(angle, Vector3d::UnitZ()));
    ASSERT_EQ(solver_->take(rigidPoses(n, tick(n), {pose}), tick(n) + 100), Reject::None);
    hear();
  }
  for (const ShownBody& body : shown_) {
    if (body.solid.utimeUs < tick(40)) continue;
    for (const ToldPush& told : body.pushes.contacts) {
      EXPECT_NEAR(told.contact.slipSpeed, 2.0 * kBallRadius, 1e-3);
      ++slips;
    }
  }
  EXPECT_GT(slips, 15);
}

TEST_F(SolidBodiesTest, IsCrushedBetweenAWallAndWhatMoves) {
  build();
  ASSERT_EQ(solver_->take(ballMessage(kBall), kStart), Reject::None);
  // The fist is at the wall; a ball goes through where it is, and away.
  for (std::int64_t n = 0; n <= 120; ++n) {
    const double x = 0.2 + 0.55 * std::sin(M_PI * static_cast<double>(n) / 120.0);
    ASSERT_EQ(reach(tick(n), {0.89, 1.0, 0.0}), Reject::None);
    ASSERT_EQ(throwBall(n, tick(n), {x, 1.0, 0.0}), Reject::None);
  }
  int crushed = 0, over = 0;
  for (const ShownBody& body : shown_) {
    for (const ToldCrush& told : body.pushes.crushes) {
      EXPECT_EQ(told.crush.body, kBall);
      EXPECT_LE(told.crush.sinceUs, body.pushes.utimeUs);
      over += told.crush.isOver ? 1 : 0;
      if (told.crush.isOver) continue;
      EXPECT_FALSE(body.solid.isCertified);
      ++crushed;
    }
    EXPECT_LT(body.solid.shown().translations[0].x(), 1.0 - kBallRadius) << "not in the wall";
  }
  EXPECT_GT(crushed, 5);
  EXPECT_EQ(over, 1);
}

TEST_F(SolidBodiesTest, CarriesNothing) {
  build();
  ASSERT_EQ(reach(tick(0), {0.0, 1.0, 0.0}), Reject::None);
  BodyMessage held = ballMessage(kBall);
  held.carrier = kFist;
  EXPECT_EQ(solver_->take(held, tick(0)), Reject::SolidCarrier);
  held.movesInFrame = true;
  EXPECT_EQ(solver_->take(held, tick(0)), Reject::SolidCarrier);
  EXPECT_FALSE(solver_->isThere(kBall));
  EXPECT_EQ(std::string(toString(Reject::SolidCarrier)), "solid-carrier");
}

TEST_F(SolidBodiesTest, HasNoPlaceBeforeItsRootIsTracked) {
  build();
  for (std::int64_t n = 0; n <= 10; ++n) {
    const auto unknown = n < 5 ? UndecidedReason::StaleJoint : UndecidedReason::None;
    ASSERT_EQ(reach(tick(n), {0.0, 1.0, 0.0}, unknown), Reject::None);
  }
  ASSERT_EQ(shown_.size(), 10U);
  for (std::size_t i = 0; i < shown_.size(); ++i) {
    const bool isPlaced = shown_[i].solid.utimeUs >= tick(5);
    EXPECT_EQ(shown_[i].solid.state == SolidState::Placing, !isPlaced) << i;
    EXPECT_EQ(shown_[i].solid.isCertified, isPlaced) << i;
  }
  // Nothing is claimed of it until then.
  bool isListed = false;
  for (const EventsMessage& answer : told_.answers) {
    for (const UnknownPart& part : answer.unknown) {
      isListed = isListed || (part.body == kFist && part.link == kEveryLink);
    }
  }
  EXPECT_TRUE(isListed);
}

TEST_F(SolidBodiesTest, AppearsBesideWhatItsFirstPoseIsIn) {
  build();
  for (std::int64_t n = 0; n <= 5; ++n) {
    ASSERT_EQ(reach(tick(n), {1.02, 1.0, 0.0}), Reject::None);
  }
  ASSERT_FALSE(shown_.empty());
  EXPECT_TRUE(shown_.front().solid.hasAppeared);
  EXPECT_NE(shown_.front().solid.state, SolidState::Placing);
  EXPECT_GE(std::abs(shown_.front().solid.shown().translations[0].x() - 1.0), kBallRadius);
}

TEST_F(SolidBodiesTest, StaysWhereItWasWhileNobodySpeaksForIt) {
  WorldPolicy policy;
  policy.waitUs = 5 * kTick;
  build(policy);
  ASSERT_EQ(solver_->take(ballMessage(kBall), kStart), Reject::None);
  for (std::int64_t n = 0; n <= 60; ++n) {
    if (n <= 20 || n >= 50) {
      const auto kind = n == 50 ? StepKind::AcrossGap : StepKind::Consecutive;
      const double x = n <= 20 ? 0.0 : 0.3;
      ASSERT_EQ(reach(tick(n), {x, 1.0, 0.0}, UndecidedReason::None, kind), Reject::None);
    }
    ASSERT_EQ(throwBall(n, tick(n), {-3.0, 1.0, 0.0}), Reject::None);
  }
  EXPECT_EQ(solver_->counts().timelines, 1U);
  EXPECT_EQ(solver_->counts().failures, 0U);
  Vector3d last = Vector3d::Zero();
  bool isGap = false;
  for (const ShownBody& body : shown_) {
    const SolidMessage& message = body.solid;
    isGap = isGap || message.kind == StepKind::AcrossGap;
    if (message.utimeUs > tick(20) && message.utimeUs < tick(44)) {
      EXPECT_EQ(message.shown().translations[0].x(), 0.0);
    }
    // By a proven way, whatever was missed.
    EXPECT_FALSE(message.hasAppeared && message.utimeUs > tick(1));
    EXPECT_TRUE(message.isCertified);
    last = message.shown().translations[0];
  }
  EXPECT_TRUE(isGap);
  EXPECT_EQ(last.x(), 0.3);
}

TEST_F(SolidBodiesTest, OutlivesMinutesInWhichNobodySpeaks) {
  build();
  ASSERT_EQ(reach(tick(0), {0.0, 1.0, 0.0}), Reject::None);
  ASSERT_EQ(reach(tick(1), {0.0, 1.0, 0.0}), Reject::None);
  for (const std::int64_t minutes : {1, 30}) {
    const std::int64_t us = lastUs_ + minutes * 60'000'000;
    ASSERT_EQ(reach(us, {0.1, 1.0, 0.0}), Reject::None);
    ASSERT_EQ(reach(us + kTick, {0.1, 1.0, 0.0}), Reject::None);
    ASSERT_EQ(reach(us + 2 * kTick, {0.1, 1.0, 0.0}), Reject::None);
    EXPECT_EQ(shown_.back().solid.shown().translations[0].x(), 0.1);
    EXPECT_EQ(told_.answers.back().toUs, us + 2 * kTick);
  }
  EXPECT_EQ(solver_->counts().timelines, 2U) << "half an hour is more than ticks reach";
}

TEST_F(SolidBodiesTest, BoundsItsTicksWhateverSendersDo) {
  build();
  ASSERT_EQ(solver_->take(ballMessage(kBall), kStart), Reject::None);
  ASSERT_EQ(throwBall(0, tick(0), {-3.0, 1.0, 0.0}), Reject::None);
  // 2 kHz, and the watermark waits for the ball.
  for (std::int64_t n = 0; n <= 300; ++n) {
    ASSERT_EQ(reach(kStart + 500 * n, {1e-3 * static_cast<double>(n), 1.0, 0.0}), Reject::None);
  }
  shown_.clear();
  ASSERT_EQ(throwBall(1, kStart + 150'000, {-3.0, 1.0, 0.0}), Reject::None);
  EXPECT_EQ(shown_.size(), kMostTicksPerAdvance);
  EXPECT_EQ(shown_.back().solid.utimeUs, kStart + 150'000);
  EXPECT_EQ(shown_.back().solid.shown().translations[0].x(), 0.3);
}

TEST_F(SolidBodiesTest, RepeatsItselfByteForByte) {
  const auto play = [](WorldSolver& solver, std::vector<Bytes>& sent) {
    std::vector<EventsMessage> answers;
    std::vector<UndecidedReason> known(1, UndecidedReason::None);
    const auto keep = [&](const auto& message) {
      Bytes payload;
      encode(message, payload);
      const ByteView verdict = verdictBytes(payload);
      sent.emplace_back(verdict.data, verdict.data + verdict.size);
    };
    const auto hear = [&] {
      solver.advance(answers);
      for (const ShownBody& body : solver.shown()) {
        keep(body.solid);
        keep(body.pushes);
      }
      for (const EventsMessage& answer : answers) keep(answer);
    };
    ASSERT_EQ(solver.take(ballMessage(kBall), kStart), Reject::None);
    for (std::int64_t n = 0; n <= 80; ++n) {
      const double s = std::sin(0.1 * static_cast<double>(n));
      const Pose pose{{Quaternion::Identity()}, {Vector3d(0.6 + 0.5 * s, 1.0, 0.0)}};
      StreamStep step;
      step.kind = n == 0 ? StepKind::First : StepKind::Consecutive;
      step.sequenceTo = n;
      step.utimeFromUs = tick(std::max<std::int64_t>(0, n - 1));
      step.utimeToUs = tick(n);
      step.from = step.to = &pose;
      step.unknown = step.unknownJoints = &known;
      ASSERT_EQ(solver.take(kFist, step, tick(n) + 100), Reject::None);
      hear();
      if (n % 3 != 0) continue;
      ASSERT_EQ(solver.take(rigidPoses(n / 3, tick(n), {ballAt(kBall, {0.3 - 0.4 * s, 1.0, 0.0})}),
                            tick(n) + 200),
                Reject::None);
      hear();
    }
  };
  WorldSolver one = WorldSolver::make(fistWorld(), {}).value();
  WorldSolver other = WorldSolver::make(fistWorld(), {}).value();
  std::vector<Bytes> first, second;
  play(one, first);
  play(other, second);
  EXPECT_GT(first.size(), 100U);
  EXPECT_EQ(first, second);
}

/// Poses are lost, doubled and late, senders fall silent, balls come and go, hang on one another
/// and would hang on the fist: whatever is sent, what is shown is proven, and on this side of the
/// wall.
TEST_F(SolidBodiesTest, KeepsItsPromisesWhateverIsSent) {
  std::uint64_t refused = 0, carried = 0, pushed = 0, enters = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    WorldPolicy policy;
    policy.waitUs = 40'000 + 1000 * random.below(200);
    policy.whenSilent = random.chance(0.3) ? WhenSilent::HoldStill : WhenSilent::Undecided;
    build(policy);
    shown_.clear();
    told_.answers.clear();
    sequence_ = lastUs_ = 0;
    std::int64_t state = 0;
    for (std::int64_t n = 0; n < 150; ++n) {
      const double s = std::sin(0.07 * static_cast<double>(n) + static_cast<double>(seed));
      const bool isLate = random.chance(0.05);
      const std::int64_t us = tick(n) + random.below(4000) - (isLate ? 100'000 : 0);
      if (random.chance(0.8) && n % 50 < 40) {
        const auto unknown =
            random.chance(0.1) ? UndecidedReason::StaleJoint : UndecidedReason::None;
        const Vector3d place(0.4 + s, 1.0 + 0.2 * random.uniform(-1.0, 1.0), 0.0);
        const Reject reason = reach(us, shown_.empty() ? Vector3d(0.0, 1.0, 0.0) : place, unknown);
        refused += reason == Reject::None ? 0 : 1;
      }
      if (random.chance(0.1)) {
        BodyMessage told = ballMessage(kBall + random.below(2), ++state);
        told.isPresent = random.chance(0.9);
        told.utimeUs = told.sinceUs = tick(n) - random.below(20'000);
        if (told.isPresent && random.chance(0.4)) {
          told.carrier = random.chance(0.5) ? kFist : kBall + kBall + 1 - told.body;
          told.movesInFrame = random.chance(0.5);
        }
        const Reject reason = solver_->take(told, tick(n));
        carried += reason == Reject::SolidCarrier ? 1 : 0;
        EXPECT_TRUE(told.carrier != kFist || reason != Reject::None);
        hear();
      }
      for (int i = 0; i < 2; ++i) {
        if (random.chance(0.3)) continue;
        const Vector3d place(0.6 * s - 0.3 * i, 1.0, 0.3 * random.uniform(-1.0, 1.0));
        const auto poses = rigidPoses(n, us, {ballAt(kBall + i, place)}, i + 1);
        static_cast<void>(solver_->take(poses, tick(n) + 100));
        hear();
        if (random.chance(0.1)) static_cast<void>(solver_->take(poses, tick(n) + 150));
      }
    }
    EXPECT_EQ(solver_->counts().failures, 0U);
    for (const ShownBody& body : shown_) {
      const SolidMessage& message = body.solid;
      pushed += body.pushes.contacts.empty() ? 0 : 1;
      if (message.state == SolidState::Placing) continue;
      EXPECT_TRUE(message.isCertified || !body.pushes.crushes.empty());
      for (const Pose& pose : message.way) {
        EXPECT_LT(pose.translations[0].x(), 1.0 - kBallRadius) << "at " << message.utimeUs;
      }
    }
    for (std::size_t i = 1; i < told_.answers.size(); ++i) {
      EXPECT_EQ(told_.answers[i].fromUs, told_.answers[i - 1].toUs);
    }
    enters += eventsWith(kStillScene).size() + eventsWith(kBall).size();
  }
  EXPECT_GT(refused, 100U);
  EXPECT_GT(carried, 30U);
  EXPECT_GT(pushed, 300U);
  EXPECT_GT(enters, 100U);
}

TEST(SolidBodiesSetup, RefusesByNameWhatItCannotDo) {
  const auto refused = [](auto change) {
    WorldSetup setup = fistWorld();
    change(setup);
    const auto made = WorldSolver::make(std::move(setup), {});
    EXPECT_FALSE(made.ok());
    return made.ok() ? std::string() : describe(made.error());
  };
  const auto has = [](const std::string& text, const char* word) {
    return text.find(word) != std::string::npos;
  };
  EXPECT_TRUE(has(refused([](WorldSetup& setup) { setup.still.reset(); }), "scene"));
  EXPECT_TRUE(
      has(refused([](WorldSetup& setup) { setup.avatars[0].solid->maySnap = true; }), "fist"));
  EXPECT_TRUE(has(refused([](WorldSetup& setup) { setup.avatars[0].solid->skin = -1.0; }), "fist"));
  EXPECT_TRUE(has(refused([](WorldSetup& setup) {
                    setup.shapes[0].avatar = ballsInARow();
                    setup.shapes[0].self = PairRules::derive(*setup.shapes[0].avatar, {}).value();
                  }),
                  "own links"));
  EXPECT_TRUE(
      has(refused([](WorldSetup& setup) { setup.shapes[1].group = kClockGroup; }), "groups"));
  EXPECT_TRUE(has(refused([](WorldSetup& setup) {
                    for (BodyNumber i = 100; setup.avatars.size() <= kMostSolidBodies; ++i) {
                      setup.avatars.push_back({i, 0, SolidOptions{}});
                    }
                  }),
                  "64"));
}

}  // namespace
}  // namespace foretouch::test
