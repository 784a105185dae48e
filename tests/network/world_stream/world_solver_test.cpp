#include "network/world_stream/world_solver.h"

#include <algorithm>
#include <map>

#include <gtest/gtest.h>

#include "tests/network/world_stream/small_world.h"

namespace foretouch::test {
namespace {

using Eigen::Vector3d;

WorldSolver solverOf(std::int32_t avatars = 0, const WorldPolicy& policy = {}) {
  return WorldSolver::make(smallWorld(avatars), policy).value();
}

std::uint64_t refused(const WorldSolver& solver, Reject reason) {
  return solver.counts().rejects[static_cast<std::size_t>(reason)];
}

Reject say(WorldSolver& solver, const RigidPoseMessage& message) {
  return solver.take(message, message.utimeUs + 100);
}

TEST(WorldSolver, TellsEnterAndLeaveOfTwoBallsThatPass) {
  WorldSolver solver = solverOf();
  ToldWorld told;
  ASSERT_EQ(solver.take(ballMessage(7), kStart), Reject::None);
  ASSERT_EQ(solver.take(ballMessage(9), kStart), Reject::None);
  // Nine comes along the x axis at 10 m/s and grazes nothing: centres meet at tick 5.
  for (std::int64_t n = 0; n <= 10; ++n) {
    const double x = 0.1 * static_cast<double>(n) - 0.5;
    ASSERT_EQ(say(solver,
                  rigidPoses(n, tick(n), {ballAt(7, Vector3d::Zero()), ballAt(9, {x, 0.0, 0.0})})),
              Reject::None);
    told.hear(solver);
  }
  const std::vector<ToldEvent> events = told.events();
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].event.kind, EventKind::Enter);
  EXPECT_EQ(events[1].event.kind, EventKind::Leave);
  EXPECT_EQ(events[0].event.a.body, 7);
  EXPECT_EQ(events[0].event.b.body, 9);
  EXPECT_FALSE(events[0].event.isAssumed);
  // They touch while |x| <= 0.2, from tick 3 to tick 7; the tolerance is 1 mm at 10 m/s: 0.1 ms.
  const auto us = [](const ToldEvent& event) {
    return static_cast<double>(event.event.time.us) + event.event.time.fraction;
  };
  EXPECT_LE(us(events[0]), static_cast<double>(tick(3)));
  EXPECT_GE(us(events[0]), static_cast<double>(tick(3)) - 101.0);
  EXPECT_GE(us(events[1]), static_cast<double>(tick(7)));
  EXPECT_LE(us(events[1]), static_cast<double>(tick(7)) + 201.0);
  EXPECT_EQ(told.answers.front().fromUs, tick(0));
  for (std::size_t i = 1; i < told.answers.size(); ++i) {
    EXPECT_EQ(told.answers[i].fromUs, told.answers[i - 1].toUs) << "windows follow one another";
    EXPECT_TRUE(told.answers[i].unknown.empty());
  }
  EXPECT_EQ(told.answers.back().toUs, tick(10));
}

