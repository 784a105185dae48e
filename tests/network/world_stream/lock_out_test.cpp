// Nobody is locked out: whatever clocks senders have, in whatever order they begin, pause, drift
// and jump, and whoever speaks of what has not happened yet beside them, a body whose sender speaks
// in time is back within the time that anybody is waited for.
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "network/world_stream/world_solver.h"
#include "tests/network/world_stream/small_world.h"

namespace foretouch::test {
namespace {

constexpr std::int64_t kPeriodUs = 16'000, kWaitUs = 200'000, kMostAheadUs = 1'000'000;

/// A sender of one ball, told when to say what.
struct Sender {
  BodyNumber body = 0;
  std::int64_t beginUs = 0;
  std::int64_t lagUs = 0;  ///< From capture, by the sender's clock, to the receipt; below 0: ahead.
  double drift = 0.0;      ///< Of its clock, in seconds per second.
  std::int64_t pauseUs = 0, pauseLengthUs = 0;
  std::int64_t jumpUs = 0, jumpByUs = 0;  ///< At an instant its clock is set.
  std::int64_t nextUs = 0, sequence = 0, session = 1;

  [[nodiscard]] std::int64_t stampAt(std::int64_t nowUs) const {
    const auto drifted = static_cast<std::int64_t>(drift * static_cast<double>(nowUs - kStart));
    return nowUs - lagUs + drifted + (jumpUs > 0 && nowUs >= jumpUs ? jumpByUs : 0);
  }
  [[nodiscard]] bool isPausing(std::int64_t nowUs) const {
    return nowUs >= pauseUs && nowUs < pauseUs + pauseLengthUs;
  }
  /// In time: behind the receipt by less than anybody is waited for, with the next one on its way.
  [[nodiscard]] bool isInTime(std::int64_t nowUs) const {
    const std::int64_t behindUs = nowUs - stampAt(nowUs);
    return behindUs + 2 * kPeriodUs <= kWaitUs && behindUs >= -kMostAheadUs;
  }
};

class Stage {
 public:
  explicit Stage(std::uint32_t seed) : random_(seed) {
    WorldPolicy policy;
    policy.waitUs = kWaitUs;
    policy.aheadUs = kMostAheadUs;
    policy.whenSilent = draw(2) == 0 ? WhenSilent::Undecided : WhenSilent::HoldStill;
    solver_.emplace(WorldSolver::make(smallWorld(), policy).value());
    again_.emplace(WorldSolver::make(smallWorld(), policy).value());
    const int count = 2 + draw(3);
    for (BodyNumber body = 0; body < count; ++body) {
      Sender sender;
      sender.body = body;
      sender.beginUs = sender.nextUs = kStart + draw(1'500'000);
      sender.lagUs = draw(static_cast<int>(kWaitUs - 3 * kPeriodUs)) - draw(2) * 100'000;
      sender.drift = 1e-4 * (draw(200) - 100) * (draw(3) == 0 ? 1.0 : 0.0);
      sender.pauseUs = kStart + draw(3'000'000);
      sender.pauseLengthUs = draw(2) * draw(1'000'000);
      if (draw(4) == 0) {
        sender.jumpUs = kStart + 1'000'000 + draw(1'000'000);
        sender.jumpByUs = draw(300'000) - 150'000;
      }
      senders_.push_back(sender);
    }
    // The last one speaks of what has not happened.
    senders_.back().lagUs = -draw(static_cast<int>(kMostAheadUs));
  }

  void run() {
    std::vector<std::int64_t> goodSinceUs(senders_.size(), -1);
    for (std::int64_t nowUs = kStart; nowUs < kStart + 5'000'000; nowUs += 1000) {
      for (std::size_t i = 0; i < senders_.size(); ++i) {
        Sender& sender = senders_[i];
        if (nowUs < sender.nextUs) continue;
        sender.nextUs = nowUs + kPeriodUs;
        if (sender.isPausing(nowUs)) {
          goodSinceUs[i] = -1;
          continue;
        }
        const bool isAccepted = say(sender, nowUs) == Reject::None;
        if (!sender.isInTime(nowUs)) {
          goodSinceUs[i] = -1;
          continue;
        }
        if (isAccepted || goodSinceUs[i] < 0) goodSinceUs[i] = nowUs;
        // A clock that was set back has said something of later than now, which counts.
        const std::int64_t backUs = std::max<std::int64_t>(0, -sender.jumpByUs);
        const std::int64_t aheadUs = std::max<std::int64_t>(0, -sender.lagUs);
        ASSERT_LE(nowUs - goodSinceUs[i], kWaitUs + backUs + (backUs > 0 ? aheadUs : 0))
            << "body " << i << " is locked out, " << nowUs - kStart << " us after the begin";
        ++(isAccepted ? accepted_ : refused_);
      }
    }
    // Nobody was hurried, or held up.
    for (const EventsMessage& answer : told_.answers) {
      EXPECT_LE(answer.toUs, answer.receiveUtimeUs) << "an answer about what has not happened";
    }
    expectSameAgain();
  }
  [[nodiscard]] int accepted() const { return accepted_; }
  [[nodiscard]] int refused() const { return refused_; }

 private:
  int draw(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }

  Reject say(Sender& sender, std::int64_t nowUs) {
    if (sender.sequence % 60 == 0) {
      BodyMessage state = ballMessage(sender.body, sender.sequence / 60);
      state.sinceUs = std::max<std::int64_t>(1, sender.stampAt(sender.beginUs) - 1);
      if (solver_->take(state, nowUs) == Reject::None) {
        EXPECT_EQ(again_->take(state, nowUs), Reject::None);
        hear(nowUs);
      }
    }
    const RigidPoseMessage message =
        rigidPoses(sender.sequence++, sender.stampAt(nowUs),
                   {ballAt(sender.body, {2.0 * sender.body, 0.0, 0.0})}, 1);
    const Reject reason = solver_->take(message, nowUs);
    // What a replay has.
    if (reason == Reject::None || solver_->isNoted()) {
      EXPECT_EQ(again_->take(message, nowUs), reason);
    }
    if (reason == Reject::None) hear(nowUs);
    return reason;
  }

  void hear(std::int64_t nowUs) {
    const std::size_t before = told_.answers.size();
    told_.hear(*solver_);
    for (std::size_t i = before; i < told_.answers.size(); ++i) {
      told_.answers[i].receiveUtimeUs = nowUs;
    }
    toldAgain_.hear(*again_);
  }

  void expectSameAgain() {
    ASSERT_EQ(toldAgain_.answers.size(), told_.answers.size());
    for (std::size_t i = 0; i < told_.answers.size(); ++i) {
      EXPECT_EQ(toldAgain_.answers[i].toUs, told_.answers[i].toUs);
    }
  }

  std::mt19937 random_;
  std::vector<Sender> senders_;
  std::optional<WorldSolver> solver_, again_;
  ToldWorld told_, toldAgain_;
  int accepted_ = 0, refused_ = 0;
};

TEST(LockOut, WhoeverSpeaksInTimeIsBackInTime) {
  int accepted = 0, refused = 0;
  for (std::uint32_t seed = 0; seed < 120; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Stage stage(seed);
    stage.run();
    accepted += stage.accepted();
    refused += stage.refused();
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(accepted, 60'000);
  EXPECT_GT(refused, 300) << "nobody ever came too late";
}

TEST(LockOut, WhoIsRefusedAllTheTimeIsNamed) {
  WorldSolver solver = WorldSolver::make(smallWorld(), {}).value();
  for (const BodyNumber body : {1, 2, 3}) {
    ASSERT_EQ(solver.take(ballMessage(body), kStart), Reject::None);
  }
  ToldWorld told;
  for (std::int64_t n = 1; n <= 100; ++n) {
    ASSERT_EQ(solver.take(rigidPoses(n, tick(n), {ballAt(1, {0.0, 0.0, 0.0})}, 1), tick(n)),
              Reject::None);
    told.hear(solver);
    // Two's clock is ten seconds slow. Three's poses come twice.
    const auto old = rigidPoses(n, tick(n) - 10'000'000, {ballAt(2, {1.0, 0.0, 0.0})}, 2);
    const Reject reason = solver.take(old, tick(n));
    if (n > 1) {
      EXPECT_NE(reason, Reject::None);
    }
    for (int copy = 0; copy < 2; ++copy) {
      static_cast<void>(
          solver.take(rigidPoses(n, tick(n), {ballAt(3, {2.0, 0.0, 0.0})}, 3), tick(n)));
    }
  }
  const WorldCounts counts = solver.counts();
  ASSERT_EQ(counts.refusedBodies, 1U);
  EXPECT_EQ(counts.refusedLongest[0].body, 2);
  EXPECT_EQ(counts.refusedLongest[0].reason, Reject::Late);
  EXPECT_GE(counts.refusedLongest[0].poses, 98U);
  // Its clock is set: nobody is named any more.
  ASSERT_EQ(solver.take(rigidPoses(101, tick(101), {ballAt(2, {1.0, 0.0, 0.0})}, 2), tick(101)),
            Reject::None);
  EXPECT_EQ(solver.counts().refusedBodies, 0U);
}

TEST(LockOut, StrangersCannotFillTheListOfTheRefused) {
  RefusedBodies refused;
  for (BodyNumber body = 0; body < 100'000; ++body) {
    refused.refused(body, Reject::UnknownBody, body * 10);
  }
  for (std::int64_t us = 1'000'000; us <= 2'000'000; us += 10'000) {
    for (BodyNumber body = 5; body < 25; ++body) refused.refused(body, Reject::Late, us);
  }
  std::size_t all = 0;
  const std::vector<RefusedBody> listed = refused.list(all);
  EXPECT_EQ(all, 20U);
  ASSERT_EQ(listed.size(), kMostRefusedListed);
  for (const RefusedBody& body : listed) EXPECT_EQ(body.sinceUs, 1'000'000);
}

}  // namespace
}  // namespace foretouch::test
