// Who carries whom, over all that was said: circles at an instant are refused, others are not, and
// whatever senders say in whatever order, the world goes on.
#include "network/world_stream/carrier_times.h"

#include <algorithm>
#include <functional>
#include <map>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "tests/network/world_stream/small_world.h"

namespace foretouch::test {
namespace {

using Eigen::Vector3d;

/// One body's states, in their order.
class Speaker {
 public:
  Speaker(WorldSolver& solver, BodyNumber body) : solver_(solver), body_(body) {}
  Reject say(BodyNumber carrier, std::int64_t sinceUs, std::int64_t receiptUs) {
    BodyMessage message = ballMessage(body_, sequence_++);
    message.carrier = carrier;
    message.pose.translation = {1.0 * body_, 1.0, 0.0};
    message.movesInFrame = carrier != kNoBody;
    message.sinceUs = sinceUs;
    return solver_.take(message, receiptUs);
  }

 private:
  WorldSolver& solver_;
  BodyNumber body_;
  std::int64_t sequence_ = 0;
};

TEST(CarrierTimes, TwoMayCarryEachOtherOneAfterTheOther) {
  WorldSolver solver = WorldSolver::make(smallWorld(), {}).value();
  Speaker lid(solver, 1), pot(solver, 2);
  ASSERT_EQ(lid.say(kNoBody, kStart, kStart), Reject::None);
  ASSERT_EQ(pot.say(kNoBody, kStart, kStart), Reject::None);
  EXPECT_EQ(lid.say(2, tick(10), kStart), Reject::None);
  EXPECT_EQ(pot.say(1, tick(12), kStart), Reject::CarrierLoop) << "the lid still hangs on it";
  EXPECT_EQ(lid.say(kNoBody, tick(12), kStart), Reject::None);
  EXPECT_EQ(pot.say(1, tick(11), kStart), Reject::CarrierLoop) << "for a tick";
  EXPECT_EQ(pot.say(1, tick(12), kStart), Reject::None) << "at the very instant";
  EXPECT_EQ(lid.say(2, tick(20), kStart), Reject::CarrierLoop);
}

TEST(CarrierTimes, ChainsAreBoundedFromBothEnds) {
  for (const bool isFromBelow : {true, false}) {
    WorldSolver solver = WorldSolver::make(smallWorld(), {}).value();
    std::vector<Speaker> chain;
    for (BodyNumber body = 0; body <= kMostCarriers + 1; ++body) {
      chain.emplace_back(solver, body);
      ASSERT_EQ(chain.back().say(kNoBody, kStart, kStart), Reject::None);
    }
    int taken = 0;
    for (int i = 0; i <= kMostCarriers; ++i) {
      const int body = isFromBelow ? i : kMostCarriers - i;
      const Reject reject = chain[static_cast<std::size_t>(body)].say(body + 1, tick(5), kStart);
      taken += reject == Reject::None ? 1 : 0;
      if (reject != Reject::None) {
        EXPECT_EQ(reject, Reject::Limit);
      }
    }
    EXPECT_EQ(taken, kMostCarriers);
  }
}

/// Two balls, a tick per pose, that carry each other in turn, announced ahead; `isLost` says which
/// poses do not arrive. The truth is that neither ever touches the other.
void handOver(const std::function<bool(std::int64_t)>& isLost) {
  WorldSolver solver = WorldSolver::make(smallWorld(), {}).value();
  ToldWorld told;
  Speaker lid(solver, 1), pot(solver, 2);
  ASSERT_EQ(lid.say(kNoBody, kStart, kStart), Reject::None);
  ASSERT_EQ(pot.say(kNoBody, kStart, kStart), Reject::None);
  for (std::int64_t n = 0; n <= 40; ++n) {
    if (n == 5) {
      ASSERT_EQ(lid.say(2, tick(10), tick(n)), Reject::None);
      ASSERT_EQ(lid.say(kNoBody, tick(12), tick(n)), Reject::None);
      ASSERT_EQ(pot.say(1, tick(13), tick(n)), Reject::None);
    }
    if (isLost(n)) continue;
    const Reject reject = solver.take(
        rigidPoses(n, tick(n), {ballAt(1, {1.0, 1.0, 0.0}), ballAt(2, {2.0, 1.0, 0.0})}, 1),
        tick(n) + 100);
    ASSERT_EQ(reject, Reject::None);
    told.hear(solver);
  }
  EXPECT_GE(solver.counts().answeredUntilUs, tick(39));
  for (const ToldEvent& event : told.events()) {
    if (event.event.kind == EventKind::Enter) {
      EXPECT_TRUE(event.event.isAssumed);
    }
  }
}

TEST(CarrierTimes, AHandOverOfWhichPosesAreLostIsAnswered) {
  handOver([](std::int64_t) { return false; });
  for (std::int64_t from = 4; from < 16; ++from) {
    for (std::int64_t count = 1; count <= 4; ++count) {
      handOver([&](std::int64_t n) { return n >= from && n < from + count; });
    }
  }
}

/// Who hangs on whom at an instant, by the accepted messages alone.
struct SaidCarriers {
  std::map<BodyNumber, std::map<std::int64_t, BodyNumber>> since;  // body, instant
  [[nodiscard]] BodyNumber at(BodyNumber body, std::int64_t us) const {
    const auto found = since.find(body);
    if (found == since.end()) return kNoBody;
    const auto next = found->second.upper_bound(us);
    return next == found->second.begin() ? kNoBody : std::prev(next)->second;
  }
  [[nodiscard]] bool hasCircleFrom(std::int64_t fromUs) const {
    std::vector<std::int64_t> instants{fromUs};
    for (const auto& [body, changes] : since) {
      for (const auto& [us, carrier] : changes) instants.push_back(std::max(us, fromUs));
    }
    for (const std::int64_t us : instants) {
      for (const auto& [body, changes] : since) {
        BodyNumber next = at(body, us);
        for (std::size_t i = 0; next != kNoBody && i <= since.size(); ++i) {
          if (next == body) return true;
          next = at(next, us);
        }
      }
    }
    return false;
  }
};

TEST(CarrierTimes, NoCircleIsAcceptedAndNothingElseIsRefusedAsOne) {
  int circles = 0, accepted = 0;
  for (std::uint32_t seed = 0; seed < 400; ++seed) {
    std::mt19937 random(seed);
    const auto draw = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
    WorldPolicy policy;
    policy.aheadUs = 1'000'000;
    WorldSolver solver = WorldSolver::make(smallWorld(), policy).value();
    std::vector<Speaker> bodies;
    SaidCarriers said;
    for (BodyNumber body = 0; body < 5; ++body) {
      bodies.emplace_back(solver, body);
      ASSERT_EQ(bodies.back().say(kNoBody, kStart, kStart), Reject::None);
      said.since[body][kStart] = kNoBody;
    }
    std::vector<std::int64_t> lastUs(5, kStart);
    for (int i = 0; i < 12; ++i) {
      const int body = draw(5);
      const std::int64_t sinceUs = lastUs[static_cast<std::size_t>(body)] + (1 + draw(5)) * kTick;
      const BodyNumber carrier = draw(3) == 0 ? kNoBody : draw(5);
      SaidCarriers next = said;
      next.since[body][sinceUs] = carrier;
      const Reject reject = bodies[static_cast<std::size_t>(body)].say(carrier, sinceUs, kStart);
      const bool isCircle = carrier == body || next.hasCircleFrom(kStart);
      ASSERT_EQ(reject == Reject::CarrierLoop, isCircle) << "seed " << seed << ", message " << i;
      if (reject != Reject::None) continue;
      said = next;
      lastUs[static_cast<std::size_t>(body)] = sinceUs;
      ++accepted;
    }
    circles += solver.counts().rejects[static_cast<std::size_t>(Reject::CarrierLoop)] > 0 ? 1 : 0;
    // All of it takes effect, pose after pose.
    ToldWorld told;
    for (std::int64_t n = 1; n <= 80; ++n) {
      if (draw(4) == 0) continue;
      std::vector<BodyPose> poses;
      for (BodyNumber body = 0; body < 5; ++body) {
        if (draw(3) != 0)
          poses.push_back(ballAt(body, {3.0 * body, 1.0 * static_cast<double>(n), 0.0}));
      }
      static_cast<void>(solver.take(rigidPoses(n, tick(n), poses), tick(n) + 100));
      told.hear(solver);
    }
    EXPECT_GE(solver.counts().answeredUntilUs, tick(50)) << "seed " << seed;
  }
  EXPECT_GT(circles, 200);
  EXPECT_GT(accepted, 1500);
}

}  // namespace
}  // namespace foretouch::test