TEST(WorldSolver, GoesOnWithoutOneSilentSenderAmongTen) {
  WorldPolicy policy;
  policy.waitUs = 5 * kTick;
  WorldSolver solver = solverOf(0, policy);
  ToldWorld told;
  for (BodyNumber body = 0; body < 10; ++body) {
    ASSERT_EQ(solver.take(ballMessage(body), kStart), Reject::None);
  }
  for (std::int64_t n = 0; n <= 30; ++n) {
    for (BodyNumber body = 0; body < 10; ++body) {
      if (body == 4 && n > 10) continue;  // falls silent
      const Vector3d place(static_cast<double>(body), 0.0, 0.0);
      ASSERT_EQ(say(solver, rigidPoses(n, tick(n), {ballAt(body, place)}, body + 1)), Reject::None);
      told.hear(solver);
    }
    const std::int64_t answered = solver.counts().answeredUntilUs;
    if (n <= 10) {
      EXPECT_GE(answered, n == 0 ? -1 : tick(n - 1));
    }
    // Nobody is waited for longer than was asked for.
    if (n > 16) {
      EXPECT_GE(answered, tick(n - 6));
    }
  }
  EXPECT_EQ(solver.counts().answeredUntilUs, tick(30));
  EXPECT_EQ(solver.counts().silences, 1U);
  EXPECT_EQ(solver.counts().silent, 1U);
  const EventsMessage& last = told.answers.back();
  ASSERT_EQ(last.unknown.size(), 1U);
  EXPECT_EQ(last.unknown[0].body, 4);
  EXPECT_EQ(last.unknown[0].fromUs, last.fromUs);
  EXPECT_EQ(last.unknown[0].toUs, last.toUs);
  // It comes back: late is refused, new is taken, and what was missed is marked.
  const Vector3d place(4.0, 0.0, 0.0);
  EXPECT_EQ(solver.take(rigidPoses(11, tick(11), {ballAt(4, place)}, 5), tick(30)), Reject::Late);
  EXPECT_EQ(say(solver, rigidPoses(31, tick(31), {ballAt(4, place)}, 5)), Reject::None);
  EXPECT_EQ(solver.counts().gaps, 1U);
}

TEST(WorldSolver, WaitsForEverWhereSilenceMeansSo) {
  WorldPolicy policy;
  policy.whenSilent = WhenSilent::Wait;
  WorldSolver solver = solverOf(0, policy);
  ToldWorld told;
  for (const BodyNumber body : {1, 2}) {
    ASSERT_EQ(solver.take(ballMessage(body), kStart), Reject::None);
    ASSERT_EQ(say(solver, rigidPoses(0, tick(0), {ballAt(body, {0.0, 1.0 * body, 0.0})}, body)),
              Reject::None);
  }
  std::uint64_t taken = 0;
  for (std::int64_t n = 1; n <= 2000; ++n) {
    const Reject reject = say(solver, rigidPoses(n, tick(n), {ballAt(1, {0.0, 1.0, 0.0})}, 1));
    taken += reject == Reject::None ? 1 : 0;
    if (reject != Reject::None) {
      ASSERT_EQ(reject, Reject::Overrun);
    }
    told.hear(solver);
  }
  EXPECT_EQ(solver.counts().answeredUntilUs, -1) << "nobody knows of two what comes next";
  EXPECT_EQ(solver.counts().waitsFor, 2);
  EXPECT_LE(taken, kMostWaitingKnots) << "what waits is bounded";
  EXPECT_EQ(refused(solver, Reject::Overrun), 2000 - taken);
}

