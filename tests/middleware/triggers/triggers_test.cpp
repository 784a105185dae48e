// Who is in a trigger: plain cases by hand, and random worlds before the judge.
#include "middleware/triggers/triggers.h"

#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "middleware/scene/box_triangles.h"
#include "middleware/triggers/presence.h"
#include "tests/middleware/balls.h"
#include "tests/middleware/triggers/both_triggers.h"
#include "tests/middleware/world/random_worlds.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using test::at;
using test::BothTriggers;

constexpr double kTolerance = 1e-4;

Avatar hand(double radius) {
  RawSkeleton raw;
  raw.joints = {{"hand", kNoParent, Vector3d::Zero(), Quaternion::Identity()}};
  return Avatar::build(Skeleton::build(raw).value(),
                       {{{Vector3d(0, -0.05, 0), Vector3d(0, 0.05, 0), radius}}})
      .value();
}

void expectNoProblems(const BothTriggers& both) {
  for (const std::string& problem : both.tally.problems) ADD_FAILURE() << problem;
}

/// "enter 0, leave 0": kinds and triggers, in order.
std::string said(const std::vector<TriggerEvent>& events) {
  std::string all;
  for (const TriggerEvent& event : events) {
    all += (all.empty() ? "" : ", ") + std::string(toString(event.kind)) + " " +
           std::to_string(event.trigger);
  }
  return all;
}

double microseconds(const TriggerEvent& event) {
  return microsecondsAfter(0, event.time);
}