TEST(WorldSolver, RefusesByName) {
  WorldPolicy policy;
  policy.maxBodies = 4;
  WorldSolver solver = solverOf(1, policy);
  BodyMessage message = ballMessage(7);
  message.shape = "cube";
  EXPECT_EQ(solver.take(message, kStart), Reject::UnknownShape);
  message = ballMessage(7);
  message.shapeHash = 1;
  EXPECT_EQ(solver.take(message, kStart), Reject::BadHash);
  message.shapeHash = shapeHash(smallWorld().shapes[1]);
  EXPECT_EQ(solver.take(message, kStart), Reject::None);
  EXPECT_EQ(solver.take(message, kStart), Reject::Duplicate);
  EXPECT_EQ(solver.take(ballMessage(7, -1), kStart), Reject::OutOfOrder);
  EXPECT_EQ(solver.take(ballMessage(7, 0, 0), kStart), Reject::OldSession);
  message = ballMessage(8);
  message.carrier = 99;
  EXPECT_EQ(solver.take(message, kStart), Reject::UnknownBody);
  message.carrier = 7;
  EXPECT_EQ(solver.take(message, kStart), Reject::None);
  message = ballMessage(7, 1);
  message.carrier = 8;
  EXPECT_EQ(solver.take(message, kStart), Reject::CarrierLoop);
  EXPECT_EQ(solver.take(ballMessage(1), kStart), Reject::UnknownShape) << "one is an avatar";
  EXPECT_EQ(solver.take(ballMessage(10), kStart), Reject::None);
  EXPECT_EQ(solver.take(ballMessage(11), kStart), Reject::Limit) << "a flood of bodies";

  const Vector3d here = Vector3d::Zero();
  EXPECT_EQ(say(solver, rigidPoses(0, tick(0), {ballAt(50, here)})), Reject::UnknownBody);
  EXPECT_EQ(say(solver, rigidPoses(0, tick(0), {ballAt(8, here)})), Reject::HeldFast);
  EXPECT_EQ(say(solver, rigidPoses(5, tick(0), {ballAt(7, here)})), Reject::None);
  EXPECT_EQ(say(solver, rigidPoses(5, tick(0), {ballAt(7, here)})), Reject::Duplicate);
  EXPECT_EQ(say(solver, rigidPoses(4, tick(1), {ballAt(7, here)})), Reject::OutOfOrder);
  EXPECT_EQ(say(solver, rigidPoses(6, tick(0), {ballAt(7, here)})), Reject::StaleStamp);
  EXPECT_EQ(say(solver, rigidPoses(6, tick(1), {ballAt(7, here)}, 0)), Reject::OldSession);
  EXPECT_EQ(solver.take(rigidPoses(6, tick(1000), {ballAt(7, here)}), tick(1)),
            Reject::FutureStamp);
  const WorldCounts counts = solver.counts();
  EXPECT_EQ(counts.states + counts.rigidPoses, counts.rejected() + 3 + counts.taken);
}

TEST(WorldSolver, MarksWhatRestsOnLostPoses) {
  WorldSolver solver = solverOf();
  ToldWorld told;
  for (const BodyNumber body : {1, 2}) {
    ASSERT_EQ(solver.take(ballMessage(body), kStart), Reject::None);
  }
  for (std::int64_t n = 0; n <= 10; ++n) {
    if (n == 3 || n == 4) continue;  // lost
    const double x = 0.1 * static_cast<double>(n) - 0.5;
    ASSERT_EQ(
        say(solver, rigidPoses(n, tick(n), {ballAt(1, Vector3d::Zero()), ballAt(2, {x, 0, 0})})),
        Reject::None);
    told.hear(solver);
  }
  const std::vector<ToldEvent> events = told.events();
  ASSERT_EQ(events.size(), 2U);
  EXPECT_TRUE(events[0].event.isAssumed) << "nobody knows what was between ticks 2 and 5";
  EXPECT_FALSE(events[1].event.isAssumed);
  EXPECT_EQ(solver.counts().marked, 1U);
  bool isListed = false;
  for (const EventsMessage& answer : told.answers) {
    for (const UnknownPart& part : answer.unknown) {
      isListed = isListed || (part.body == 2 && part.fromUs == tick(2) && part.toUs == tick(5));
    }
  }
  EXPECT_TRUE(isListed);
}

TEST(WorldSolver, BodiesComeAndGoAndAreCarried) {
  WorldSolver solver = solverOf();
  ToldWorld told;
  ASSERT_EQ(solver.take(ballMessage(1), kStart), Reject::None);
  ASSERT_EQ(solver.take(ballMessage(3), kStart), Reject::None);
  const auto move = [&](std::int64_t n, std::vector<BodyPose> bodies) {
    ASSERT_EQ(say(solver, rigidPoses(n, tick(n), std::move(bodies))), Reject::None);
    told.hear(solver);
  };
  const Vector3d far(5.0, 0.0, 0.0);
  for (std::int64_t n = 0; n < 3; ++n) move(n, {ballAt(1, Vector3d::Zero()), ballAt(3, far)});
  // Two comes carried by one, 0.5 m beside it, and one takes it to three.
  BodyMessage carried = ballMessage(2, 0, 2);
  carried.carrier = 1;
  carried.pose.translation = {0.5, 0.0, 0.0};
  carried.sinceUs = tick(4);
  ASSERT_EQ(solver.take(carried, tick(3)), Reject::None);
  for (std::int64_t n = 3; n <= 30; ++n) {
    move(n, {ballAt(1, {0.2 * static_cast<double>(n - 3), 0.0, 0.0}), ballAt(3, far)});
  }
  std::vector<ToldEvent> events = told.events();
  ASSERT_GE(events.size(), 1U);
  EXPECT_EQ(events[0].event.kind, EventKind::Enter);
  EXPECT_EQ(events[0].event.a.body + events[0].event.b.body, 5) << "two meets three first";
  EXPECT_FALSE(events[0].event.isAssumed);
  // It is gone.
  carried.sequence = 1;
  carried.isPresent = false;
  carried.sinceUs = tick(31);
  ASSERT_EQ(solver.take(carried, tick(31)), Reject::None);
  for (std::int64_t n = 31; n <= 33; ++n) move(n, {ballAt(1, Vector3d::Zero()), ballAt(3, far)});
  events = told.events();
  const bool isTold = std::any_of(events.begin(), events.end(), [](const ToldEvent& event) {
    return event.cause == ToldCause::BodyGone && event.event.a.body == 2 &&
           event.event.time.us == tick(31);
  });
  EXPECT_TRUE(isTold);
  EXPECT_FALSE(solver.isThere(2));
  EXPECT_EQ(solver.counts().failures, 0U);
}

// After thousands that came and went a timeline begins anew. The second ball's next pose was told
// by then, and is forgotten: nobody knows where it is, and that is said.
TEST(WorldSolver, ANewTimelineSaysOfWhomItHasForgottenWhereHeIs) {
  constexpr BodyNumber kFirst = 10, kMany = 1000;
  WorldSolver solver = solverOf();
  ToldWorld told;
  ASSERT_EQ(solver.take(ballMessage(1), kStart), Reject::None);
  ASSERT_EQ(solver.take(ballMessage(2), kStart), Reject::None);
  for (const std::int64_t k : {0, 1, 2}) {  // known until 0.4 s, without a gap
    const auto beside = rigidPoses(k, tick(20 * k), {ballAt(2, Vector3d(9.0, 0.0, 0.0))});
    ASSERT_EQ(solver.take(beside, kStart), Reject::None);
  }
  for (std::int64_t n = 0; solver.counts().timelines < 2 && n < 80; ++n) {
    std::vector<BodyPose> poses = {ballAt(1, Vector3d::Zero())};
    for (BodyNumber body = kFirst; n % 4 == 0 && body < kFirst + kMany; ++body) {
      BodyMessage message = ballMessage(body, n);
      message.isPresent = n % 8 == 0;
      message.sinceUs = tick(n);
      message.pose.translation = {0.0, 0.0, static_cast<double>(body)};
      ASSERT_EQ(solver.take(message, tick(n)), Reject::None) << body;
      if (message.isPresent) poses.push_back(ballAt(body, message.pose.translation));
    }
    ASSERT_EQ(say(solver, rigidPoses(n, tick(n), std::move(poses))), Reject::None);
    told.hear(solver);
  }
  ASSERT_EQ(solver.counts().timelines, 2U);
  const EventsMessage& first =
      *std::find_if(told.answers.begin(), told.answers.end(),
                    [](const EventsMessage& answer) { return answer.timeline == 2; });
  const auto isSaid = [&](const UnknownPart& part) {
    return part.body == 2 && part.fromUs <= first.fromUs && part.toUs >= first.toUs;
  };
  EXPECT_TRUE(std::any_of(first.unknown.begin(), first.unknown.end(), isSaid));
}

BodyMessage heldBy(BodyNumber carrier, BodyNumber body, std::int64_t sequence,
                   std::int64_t sinceUs) {
  BodyMessage message = ballMessage(body, sequence, 2);
  message.carrier = carrier;
  message.pose.translation = {0.5, 0.0, 0.0};
  message.sinceUs = sinceUs;
  return message;
}

/// What was listed as unknown of a body.
std::vector<UnknownPart> unknownOf(const ToldWorld& told, BodyNumber body) {
  std::vector<UnknownPart> parts;
  for (const EventsMessage& answer : told.answers) {
    for (const UnknownPart& part : answer.unknown) {
      if (part.body == body) parts.push_back(part);
    }
  }
  return parts;
}