// A box of 2 cm, a hand that flies 2 m in one step of a tenth of a second: no pose is near it.
TEST(Triggers, AHandThatPassesThroughAThinBoxWithinOneStepEntersAndLeaves) {
  BothTriggers both(kTolerance, 0);
  const BodyId body = both.both.add(hand(0.02));
  const TriggerId box = both.add(test::plainBox(Vector3d(0.01, 0.5, 0.5)));
  both.stand(box, at(0));
  both.both.push(body, 0, at(-1.0));
  both.both.push(body, 100'000, at(1.0));
  both.follow(100'000);
  ASSERT_EQ(said(both.events), "enter 0, leave 0");
  // It touches from -3 cm to 3 cm at 20 m/s.
  EXPECT_NEAR(microseconds(both.events[0]), 48'500, 20);
  EXPECT_LE(microseconds(both.events[0]), 48'500);
  EXPECT_NEAR(microseconds(both.events[1]), 51'500, 20);
  EXPECT_GE(microseconds(both.events[1]), 51'500);
  EXPECT_TRUE(both.events[1].since == both.events[0].time);
  EXPECT_EQ(both.events[0].body, body);
  EXPECT_EQ(both.events[0].link, 0);
  EXPECT_FALSE(both.events[0].isAssumed);
  EXPECT_TRUE(both.triggers.occupants().empty());
  both.judge(500);
  expectNoProblems(both);
}

// Wholly inside nothing touches the surface, over several windows: it stays inside.
TEST(Triggers, AHandThatIsWhollyInsideStaysInsideFromWindowToWindow) {
  BothTriggers both(kTolerance, 0);
  const BodyId body = both.both.add(hand(0.02));
  const TriggerId room = both.add(test::plainBox(Vector3d(0.5, 0.5, 0.5)));
  both.stand(room, at(0));
  for (int i = 0; i <= 20; ++i) both.both.push(body, 10'000 * i, at(-1.0 + 0.1 * i));
  for (int i = 1; i <= 20; ++i) {
    both.follow(10'000 * i);
    const bool isIn = i > 4 && i < 16;
    if (i == 4 || i == 5 || i == 15) continue;
    EXPECT_EQ(both.triggers.occupants().size(), isIn ? 1u : 0u) << i;
  }
  ASSERT_EQ(said(both.events), "enter 0, leave 0");
  EXPECT_NEAR(microseconds(both.events[0]), 48'000, 100);
  EXPECT_NEAR(microseconds(both.events[1]), 152'000, 100);
  both.judge(300);
  EXPECT_GT(both.tally.whollyInside, 50u);
  expectNoProblems(both);
}

TEST(Triggers, WhoIsInsideAtTheBeginStartsInside) {
  BothTriggers both(kTolerance, 1000);
  const BodyId one = both.both.add(hand(0.02)), other = both.both.add(hand(0.02));
  const TriggerId room = both.add(test::plainBox(Vector3d(0.5, 0.5, 0.5)));
  const TriggerId ball = both.add(test::plainSphere(0.3));
  both.stand(room, at(0));
  both.stand(ball, at(0));
  both.both.push(one, 0, at(0));
  both.both.push(one, 100'000, at(0));
  both.both.push(other, 50'000, at(0, 0.1));  // appears inside
  both.both.push(other, 100'000, at(0, 0.1));
  both.follow(100'000);
  ASSERT_EQ(said(both.events),
            "starts_inside 0, starts_inside 1, starts_inside 0, starts_inside 1");
  EXPECT_EQ(both.events[0].time.us, 1000);
  EXPECT_EQ(both.events[2].time.us, 50'000);
  EXPECT_EQ(both.events[2].body, other);
  ASSERT_EQ(both.triggers.occupants().size(), 4u);
  EXPECT_EQ(both.triggers.occupants()[0].since.us, 1000);
  both.judge(100);
  expectNoProblems(both);
}

TEST(Triggers, NestedVolumesAreEnteredAndLeftInOrder) {
  BothTriggers both(kTolerance, 0);
  const BodyId body = both.both.add(hand(0.02));
  const TriggerId outer = both.add(test::plainBox(Vector3d(0.6, 0.6, 0.6)));
  const TriggerId inner = both.add(test::plainGlobe(0.3, 10, 12));
  both.stand(outer, at(0));
  both.stand(inner, at(0));
  for (int i = 0; i <= 10; ++i) both.both.push(body, 20'000 * i, at(-1.0 + 0.2 * i));
  both.follow(200'000);
  EXPECT_EQ(said(both.events), "enter 0, enter 1, leave 1, leave 0");
  both.judge(400);
  expectNoProblems(both);
}

// A volume that is carried: the sensor on a lift passes over one who stands, and a sensor in a hand
// does not look at that hand.
TEST(Triggers, TriggersMoveAndAreCarried) {
  BothTriggers both(kTolerance, 0);
  const BodyId lift = both.both.add(hand(0.02)), person = both.both.add(hand(0.02));
  const TriggerId sensor = both.add(test::plainBox(Vector3d(0.2, 0.2, 0.2)));
  for (int i = 0; i <= 10; ++i) {
    both.both.push(lift, 10'000 * i, at(0, -1.0 + 0.2 * i));
    both.both.push(person, 10'000 * i, at(0.1, 0, 0));
  }
  // Carried from an instant at which it is known.
  both.both.push(both.body(sensor), 0, at(7.0));
  both.both.push(both.body(sensor), 1, at(7.0));
  both.both.attach(both.body(sensor), {lift, 0, false}, 1, at(0));
  both.follow(100'000);
  ASSERT_EQ(said(both.events), "enter 0, leave 0");
  EXPECT_EQ(both.events[0].body, person);
  // It comes at 20 m/s, from 27 cm below the middle to 27 cm above.
  EXPECT_NEAR(microseconds(both.events[0]), 36'500, 20);
  EXPECT_NEAR(microseconds(both.events[1]), 63'500, 20);
  both.judge(200);
  EXPECT_GT(both.tally.whollyInside, 10u);
  // The judge knows of no exception: the lift is in its own sensor, and is not told.
  for (const std::string& problem : both.tally.problems) {
    EXPECT_NE(problem.find("body 0"), std::string::npos) << problem;
  }
}

// Off the carrier with a jump: what was known before says nothing of after.
TEST(Triggers, WhoIsPutSomewhereElseIsDecidedAnew) {
  BothTriggers both(kTolerance, 0);
  const BodyId body = both.both.add(hand(0.02)), carrier = both.both.add(hand(0.02));
  const TriggerId room = both.add(test::plainBox(Vector3d(0.5, 0.5, 0.5)));
  both.stand(room, at(0));
  for (const std::int64_t us : {0, 50'000, 100'000}) both.both.push(carrier, us, at(5.0));
  both.both.push(body, 0, at(0));
  both.both.push(body, 30'000, at(0));
  both.both.attach(body, {carrier, 0, false}, 30'000, at(0.1));  // 5.1 m away
  both.both.detach(body, 60'000, at(0.1));                       // and back
  both.both.push(body, 100'000, at(0.1));
  both.follow(45'000);
  both.follow(100'000);
  ASSERT_EQ(said(both.events), "starts_inside 0, leave 0, starts_inside 0");
  EXPECT_EQ(both.events[1].time.us, 30'000);
  EXPECT_EQ(both.events[2].time.us, 60'000);
  both.judge(100);
  expectNoProblems(both);
}

TEST(Triggers, WhatEndsAtAnInstantIsToldBeforeWhatBegins) {
  BothTriggers both(kTolerance, 0);
  const BodyId body = both.both.add(hand(0.02)), carrier = both.both.add(hand(0.02));
  const TriggerId there = both.add(test::plainBox(Vector3d(0.1, 0.1, 0.1)));
  const TriggerId here = both.add(test::plainBox(Vector3d(0.1, 0.1, 0.1)));
  both.stand(there, at(5.0));
  both.stand(here, at(0));
  for (const std::int64_t us : {0, 100'000}) both.both.push(carrier, us, at(4.0));
  both.both.push(body, 0, at(0));
  both.both.push(body, 30'000, at(0));
  both.both.attach(body, {carrier, 0, false}, 30'000, at(1.0));
  both.follow(100'000);
  ASSERT_EQ(said(both.events), "starts_inside 1, leave 1, starts_inside 0");
  EXPECT_EQ(both.events[1].time.us, 30'000);
  EXPECT_EQ(both.events[2].time.us, 30'000);
}

// A man holds a chair; he puts it down and, at the same instant, sits on it; then a lift carries
// the chair and him. At no instant does anybody carry himself, though over the whole time two do.
TEST(Triggers, TwoCarryEachOtherOneAfterTheOther) {
  BothTriggers both(kTolerance, 0);
  const BodyId man = both.both.add(hand(0.02)), chair = both.both.add(hand(0.02));
  const BodyId lift = both.both.add(hand(0.02));
  const TriggerId low = both.add(test::plainBox(Vector3d(0.1, 0.3, 0.3)));
  const TriggerId high = both.add(test::plainBox(Vector3d(0.3, 0.1, 0.3)));
  both.stand(low, at(1.0));
  both.stand(high, at(2.0, 1.0));
  both.both.push(lift, 0, at(2.0, -1.0));
  both.both.push(lift, 80'000, at(2.0, -1.0));
  both.both.push(lift, 120'000, at(2.0, 3.0));
  both.both.push(man, 0, at(-0.2));
  both.both.push(man, 40'000, at(1.8));
  both.both.push(chair, 0, at(0.0));
  both.both.push(chair, 1, at(0.0));
  both.both.attach(chair, {man, 0, false}, 1, at(0.2));
  both.both.detach(chair, 40'000, at(2.0));
  both.both.push(chair, 80'000, at(2.0));
  both.both.attach(man, {chair, 0, false}, 40'000, at(-0.2));
  both.both.attach(chair, {lift, 0, false}, 80'000, at(0.0, 1.0));
  both.follow(30'000);
  both.follow(120'000);
  // Both through the low one at 50 m/s, the chair 4 ms earlier; both through the high one at
  // 100 m/s, and the lift behind them.
  ASSERT_EQ(said(both.events),
            "enter 0, enter 0, leave 0, leave 0, enter 1, enter 1, leave 1, leave 1, enter 1, "
            "leave 1");
  EXPECT_EQ(both.events[0].body, chair);
  EXPECT_EQ(both.events[1].body, man);
  EXPECT_EQ(both.events[8].body, lift);
  EXPECT_NEAR(microseconds(both.events[0]), 20'000 - 2'400, 20);
  EXPECT_NEAR(microseconds(both.events[1]), 24'000 - 2'400, 20);
  EXPECT_NEAR(microseconds(both.events[4]), 90'000 - 1'700, 20);
  EXPECT_NEAR(microseconds(both.events[5]), 90'000 - 1'700, 20);
  both.judge(300);
  EXPECT_GT(both.tally.whollyInside, 10u);
  expectNoProblems(both);
}

TEST(Triggers, WhoIsSilentIsUnresolvedAndFoundAgain) {
  BothTriggers both(kTolerance, 0);
  BodyOptions undecided;
  undecided.whenSilent = WhenSilent::Undecided;
  const BodyId body = both.both.add(hand(0.02), undecided), clock = both.both.add(hand(0.02));
  const TriggerId room = both.add(test::plainBox(Vector3d(0.5, 0.5, 0.5)));
  both.stand(room, at(0));
  for (int i = 0; i <= 10; ++i) both.both.push(clock, 10'000 * i, at(9.0));
  both.both.push(body, 0, at(0));
  both.both.push(body, 30'000, at(0));
  both.follow(50'000);
  EXPECT_EQ(said(both.events), "starts_inside 0, unresolved_from 0");
  ASSERT_EQ(both.triggers.occupants().size(), 1u);
  EXPECT_TRUE(both.triggers.occupants()[0].isUnresolved);
  EXPECT_EQ(both.events[1].time.us, 30'000);
}

TEST(Triggers, LooksAtThoseWhoAreWatched) {
  BothTriggers both(kTolerance, 0);
  const BodyId one = both.both.add(hand(0.02)), other = both.both.add(hand(0.02));
  TriggerOptions options;
  options.watched = {{other, 0}};
  const TriggerId room = both.add(test::plainBox(Vector3d(0.5, 0.5, 0.5)), options);
  both.stand(room, at(0));
  for (const BodyId body : {one, other}) {
    both.both.push(body, 0, at(0));
    both.both.push(body, 100'000, at(0));
  }
  both.follow(100'000);
  ASSERT_EQ(said(both.events), "starts_inside 0");
  EXPECT_EQ(both.events[0].body, other);
}

TEST(Triggers, WhoIsAskedOnlyLaterStartsInsideThen) {
  BothTriggers both(kTolerance, 0);
  BodyOptions options;
  options.group = 3;
  const BodyId body = both.both.add(hand(0.02), options);
  const TriggerId room = both.add(test::plainBox(Vector3d(0.5, 0.5, 0.5)));
  both.stand(room, at(0));
  for (const std::int64_t us : {0, 100'000}) both.both.push(body, us, at(0));
  ASSERT_TRUE(both.both.world.ask(options.group, kTriggerGroup, false).ok());
  both.follow(40'000);
  EXPECT_EQ(said(both.events), "");
  ASSERT_TRUE(both.both.world.ask(options.group, kTriggerGroup, true).ok());
  both.follow(80'000);
  ASSERT_EQ(said(both.events), "starts_inside 0");
  EXPECT_EQ(both.events[0].time.us, 40'000);
  ASSERT_EQ(both.triggers.occupants().size(), 1u);
}

// From outside to within nothing at all, and away: at most the tolerance early and late.
TEST(Triggers, WhoTouchesFromOutsideIsToldWithinTheTolerance) {
  for (const double gap : {-1e-3, 0.0, 0.5 * kTolerance, 3.0 * kTolerance}) {
    BothTriggers both(kTolerance, 0);
    const BodyId body = both.both.add(hand(0.02));
    const TriggerId box = both.add(test::plainBox(Vector3d(0.1, 0.1, 0.1)));
    both.stand(box, at(0));
    both.both.push(body, 0, at(-0.3));
    both.both.push(body, 50'000, at(-0.12 - gap));
    both.both.push(body, 100'000, at(-0.3));
    both.follow(100'000);
    EXPECT_EQ(said(both.events), gap > kTolerance ? "" : "enter 0, leave 0") << gap;
    both.judge(400);
    expectNoProblems(both);
  }
}

TEST(Triggers, DoNotMeetEachOther) {
  BothTriggers both(kTolerance, 0);
  both.both.push(both.both.add(hand(0.02)), 0, at(9.0));
  both.both.push(0, 100'000, at(9.0));
  const TriggerId box = both.add(test::plainBox(Vector3d(0.1, 0.1, 0.1)));
  const TriggerId ball = both.add(test::plainSphere(0.5));
  both.stand(box, at(0));
  both.stand(ball, at(0));
  both.follow(100'000);
  EXPECT_EQ(said(both.events), "");
}

TEST(Triggers, RefuseWhatDoesNotFit) {
  World world = World::build(std::nullopt).value(), stranger = World::build(std::nullopt).value();
  Triggers triggers;
  TriggerOptions options;
  options.watched = {{0, 0}};
  const auto box = TriggerVolume::box(Vector3d(1, 1, 1)).value();
  EXPECT_EQ(triggers.add(world, box, options).error().code, ErrorCode::UnknownName);
  ASSERT_TRUE(world.add(hand(0.02)).ok());
  options.watched = {{0, 1}};
  EXPECT_EQ(triggers.add(world, box, options).error().code, ErrorCode::UnknownName);
  options.watched = {{0, 0}};
  options.group = 32;
  EXPECT_FALSE(triggers.add(world, box, options).ok());
  options.group = kTriggerGroup;
  const TriggerId trigger = triggers.add(world, box, options).value();
  EXPECT_EQ(triggers.body(trigger), 1);
  EXPECT_EQ(triggers.triggerOf(1), trigger);
  EXPECT_EQ(triggers.triggerOf(0), -1);
  EXPECT_FALSE(triggers.add(stranger, box).ok());
  EXPECT_FALSE(triggers.stand(world, 1, 0, {}).ok());
  ASSERT_TRUE(triggers.stand(world, trigger, 0, {}).ok());
  EXPECT_FALSE(triggers.stand(world, trigger, 0, {}).ok()) << "twice";
  WorldEvents events;
  events.fromUs = 0;
  events.toUs = 100;
  TriggerEvents told;
  EXPECT_FALSE(triggers.update(stranger, events, told).ok());
  ASSERT_TRUE(triggers.update(world, events, told).ok());
  EXPECT_EQ(triggers.update(world, events, told).error().code, ErrorCode::Mismatch);
}

/// Walkers with clocks of their own among volumes that stand, fly and are carried.
void runRandomWorld(std::uint64_t seed, bool areExact, test::TriggerTally& sum) {
  test::Random random(seed);
  BothTriggers both(test::randomTolerance(random), 0);
  constexpr std::int64_t kUntilUs = 300'000;
  std::vector<test::Walker> walkers;
  for (int i = 0; i < 2; ++i)
    walkers.push_back(test::randomWalker(random, random.inBox(0.3), 0.05));
  for (test::Walker& walker : walkers) {
    BodyOptions ofBody;
    if (areExact) ofBody.surface = test::randomSurface(walker.avatar, random);
    both.both.add(walker.avatar, ofBody);
  }
  TriggerOptions options;
  options.byLink = random.chance(0.5);
  const TriggerId box = both.add(test::plainBox(Vector3d(0.3, 0.4, 0.2)), options);
  const TriggerId globe = both.add(test::plainGlobe(random.uniform(0.1, 0.6), 6, 8), options);
  const TriggerId ball = both.add(test::plainSphere(random.uniform(0.05, 0.4)), options);
  both.stand(box, {random.rotation(), random.inBox(0.3)});
  for (std::size_t i = 0; i < walkers.size(); ++i) {
    test::walk(both.both, static_cast<BodyId>(i), walkers[i], test::randomPeriod(random), kUntilUs,
               random);
  }
  test::fly(both.both, both.body(globe), random.inBox(0.3), test::randomPeriod(random), kUntilUs,
            random);
  test::fly(both.both, both.body(ball), random.inBox(0.3), test::randomPeriod(random), kUntilUs,
            random);
  for (const std::int64_t us : {70'000, 100'000, 155'555, 300'000}) both.follow(us);
  both.judge(areExact ? 20 : 150);
  sum.samples += both.tally.samples;
  sum.inside += both.tally.inside;
  sum.whollyInside += both.tally.whollyInside;
  sum.unresolved += both.tally.unresolved;
  sum.decided += both.tally.decided;
  for (std::size_t k = 0; k < kNumEventKinds; ++k) sum.kinds[k] += both.tally.kinds[k];
  for (const std::string& problem : both.tally.problems) {
    ADD_FAILURE() << "seed " << seed << ": " << problem;
  }
}

void expectNobodyIsMissed(bool areExact) {
  test::TriggerTally sum;
  for (std::uint64_t seed = 0; seed < (areExact ? 12u : 40u); ++seed)
    runRandomWorld(seed, areExact, sum);
  std::cout << sum.samples << " samples, " << sum.inside << " told inside, " << sum.whollyInside
            << " wholly, " << sum.unresolved << " unresolved, " << sum.decided << " decided\n";
  EXPECT_GT(sum.inside, areExact ? 300u : 1000u);
  EXPECT_GT(sum.whollyInside, areExact ? 30u : 100u);
  EXPECT_LT(sum.inside, sum.samples / 2);
  EXPECT_GT(sum.kinds[slotOf(EventKind::Enter)], areExact ? 20u : 50u);
  EXPECT_GT(sum.kinds[slotOf(EventKind::Leave)], areExact ? 20u : 50u);
  EXPECT_GT(sum.kinds[slotOf(EventKind::StartsInside)], areExact ? 8u : 20u);
  EXPECT_EQ(sum.unresolved, 0u);
}

TEST(TriggerOracle, NobodyInsideIsMissedAndNobodyOutsideIsTold) {
  expectNobodyIsMissed(false);
}

// A link may have pieces that do not hang together, one of them inside.
TEST(TriggerOracle, NoTriangleInsideIsMissed) {
  expectNobodyIsMissed(true);
}

/// Somebody whose poses come late, or not for a while.
struct Sender {
  BodyId body;
  Vector3d middle;
  bool turns;
  std::int64_t periodUs, nextUs;
};

WhenSilent randomSilence(test::Random& random) {
  return random.chance(0.5) ? WhenSilent::HoldStill : WhenSilent::Undecided;
}

/// Balls, one of them held by another, and volumes, one of them carried, of all of which poses come
/// in at random; followed whatever has come.
void runLateWorld(std::uint64_t seed, test::TriggerTally& sum) {
  test::Random random(seed);
  BothTriggers both(test::randomTolerance(random), 0);
  std::vector<Sender> senders;
  const auto send = [&](BodyId body, const Vector3d& middle, bool turns) {
    const auto period = static_cast<std::int64_t>(random.uniform(3'000, 30'000));
    const auto first = static_cast<std::int64_t>(random.uniform(0, 30'000));
    senders.push_back({body, middle, turns, period, random.chance(0.7) ? 0 : first});
  };
  const Vector3d away(0, -20, 0);  // so that a carrier is not in what it carries
  for (int i = 0; i < 4; ++i) {
    BodyOptions options;
    options.whenSilent = randomSilence(random);
    const BodyId body = both.both.add(test::ball(random.uniform(0.02, 0.1)), options);
    if (i < 3) send(body, i == 2 ? away : Vector3d(0, 0, 0), i != 2);
  }
  TriggerOptions options[3];
  for (TriggerOptions& each : options) each.whenSilent = randomSilence(random);
  const TriggerId box = both.add(test::plainBox(Vector3d(0.3, 0.4, 0.2)), options[0]);
  const TriggerId ball = both.add(test::plainSphere(random.uniform(0.1, 0.4)), options[1]);
  const TriggerId globe = both.add(test::plainGlobe(random.uniform(0.2, 0.6), 5, 6), options[2]);
  send(both.body(box), Vector3d::Zero(), true);
  send(both.body(ball), Vector3d::Zero(), true);
  const auto deliver = [&](Sender& sender, std::int64_t untilUs) {
    for (; sender.nextUs <= untilUs; sender.nextUs += sender.periodUs) {
      RigidPose pose = at(0);
      if (sender.turns) pose.rotation = random.rotation();
      pose.translation = sender.middle + random.inBox(0.5);
      both.both.push(sender.body, sender.nextUs, pose);
    }
  };
  for (const int carrier : {0, 2}) {
    senders[slotOf(carrier)].nextUs = 0;
    deliver(senders[slotOf(carrier)], 0);
    const BodyId carried = carrier == 0 ? 3 : both.body(globe);
    for (const std::int64_t us : {0, 1}) both.both.push(carried, us, at(50.0));
    both.both.attach(carried, {carrier, 0, false}, 1, at(0, carrier == 0 ? 0.1 : 20.0));
  }
  constexpr std::int64_t kEndUs = 200'000;
  std::int64_t followedUs = 0;
  for (std::int64_t us = 0; us < kEndUs;) {
    us = std::min(kEndUs, us + static_cast<std::int64_t>(random.uniform(3'000, 25'000)));
    for (Sender& sender : senders) {
      const double late = random.uniform(-5'000, 10'000);
      if (random.chance(0.8)) deliver(sender, us + static_cast<std::int64_t>(late));
    }
    const std::int64_t untilUs = std::min(us, both.both.world.knownUntilUs().value());
    if (untilUs > followedUs) both.follow(followedUs = untilUs);
  }
  for (Sender& sender : senders) deliver(sender, kEndUs + sender.periodUs);
  both.judge(150);
  sum.samples += both.tally.samples;
  sum.inside += both.tally.inside;
  sum.whollyInside += both.tally.whollyInside;
  sum.unresolved += both.tally.unresolved;
  for (const std::string& problem : both.tally.problems) {
    ADD_FAILURE() << "seed " << seed << ": " << problem;
  }
}

// What is known of an instant when it is told, or is found out later, is never believed to be what
// was guessed before.
TEST(TriggerOracle, NobodyIsMissedWhosePosesComeLate) {
  test::TriggerTally sum;
  for (std::uint64_t seed = 0; seed < 20; ++seed) runLateWorld(seed, sum);
  std::cout << sum.samples << " samples, " << sum.inside << " told inside, " << sum.whollyInside
            << " wholly, " << sum.unresolved << " unresolved\n";
  EXPECT_GT(sum.inside, 1000u);
  EXPECT_GT(sum.whollyInside, 500u);
  EXPECT_GT(sum.unresolved, 1000u);
  EXPECT_LT(sum.inside + sum.unresolved, sum.samples * 3 / 4);
}

// A ball between two boards of one volume touches the lower one until a stretch ends, and the upper
// one within that time: the contact that ends last is not the one that begins last.
TEST(Triggers, WhoTouchesTwoObjectsAndLeavesOneWhereAStretchBeginsHasLeft) {
  RawScene raw = internal::boxTriangles({-2, -1, -1}, {2, 0, 1}, "slab");
  const RawScene post = internal::boxTriangles({-0.1, 0.21, -1}, {0.1, 0.5, 1}, "post");
  raw.triangles.insert(raw.triangles.end(), post.triangles.begin(), post.triangles.end());
  raw.objectOf.insert(raw.objectOf.end(), post.triangles.size(), 1);
  raw.objectNames.push_back("post");
  BothTriggers both(0.01, 0);
  const BodyId body = both.both.add(test::ball(0.1));
  const TriggerId volume =
      both.add({TriggerVolume::mesh(Scene::build(std::move(raw)).value()).value(), {}, true});
  both.stand(volume, at(0));
  // Half a tolerance above the slab, below the post by as much; at 10 ms 1.7 tolerances above.
  both.both.push(body, 0, at(-1.0, 0.105));
  both.both.push(body, 8'000, at(1.0, 0.105));
  both.both.push(body, 10'000, at(1.0, 0.117));
  both.follow(10'000);
  both.both.push(body, 20'000, at(1.0, 5.0));
  both.follow(20'000);
  EXPECT_EQ(said(both.events), "starts_inside 0, leave 0");
  EXPECT_TRUE(both.triggers.occupants().empty());
}

// The room was taken to hold still 5 m away; it has come, and nothing touched its walls meanwhile.
TEST(Triggers, WhoIsInsideWhereAGuessTurnsOutToBeWrongStartsInside) {
  BothTriggers both(kTolerance, 0);
  const BodyId body = both.both.add(test::ball(0.1));
  const TriggerId room = both.add(test::plainBox(Vector3d(0.5, 0.5, 0.5)));
  for (int i = 0; i <= 10; ++i) both.both.push(body, 10'000 * i, at(0));
  both.both.push(both.body(room), 0, at(5.0));
  both.follow(50'000);
  EXPECT_TRUE(both.triggers.occupants().empty());
  both.both.push(both.body(room), 100'000, at(-5.0));
  both.follow(52'000);
  ASSERT_EQ(said(both.events), "starts_inside 0");
  EXPECT_EQ(both.events[0].time.us, 50'000);
  EXPECT_EQ(both.triggers.occupants().size(), 1u);
}

// The same where a guess, or a change that is told late, has him leave without passing a wall.
TEST(Triggers, WhoWasTakenToBeInsideAndIsNotLeaves) {
  BothTriggers both(kTolerance, 0);
  BodyOptions still;
  still.whenSilent = WhenSilent::HoldStill;
  const BodyId guessed = both.both.add(test::ball(0.1), still);
  const BodyId changed = both.both.add(test::ball(0.1)), carrier = both.both.add(test::ball(0.1));
  const TriggerId room = both.add(test::plainBox(Vector3d(0.5, 0.5, 0.5)));
  both.stand(room, at(0));
  for (int i = 0; i <= 10; ++i) {
    both.both.push(carrier, 10'000 * i, at(9.0));
    both.both.push(changed, 10'000 * i, at(0, 0.1));
  }
  both.both.push(guessed, 0, at(0));
  both.follow(50'000);
  EXPECT_EQ(both.triggers.occupants().size(), 2u);
  both.both.push(guessed, 51'000, at(100.0));
  both.both.attach(changed, {carrier, 0, false}, 40'000, at(1.0));
  both.follow(60'000);
  ASSERT_EQ(said(both.events), "starts_inside 0, starts_inside 0, leave 0, leave 0");
  EXPECT_TRUE(both.events[2].isAssumed || both.events[3].isAssumed);
  EXPECT_EQ(both.events[2].time.us, 50'000);
  EXPECT_TRUE(both.triggers.occupants().empty());
}

// Who is first told to have been there before, where no stretch saw him appear.
TEST(Triggers, WhoAppearedBeforeTheStretchStartsInside) {
  BothTriggers both(kTolerance, 0);
  const BodyId late = both.both.add(test::ball(0.1)), clock = both.both.add(test::ball(0.1));
  const TriggerId room = both.add(test::plainBox(Vector3d(0.5, 0.5, 0.5)));
  both.stand(room, at(0));
  for (int i = 0; i <= 10; ++i) both.both.push(clock, 10'000 * i, at(9.0));
  both.follow(50'000);
  both.both.push(late, 30'000, at(0));
  both.both.push(late, 100'000, at(0));
  both.follow(60'000);
  ASSERT_EQ(said(both.events), "starts_inside 0");
  EXPECT_EQ(both.events[0].time.us, 50'000);
}

TEST(Triggers, WhatASilentBodyCarriesIsUnresolved) {
  BothTriggers both(kTolerance, 0);
  BodyOptions undecided;
  undecided.whenSilent = WhenSilent::Undecided;
  const BodyId carrier = both.both.add(test::ball(0.1), undecided);
  const BodyId held = both.both.add(test::ball(0.1)), clock = both.both.add(test::ball(0.1));
  TriggerOptions options;
  options.watched = {{held, kEveryLink}};
  const TriggerId room = both.add(test::plainBox(Vector3d(0.5, 0.5, 0.5)), options);
  both.stand(room, at(0));
  for (int i = 0; i <= 10; ++i) both.both.push(clock, 10'000 * i, at(9.0));
  both.both.push(carrier, 0, at(0));
  both.both.push(carrier, 30'000, at(0));
  both.both.push(held, 0, at(0));
  both.both.push(held, 1, at(0));
  both.both.attach(held, {carrier, 0, false}, 1, at(0, 0.1));
  both.follow(50'000);
  ASSERT_EQ(said(both.events), "starts_inside 0, unresolved_from 0");
  EXPECT_EQ(both.events[1].time.us, 30'000);
  ASSERT_EQ(both.triggers.occupants().size(), 1u);
  EXPECT_TRUE(both.triggers.occupants()[0].isUnresolved);
}

// A trigger that is silent says so of everyone, and that it is over.
TEST(Triggers, ASilentTriggerIsUnresolvedForAll) {
  BothTriggers both(kTolerance, 0);
  const BodyId one = both.both.add(test::ball(0.1)), other = both.both.add(test::ball(0.1));
  TriggerOptions undecided;
  undecided.whenSilent = WhenSilent::Undecided;
  const TriggerId globe = both.add(test::plainSphere(0.5), undecided);
  for (int i = 0; i <= 10; ++i) {
    both.both.push(one, 10'000 * i, at(9.0));
    both.both.push(other, 10'000 * i, at(-9.0));
  }
  for (const std::int64_t us : {0, 10'000}) both.both.push(both.body(globe), us, at(0));
  both.follow(20'000);
  ASSERT_EQ(said(both.events), "unresolved_from 0, unresolved_from 0");
  both.both.push(both.body(globe), 30'000, at(0));
  both.follow(30'000);
  ASSERT_EQ(said(both.events),
            "unresolved_from 0, unresolved_from 0, unresolved_to 0, unresolved_to 0");
  EXPECT_EQ(both.events[2].time.us, 20'000);
  EXPECT_EQ(both.events[2].since.us, 10'000);
  EXPECT_TRUE(both.triggers.occupants().empty());
  const auto late = both.triggers.watch(both.both.world, globe, {one, 0});
  ASSERT_FALSE(late.ok()) << "its events were told";
  EXPECT_EQ(late.error().index, globe);
}

TEST(PresenceSpans, WhatIsInsideComesBeforeWhatIsUnresolved) {
  using internal::Presence;
  using internal::PresenceSpan;
  const auto span = [](std::int64_t from, std::int64_t to, Presence presence, LinkId link) {
    return PresenceSpan{{from, 0.0}, {to, 0.0}, presence, link};
  };
  std::vector<PresenceSpan> memory,
      spans = {span(0, 90, Presence::Unresolved, 0), span(40, 50, Presence::Inside, 1),
               span(20, 30, Presence::Inside, 2)};
  internal::unite(spans, memory);
  std::string all;
  for (const PresenceSpan& each : spans) {
    all += std::to_string(each.from.us) + (each.presence == Presence::Inside ? " in " : " ? ") +
           std::to_string(each.to.us) + ", ";
  }
  EXPECT_EQ(all, "0 ? 20, 20 in 30, 30 ? 40, 40 in 50, 50 ? 90, ");
}

// A whole stretch of silence, in which the carrier has come in.
TEST(Triggers, WhatIsCarriedInInSilenceIsFoundInside) {
  BothTriggers both(kTolerance, 0);
  BodyOptions undecided;
  undecided.whenSilent = WhenSilent::Undecided;
  const BodyId carrier = both.both.add(test::ball(0.1), undecided);
  const BodyId held = both.both.add(test::ball(0.1)), clock = both.both.add(test::ball(0.1));
  const TriggerId room = both.add(test::plainBox(Vector3d(0.9, 0.5, 0.5)));
  both.stand(room, at(0));
  for (int i = 0; i <= 10; ++i) both.both.push(clock, 10'000 * i, at(9.0));
  for (const std::int64_t us : {0, 10'000}) both.both.push(carrier, us, at(-5.0));
  both.both.push(held, 0, at(-5.0));
  both.both.push(held, 1, at(-5.0));
  both.both.attach(held, {carrier, 0, false}, 1, at(0, 0.1));
  both.follow(10'000);
  both.follow(20'000);
  ASSERT_EQ(both.triggers.occupants().size(), 2u);
  EXPECT_TRUE(both.triggers.occupants()[1].isUnresolved);
  both.both.push(carrier, 30'000, at(5.0));
  both.follow(22'000);
  ASSERT_EQ(both.triggers.occupants().size(), 2u);
  EXPECT_EQ(both.triggers.occupants()[1].body, held);
  EXPECT_FALSE(both.triggers.occupants()[1].isUnresolved);
}

// A room that is carried by a silent body says nothing of anyone.
TEST(Triggers, ATriggerOnASilentBodyIsUnresolved) {
  BothTriggers both(kTolerance, 0);
  BodyOptions undecided;
  undecided.whenSilent = WhenSilent::Undecided;
  const BodyId lift = both.both.add(test::ball(0.1), undecided);
  const BodyId person = both.both.add(test::ball(0.1));
  TriggerOptions options;
  options.watched = {{person, kEveryLink}};
  const TriggerId room = both.add(test::plainBox(Vector3d(0.5, 0.5, 0.5)), options);
  for (int i = 0; i <= 10; ++i) both.both.push(person, 10'000 * i, at(9.0));
  for (const std::int64_t us : {0, 10'000}) both.both.push(lift, us, at(0));
  for (const std::int64_t us : {0, 1}) both.both.push(both.body(room), us, at(0));
  both.both.attach(both.body(room), {lift, 0, false}, 1, at(0, 1.0));
  both.follow(20'000);
  ASSERT_EQ(said(both.events), "unresolved_from 0");
  EXPECT_EQ(both.events[0].time.us, 10'000);
}

}  // namespace
}  // namespace foretouch