/// Balls one and two with senders of their own; `n` ticks.
class TwoSenders : public testing::Test {
 protected:
  TwoSenders() {
    EXPECT_EQ(solver_.take(ballMessage(1), kStart), Reject::None);
    EXPECT_EQ(solver_.take(ballMessage(2, 0, 2), kStart), Reject::None);
  }
  void move(BodyNumber body, std::int64_t n, double x) {
    const std::int64_t sequence = sequences_[body]++;
    ASSERT_EQ(say(solver_, rigidPoses(sequence, tick(n), {ballAt(body, {x, 0.0, 0.0})}, body)),
              Reject::None);
    told_.hear(solver_);
  }

  WorldSolver solver_ = solverOf();
  ToldWorld told_;
  std::map<BodyNumber, std::int64_t> sequences_;
};

TEST_F(TwoSenders, AnAnnouncedChangeHurriesNobody) {
  for (std::int64_t n = 0; n <= 3; ++n) {
    move(1, n, 0.0);
    move(2, n, 1.0);
  }
  ASSERT_EQ(solver_.take(heldBy(1, 2, 1, tick(8)), tick(3) + 200), Reject::None);
  for (std::int64_t n = 4; n <= 7; ++n) {
    move(1, n, 0.0);
    EXPECT_EQ(solver_.counts().answeredUntilUs, tick(n - 1)) << "two goes on until then";
    move(2, n, 1.0);
  }
  for (std::int64_t n = 8; n <= 12; ++n) move(1, n, 0.0);
  EXPECT_EQ(solver_.counts().answeredUntilUs, tick(12)) << "held fast, it is not waited for";
  for (const UnknownPart& part : unknownOf(told_, 2)) {
    EXPECT_GE(part.fromUs, tick(7));
    EXPECT_LE(part.toUs, tick(8));
  }
}

TEST_F(TwoSenders, WhatWasCarriedUnheardIsUnknown) {
  for (std::int64_t n = 0; n <= 3; ++n) {
    move(1, n, 0.0);
    move(2, n, 1.0);
  }
  // Two was held from tick 3 to tick 6, and nobody said so; its numbers go on.
  BodyMessage free = ballMessage(2, 2, 2);
  free.pose.translation = {0.4, 0.0, 0.0};
  free.sinceUs = tick(6);
  for (std::int64_t n = 4; n <= 6; ++n) move(1, n, 0.0);
  ASSERT_EQ(solver_.take(free, tick(6) + 200), Reject::None);
  for (std::int64_t n = 7; n <= 9; ++n) {
    move(1, n, 0.0);
    move(2, n, 0.4);
  }
  const std::vector<UnknownPart> parts = unknownOf(told_, 2);
  ASSERT_FALSE(parts.empty());
  EXPECT_EQ(parts.front().fromUs, tick(3));
  EXPECT_EQ(parts.back().toUs, tick(6));
}

TEST_F(TwoSenders, AfterALateChangeTheNextPoseTellsWhereItIs) {
  for (std::int64_t n = 0; n <= 5; ++n) {
    move(1, n, 0.0);
    move(2, n, 1.0);
  }
  // It has hung on one since tick 4, and moves there.
  BodyMessage late = heldBy(1, 2, 1, tick(4));
  late.movesInFrame = true;
  ASSERT_EQ(solver_.take(late, tick(5) + 200), Reject::None);
  for (std::int64_t n = 6; n <= 8; ++n) {
    move(1, n, 0.0);
    move(2, n, 0.5);
  }
  EXPECT_EQ(solver_.counts().lateChanges, 1U);
  const std::vector<UnknownPart> parts = unknownOf(told_, 2);
  ASSERT_FALSE(parts.empty());
  EXPECT_EQ(parts.front().fromUs, tick(5));
  EXPECT_EQ(parts.back().toUs, tick(6));
}

TEST_F(TwoSenders, AChangeWhoseCarrierComesTooLateNeverTakesEffect) {
  // Three hung on two where one is, and hangs elsewhere before two says where it is itself.
  for (std::int64_t n = 0; n <= 1; ++n) move(1, n, 0.5);
  ASSERT_EQ(solver_.take(heldBy(2, 3, 0, tick(1)), tick(1) + 200), Reject::None);
  for (std::int64_t n = 2; n <= 4; ++n) move(1, n, 0.5);
  BodyMessage elsewhere = heldBy(2, 3, 1, tick(3));
  elsewhere.pose.translation = {3.0, 0.0, 0.0};
  ASSERT_EQ(solver_.take(elsewhere, tick(4) + 200), Reject::None);
  for (std::int64_t n = 5; n <= 8; ++n) {
    move(2, n, 0.0);
    move(1, n, 0.5);
  }
  ASSERT_GE(solver_.counts().answeredUntilUs, tick(7));
  EXPECT_TRUE(told_.events().empty()) << "nobody knows where it was, and then it is far away";
  const std::vector<UnknownPart> parts = unknownOf(told_, 3);
  ASSERT_FALSE(parts.empty());
  EXPECT_LE(parts.front().fromUs, tick(2));
  EXPECT_GE(parts.back().toUs, tick(5));
}

/// Whether all of that time was listed as unknown of a body, answer by answer.
bool isUnknownThroughout(const ToldWorld& told, BodyNumber body, std::int64_t fromUs,
                         std::int64_t toUs) {
  for (const UnknownPart& part : unknownOf(told, body)) {
    if (part.fromUs <= fromUs) fromUs = std::max(fromUs, part.toUs);
  }
  return fromUs >= toUs;
}

BodyMessage gone(BodyNumber body, std::int64_t session, std::int64_t sinceUs) {
  BodyMessage message = ballMessage(body, 50, session);
  message.isPresent = false;
  message.sinceUs = sinceUs;
  return message;
}

TEST_F(TwoSenders, WhatAGoneBodyCarriedIsUnknownUntilThatIsBack) {
  for (std::int64_t n = 0; n <= 3; ++n) {
    move(1, n, 0.0);
    move(2, n, 9.0);
    if (n == 0) {
      ASSERT_EQ(solver_.take(heldBy(1, 3, 0, tick(1)), tick(0) + 200), Reject::None);
    }
  }
  EXPECT_TRUE(unknownOf(told_, 3).empty());
  ASSERT_EQ(solver_.take(gone(1, 1, tick(4)), tick(3) + 200), Reject::None);
  for (std::int64_t n = 4; n <= 10; ++n) move(2, n, 9.0);
  ASSERT_FALSE(solver_.isThere(1));
  ASSERT_FALSE(unknownOf(told_, 3).empty());
  EXPECT_EQ(unknownOf(told_, 3).front().fromUs, tick(4));
  EXPECT_TRUE(isUnknownThroughout(told_, 3, tick(4), tick(10)));
  // Another of its number comes, at whose side two is: the ball hangs on it again.
  BodyMessage back = ballMessage(1, 0, 7);
  back.sinceUs = tick(11);
  back.pose.translation = {8.4, 0.0, 0.0};
  ASSERT_EQ(solver_.take(back, tick(10) + 200), Reject::None);
  for (std::int64_t n = 11; n <= 14; ++n) {
    move(1, n, 8.4);
    move(2, n, 9.0);
  }
  EXPECT_EQ(unknownOf(told_, 3).back().toUs, tick(11));
  const std::vector<ToldEvent> events = told_.events();
  ASSERT_FALSE(events.empty());
  EXPECT_EQ(events.back().event.kind, EventKind::StartsInside);
  EXPECT_EQ(events.back().event.a.body + events.back().event.b.body, 5);
  EXPECT_EQ(solver_.counts().failures, 0U);
}

TEST_F(TwoSenders, WhatAGoneBodyCarriedIsKnownWhereAnotherCarriesIt) {
  for (std::int64_t n = 0; n <= 3; ++n) {
    move(1, n, 0.0);
    move(2, n, 9.0);
    if (n == 0) {
      ASSERT_EQ(solver_.take(heldBy(1, 3, 0, tick(1)), tick(0) + 200), Reject::None);
    }
  }
  ASSERT_EQ(solver_.take(gone(1, 1, tick(4)), tick(3) + 200), Reject::None);
  ASSERT_EQ(solver_.take(heldBy(2, 3, 1, tick(7)), tick(3) + 200), Reject::None);
  for (std::int64_t n = 4; n <= 10; ++n) move(2, n, 9.0);
  ASSERT_FALSE(unknownOf(told_, 3).empty());
  EXPECT_EQ(unknownOf(told_, 3).front().fromUs, tick(4));
  EXPECT_TRUE(isUnknownThroughout(told_, 3, tick(4), tick(7)));
  EXPECT_EQ(unknownOf(told_, 3).back().toUs, tick(7));
}

// The one that was to take it is gone by then: it is neither where it was nor there.
TEST_F(TwoSenders, AChangeToACarrierThatIsGoneLeavesTheBodyUnknown) {
  for (std::int64_t n = 0; n <= 3; ++n) {
    move(1, n, 0.0);
    move(2, n, 9.0);
    if (n == 0) {
      ASSERT_EQ(solver_.take(heldBy(1, 3, 0, tick(1)), tick(0) + 200), Reject::None);
    }
  }
  ASSERT_EQ(solver_.take(heldBy(2, 3, 1, tick(8)), tick(3) + 200), Reject::None);
  ASSERT_EQ(solver_.take(gone(2, 2, tick(6)), tick(3) + 300), Reject::None);
  for (std::int64_t n = 4; n <= 14; ++n) move(1, n, 0.0);
  ASSERT_FALSE(solver_.isThere(2));
  ASSERT_FALSE(unknownOf(told_, 3).empty());
  EXPECT_EQ(unknownOf(told_, 3).front().fromUs, tick(8));
  EXPECT_TRUE(isUnknownThroughout(told_, 3, tick(8), tick(14)));
}

// Its poses are known beyond the instant at which it goes.
TEST_F(TwoSenders, WhoGoesIsThereUntilThen) {
  for (std::int64_t n = 0; n <= 6; ++n) {
    move(1, n, 0.0);
    if (n <= 2) move(2, n, 5.0);
    if (n == 2) move(2, 20, -50.0);  // at 55 m in 0.18 s, it meets one 16 ms later
  }
  ASSERT_EQ(solver_.take(gone(2, 2, tick(8)), tick(6) + 200), Reject::None);
  for (std::int64_t n = 7; n <= 10; ++n) move(1, n, 0.0);
  bool isGone = false;
  for (const EventsMessage& answer : told_.answers) {
    for (const ToldEvent& event : answer.events) {
      EXPECT_GE(event.event.time.us, answer.fromUs);
      EXPECT_LE(event.event.time.us, answer.toUs);
      EXPECT_FALSE(isGone) << "nothing is told of who is gone";
      isGone = event.cause == ToldCause::BodyGone;
    }
  }
  EXPECT_TRUE(isGone);
}

// A new timeline begins while the ball is with one, and is announced to be with two later.
TEST(WorldSolver, ANewTimelineKnowsWhoCarriesWhatNotWhoWill) {
  constexpr BodyNumber kFirst = 10, kMany = 1000;
  WorldSolver solver = solverOf();
  ToldWorld told;
  for (const BodyNumber body : {1, 2, 4}) {
    ASSERT_EQ(solver.take(ballMessage(body), kStart), Reject::None);
  }
  std::int64_t last = 0;
  for (std::int64_t n = 0; n < last + 4 && n < 84; ++n) {
    std::vector<BodyPose> poses = {ballAt(1, Vector3d::Zero()), ballAt(2, Vector3d(9.0, 0.0, 0.0)),
                                   ballAt(4, Vector3d(0.5, 0.15, 0.0))};
    const bool isOver = solver.counts().timelines == 2;
    if (!isOver) last = n;
    for (BodyNumber body = kFirst; !isOver && n % 4 == 0 && body < kFirst + kMany; ++body) {
      BodyMessage message = ballMessage(body, n);
      message.isPresent = n % 8 == 0;
      message.sinceUs = tick(n);
      message.pose.translation = {0.0, 0.0, static_cast<double>(body)};
      ASSERT_EQ(solver.take(message, tick(n)), Reject::None) << body;
      if (message.isPresent) poses.push_back(ballAt(body, message.pose.translation));
    }
    ASSERT_EQ(say(solver, rigidPoses(n, tick(n), std::move(poses))), Reject::None);
    if (n == 0) {
      ASSERT_EQ(solver.take(heldBy(1, 3, 0, tick(1)), tick(0) + 200), Reject::None);
    }
    if (n == 2) {
      ASSERT_EQ(solver.take(heldBy(2, 3, 1, tick(95)), tick(2) + 200), Reject::None);
    }
    told.hear(solver);
  }
  ASSERT_EQ(solver.counts().timelines, 2U);
  std::size_t touches = 0;
  for (const EventsMessage& answer : told.answers) {
    for (const ToldEvent& event : answer.events) {
      const auto [one, other] = std::minmax(event.event.a.body, event.event.b.body);
      touches += answer.timeline == 2 && one == 3 && other == 4 &&
                 event.event.kind == EventKind::StartsInside;
    }
  }
  EXPECT_EQ(touches, 1U) << "it is still beside one, where it touches four";
}

TEST(WorldSolver, AClockThatIsSetBackBeginsAnewWithTheBodiesThatAreKnown) {
  WorldSolver solver = solverOf();
  ToldWorld told;
  BodyMessage state = ballMessage(1);
  state.sinceUs = tick(0);
  ASSERT_EQ(solver.take(state, tick(0)), Reject::None);
  for (std::int64_t n = 0; n <= 3; ++n) {
    ASSERT_EQ(say(solver, rigidPoses(n, tick(n), {ballAt(1, Vector3d::Zero())})), Reject::None);
    told.hear(solver);
  }
  constexpr std::int64_t kBack = 10'000;  // ticks: 100 s
  state.sequence = 1;
  state.sinceUs = tick(4 - kBack);
  ASSERT_EQ(solver.take(state, tick(4 - kBack)), Reject::None);
  told.hear(solver);
  for (std::int64_t n = 5; n <= 9; ++n) {
    const RigidPoseMessage poses = rigidPoses(n, tick(n - kBack), {ballAt(1, Vector3d::Zero())});
    ASSERT_EQ(say(solver, poses), Reject::None) << n;
    told.hear(solver);
  }
  EXPECT_EQ(solver.counts().answeredUntilUs, tick(9 - kBack));
}

TEST(WorldSolver, AFirstPoseOfTheStatesInstantLeavesNothingUnknown) {
  for (const bool isPoseThere : {true, false}) {
    WorldSolver solver = solverOf();
    ToldWorld told;
    for (const BodyNumber body : {1, 2}) {
      BodyMessage state = ballMessage(body);
      state.sinceUs = tick(0);
      state.pose.translation = {0.0, static_cast<double>(body), 0.0};
      ASSERT_EQ(solver.take(state, tick(0) + 50), Reject::None);
    }
    for (std::int64_t n = isPoseThere ? 0 : 1; n <= 3; ++n) {
      ASSERT_EQ(say(solver, rigidPoses(n, tick(n),
                                       {ballAt(1, {0.0, 1.0, 0.0}), ballAt(2, {0.0, 2.0, 0.0})})),
                Reject::None);
      told.hear(solver);
    }
    EXPECT_EQ(told.answers.front().fromUs, tick(0));
    EXPECT_EQ(unknownOf(told, 1).empty(), isPoseThere);
    EXPECT_EQ(solver.counts().gaps, isPoseThere ? 0U : 2U);
  }
}

}  // namespace
}  // namespace foretouch::test
