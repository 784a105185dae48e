// Tests tools/world/loaded_world.h and world_windows.h: bodies are where and when the file says,
// and meet at instants that are computed by hand.
#include "tools/world/loaded_world.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/holds.h"
#include "tests/tools/world/small_stage.h"
#include "tools/world/world_touches.h"

namespace foretouch::test {
namespace {

using tools::BodyPlaces;
using tools::LoadedWorld;

/// Early by no more than the tolerance at this speed (m/s), and never late.
void expectMetAt(const std::vector<WorldContact>& contacts, double timeS, double speed) {
  ASSERT_FALSE(contacts.empty());
  EXPECT_EQ(contacts.front().verdict, Verdict::Contact);
  EXPECT_LE(secondsOf(contacts.front().time), timeS + 1e-12);
  EXPECT_GE(secondsOf(contacts.front().time), timeS - 1.01 * kDefaultTolerance / speed);
}

Eigen::Vector3d placeOf(const LoadedWorld& world, BodyId body, double timeS) {
  const auto stretches = world.stretches();
  return BodyPlaces(stretches).linkAt(body, 0, std::llround(timeS * 1e6)).translation;
}

TEST(LoadedWorldTest, AWalkerMeetsABallThatStands) {
  const SmallStage stage;
  const auto world = stage.load(kManWalks + sphereNamed("ball", "position = [0, 0, 0]\n"));
  ASSERT_TRUE(world.ok()) << describe(world.error());
  expectMetAt(stage.contactsOf(world.value()), 0.12, 5.0);
}

TEST(LoadedWorldTest, TwoThatMoveMeetInBetween) {
  const SmallStage stage;
  stage.folder.write("ball.csv", "time,x,y,z\n0,0.75,0,0\n0.3,-0.75,0,0\n");
  for (const std::string& how : {std::string("poses = \"ball.csv\"\n"),
                                 poseAt(0, "0.75, 0, 0") + poseAt(0.3, "-0.75, 0, 0")}) {
    const auto world = stage.load(kManWalks + sphereNamed("ball", how));
    ASSERT_TRUE(world.ok()) << describe(world.error());
    expectMetAt(stage.contactsOf(world.value()), 0.135, 10.0);
  }
}

TEST(LoadedWorldTest, AClipBeginsWhereAndWhenTheFileSays) {
  const SmallStage stage;
  const auto world =
      stage.load(kManWalks + "from = 0.1\nstart = 10\nspeed = 0.5\nplace = \"0,0,1,180\"\n" +
                 sphereNamed("ball", "position = [0, 0, 1]\n"));
  ASSERT_TRUE(world.ok()) << describe(world.error());
  EXPECT_EQ(world.value().beginUs, 10'000'000);
  EXPECT_EQ(world.value().endUs, 10'400'000);
  EXPECT_NEAR(placeOf(world.value(), 0, 10.0).x(), 0.25, 1e-12);  // turned about
  // The clip's 0.12 s, 0.02 s behind its first frame and half as fast.
  expectMetAt(stage.contactsOf(world.value()), 10.04, 2.5);
}

TEST(LoadedWorldTest, AClipMovesAPropByOneOfItsJoints) {
  const SmallStage stage;
  const auto byRoot = stage.load(sphereNamed("ball", "[body.clip]\nfile = \"clip.bvh\"\n"));
  ASSERT_TRUE(byRoot.ok()) << describe(byRoot.error());
  EXPECT_NEAR(placeOf(byRoot.value(), 0, 0.15).x(), 0.0, 1e-12);
  const auto byArm =
      stage.load(sphereNamed("ball", "[body.clip]\nfile = \"clip.bvh\"\njoint = \"Arm\"\n"));
  ASSERT_TRUE(byArm.ok()) << describe(byArm.error());
  EXPECT_NEAR(placeOf(byArm.value(), 0, 0.15).y(), 0.3, 1e-12);
  const auto byNobody =
      stage.load(sphereNamed("ball", "[body.clip]\nfile = \"clip.bvh\"\njoint = \"Arms\"\n"));
  ASSERT_FALSE(byNobody.ok());
  EXPECT_TRUE(holds(byNobody.error().message, "did you mean 'Arm'")) << describe(byNobody.error());
}

TEST(LoadedWorldTest, WhatIsHeldGoesAlongAndStaysWhereItIsLetGo) {
  const SmallStage stage;
  const auto world = stage.load(
      kManWalks +
      sphereNamed("cup",
                  "[[body.attach]]\ntime = 0\nto = \"man\"\nlink = \"Hips\"\nposition = [0, "
                  "-0.3, 0]\n[[body.detach]]\ntime = 0.2\n") +
      sphereNamed("post", "position = [0, -0.3, 0]\n"));
  ASSERT_TRUE(world.ok()) << describe(world.error());
  EXPECT_TRUE(placeOf(world.value(), 1, 0.1).isApprox(Eigen::Vector3d(-0.25, -0.3, 0), 1e-12));
  EXPECT_TRUE(placeOf(world.value(), 1, 0.2).isApprox(Eigen::Vector3d(0.25, -0.3, 0), 1e-12));
  EXPECT_TRUE(placeOf(world.value(), 1, 0.3).isApprox(Eigen::Vector3d(0.25, -0.3, 0), 1e-12));
  const auto contacts = stage.contactsOf(world.value());
  expectMetAt(contacts, 0.13, 5.0);  // two balls of 0.05, 0.1 before the post
  EXPECT_EQ(contacts.front().a.body, 1);
  EXPECT_EQ(contacts.front().b.body, 2);
}

TEST(LoadedWorldTest, WhatIsTakenKeepsItsPlaceInTheHand) {
  const SmallStage stage;
  const auto world = stage.load(
      kManWalks + sphereNamed("cup",
                              "position = [0.25, -0.3, 0.1]\n[[body.attach]]\ntime = 0.2\n"
                              "to = \"man\"\nlink = \"Hips\"\n"));
  ASSERT_TRUE(world.ok()) << describe(world.error());
  EXPECT_TRUE(placeOf(world.value(), 1, 0.1).isApprox(Eigen::Vector3d(0.25, -0.3, 0.1), 1e-12));
  EXPECT_TRUE(placeOf(world.value(), 1, 0.3).isApprox(Eigen::Vector3d(0.75, -0.3, 0.1), 1e-12));
}

TEST(LoadedWorldTest, WhoRidesMovesInTheFrameOfTheLift) {
  const SmallStage stage;
  const auto world =
      stage.load("[[body]]\nname = \"lift\"\nbox = {low = [-1, -0.1, -1], high = [1, 0, 1]}\n" +
                 poseAt(0, "0, 0, 0") + poseAt(1, "0, 4, 0") +
                 sphereNamed("rider", "[[body.attach]]\ntime = 0\nto = \"lift\"\nmoves = true\n" +
                                          poseAt(0, "0, 0.5, 0") + poseAt(1, "0.6, 0.5, 0")));
  ASSERT_TRUE(world.ok()) << describe(world.error());
  EXPECT_TRUE(placeOf(world.value(), 1, 0.5).isApprox(Eigen::Vector3d(0.3, 2.5, 0), 1e-12));
  EXPECT_TRUE(stage.contactsOf(world.value()).empty());
}

/// Tables in the order in which they are given, and the other way round.
std::vector<std::string> bothWays(std::vector<std::string> tables) {
  std::vector<std::string> ways;
  for (int i = 0; i < 2; ++i) {
    ways.push_back(std::accumulate(tables.begin(), tables.end(), std::string()));
    std::reverse(tables.begin(), tables.end());
  }
  return ways;
}

/// The lift is put ten metres away, and the rider is let go, at the same instant: it stays.
TEST(LoadedWorldTest, WhoIsLetGoStaysWhereItWasThoughItsCarrierIsPutElsewhere) {
  const SmallStage stage;
  for (const std::string& text :
       bothWays({sphereNamed("crane", "position = [50, 0, 0]\n"),
                 sphereNamed("lift",
                             "[[body.attach]]\ntime = 0\nto = \"crane\"\nposition = [-50, 0, "
                             "0]\n[[body.detach]]\ntime = 1\nposition = [10, 0, 0]\n" +
                                 poseAt(2, "10, 0, 0")),
                 sphereNamed("rider",
                             "[[body.attach]]\ntime = 0\nto = \"lift\"\nposition = [0, 1, 0]\n"
                             "[[body.detach]]\ntime = 1\n" +
                                 poseAt(2, "0, 1, 0"))})) {
    const auto world = stage.load(text);
    ASSERT_TRUE(world.ok()) << describe(world.error());
    for (BodyId body = 0; body < 3; ++body) {
      if (world.value().nameOf(body) != "rider") continue;
      EXPECT_EQ(placeOf(world.value(), body, 1.0), Eigen::Vector3d(0, 1, 0)) << text;
    }
  }
}

/// Who goes over to somebody who is put elsewhere at that instant does not go along.
TEST(LoadedWorldTest, WhoIsTakenStaysWhereItWasThoughItsNewCarrierIsPutElsewhere) {
  const SmallStage stage;
  for (const std::string& text :
       bothWays({sphereNamed("post", "position = [5, 0, 0]\n"),
                 sphereNamed("hand", poseAt(0, "0, 0, 0") + poseAt(1, "1, 0, 0") +
                                         "[[body.attach]]\ntime = 1\nto = \"post\"\n"
                                         "position = [0, 2, 0]\n"),
                 sphereNamed("cup",
                             "position = [3, 3, 3]\n[[body.attach]]\ntime = 1\n"
                             "to = \"hand\"\n")})) {
    const auto world = stage.load(text);
    ASSERT_TRUE(world.ok()) << describe(world.error());
    for (BodyId body = 0; body < 3; ++body) {
      if (world.value().nameOf(body) != "cup") continue;
      EXPECT_EQ(placeOf(world.value(), body, 1.0), Eigen::Vector3d(3, 3, 3)) << text;
    }
  }
}

TEST(LoadedWorldTest, WhoStandsIsTakenWhereItStandsFromTheFirstInstantOn) {
  const SmallStage stage;
  for (const std::string& text :
       bothWays({sphereNamed("cup",
                             "position = [1, 1, 1]\n[[body.attach]]\ntime = 0\n"
                             "to = \"hand\"\n"),
                 sphereNamed("hand", poseAt(0, "1, 1, 0.5") + poseAt(1, "2, 1, 0.5"))})) {
    const auto world = stage.load(text);
    ASSERT_TRUE(world.ok()) << describe(world.error());
    const BodyId cup = world.value().nameOf(0) == "cup" ? 0 : 1;
    EXPECT_EQ(placeOf(world.value(), cup, 0.0), Eigen::Vector3d(1, 1, 1));
    EXPECT_EQ(placeOf(world.value(), cup, 1.0), Eigen::Vector3d(2, 1, 1));
  }
}

TEST(LoadedWorldTest, GroupsThatAreNotAskedDoNotMeet) {
  const SmallStage stage;
  const std::string ball = sphereNamed("ball", "position = [0, 0, 0]\ngroup = \"toys\"\n");
  const std::string man =
      "[[body]]\nname = \"man\"\navatar = \"man.json\"\ngroup = \"men\"\n"
      "[body.clip]\nfile = \"clip.bvh\"\n";
  const std::string ask = "[[ask]]\ngroup = \"toys\"\nwith = \"men\"\nasked = ";
  const auto asked = stage.load(man + ball + ask + "true\n");
  const auto notAsked = stage.load(man + ball + ask + "false\n");
  ASSERT_TRUE(asked.ok() && notAsked.ok());
  EXPECT_FALSE(stage.contactsOf(asked.value()).empty());
  EXPECT_TRUE(stage.contactsOf(notAsked.value()).empty());
  const auto unknown =
      stage.load(man + ball + "[[ask]]\ngroup = \"toy\"\nwith = \"men\"\nasked = true\n");
  ASSERT_FALSE(unknown.ok());
  EXPECT_TRUE(holds(unknown.error().message, "did you mean 'toys'")) << describe(unknown.error());
}

TEST(LoadedWorldTest, EndsWithWhoIsSilentFirstUnlessTheyAreTakenToStay) {
  const SmallStage stage;
  const std::string poses = poseAt(0, "0, 0, 5") + poseAt(0.2, "0, 0, 5");
  const auto waits = stage.load(kManWalks + sphereNamed("ball", poses));
  ASSERT_TRUE(waits.ok());
  EXPECT_EQ(waits.value().endUs, 200'000);
  EXPECT_EQ(waits.value().waitsFor, BodyId{1});
  const auto stays = stage.load(kManWalks + sphereNamed("ball", "when_silent = \"hold-still\"\n" +
                                                                    poseAt(0, "0.5, 0, 0") +
                                                                    poseAt(0.2, "0.5, 0, 0")));
  ASSERT_TRUE(stays.ok());
  EXPECT_EQ(stays.value().endUs, 300'000);
  const auto contacts = stage.contactsOf(stays.value());
  expectMetAt(contacts, 0.22, 5.0);
  EXPECT_TRUE(contacts.front().isAssumed);
}

TEST(LoadedWorldTest, SaysWhoOverlapsWhereItAppears) {
  const SmallStage stage;
  const auto world =
      stage.load(kManWalks + sphereNamed("near", "position = [-0.75, 0, 0]\n") +
                 sphereNamed("late", poseAt(0.1, "-0.25, 0, 0") + poseAt(0.3, "-0.25, 0, 0")) +
                 sphereNamed("later", poseAt(0.15, "0, 9, 0") + poseAt(0.3, "-0.25, 0, 0")));
  ASSERT_TRUE(world.ok()) << describe(world.error());
  const auto overlaps = tools::overlapsAtStart(world.value());
  ASSERT_TRUE(overlaps.ok()) << describe(overlaps.error());
  ASSERT_EQ(overlaps.value().size(), 2u);
  EXPECT_EQ(overlaps.value()[0].b.body, 1);
  EXPECT_NEAR(overlaps.value()[0].penetration, 0.15, 1e-9);
  EXPECT_EQ(overlaps.value()[1].b.body, 2);
  EXPECT_EQ(overlaps.value()[1].time.us, 100'000);
}

/// A world that cannot be, with the line behind the head's two and what the error says.
struct Impossible {
  std::string text;
  int line;
  std::string says;
};

TEST(LoadedWorldTest, RefusesWorldsThatCannotBeWithTheirLines) {
  const SmallStage stage;
  const auto attached = [](const std::string& name, const std::string& to, double timeS,
                           const std::string& rest = "position = [0, 0, 0]\n") {
    return sphereNamed(name, "[[body.attach]]\ntime = " + std::to_string(timeS) + "\nto = \"" + to +
                                 "\"\n" + rest);
  };
  const std::string still = sphereNamed("still", "");
  const std::string moving = poseAt(0, "0, 0, 0") + poseAt(1, "1, 0, 0");
  const std::vector<Impossible> cases{
      {attached("a", "b", 0) + still, 4, "expected the name of a body, found 'b'"},
      {attached("a", "a", 0), 4, "expected another body than 'a' itself"},
      {attached("a", "man", 0, "link = \"Hip\"\nposition = [0, 0, 0]\n") + kManWalks, 4,
       "expected a link of 'man', found 'Hip'; did you mean 'Hips'"},
      {attached("a", "man", 0) + kManWalks, 4, "expected a link of 'man', found ''"},
      // A circle: b on a, then a on b.
      {sphereNamed("a", poseAt(0, "0, 0, 0") + poseAt(0.5, "0, 0, 0") +
                            "[[body.attach]]\ntime = 0.5\nto = \"b\"\n") +
           attached("b", "a", 0.25),
       10, "carries 'b'"},
      {sphereNamed("a", "[[body.detach]]\ntime = 0.5\n") + sphereNamed("b", moving), 4,
       "'a' is not carried"},
      {sphereNamed("a", "[[body.attach]]\ntime = 0\nto = \"b\"\n" + poseAt(0.5, "0, 0, 0")) +
           sphereNamed("b", moving),
       4, "expected a position: 'a' is not there before 0 s"},
      // A circle at one instant, by the first name in it.
      {attached("b", "a", 0) + attached("a", "b", 0), 11,
       "'a' carries 'b', itself or through others, at 0 s"},
      {attached("a", "b", 0) + poseAt(0.5, "0, 0, 0") + sphereNamed("b", moving), 8,
       "held fast by 'b' at 0.5 s"},
      {sphereNamed("a", moving + "[[body.attach]]\ntime = 2\nto = \"b\"\n") +
           sphereNamed("b", poseAt(0, "0, 0, 1") + poseAt(3, "0, 0, 1")),
       10, "is known until"},
  };
  for (const Impossible& impossible : cases) {
    const auto world = stage.load(impossible.text);
    ASSERT_FALSE(world.ok()) << impossible.text;
    EXPECT_EQ(world.error().file, stage.folder / "world.toml");
    EXPECT_EQ(world.error().line, impossible.line + SmallStage::kHeadLines)
        << impossible.text << describe(world.error());
    EXPECT_TRUE(holds(world.error().message, impossible.says)) << describe(world.error());
  }
}

TEST(LoadedWorldTest, RefusesFilesThatAreNotThereOrOfNoUse) {
  const SmallStage stage;
  stage.folder.write("none.obj", "v 0 0 0\n");
  for (const auto& [text, name] : std::vector<std::pair<std::string, std::string>>{
           {"[[body]]\nname = \"a\"\navatar = \"gone.json\"\n", "gone.json"},
           {sphereNamed("a", "poses = \"gone.csv\"\n"), "gone.csv"},
           {sphereNamed("a", "[body.clip]\nfile = \"gone.bvh\"\n"), "gone.bvh"},
           {"[[body]]\nname = \"a\"\nmesh = \"gone.obj\"\n", "gone.obj"},
           {"[[body]]\nname = \"a\"\nmesh = \"none.obj\"\n", "none.obj"},
           {"[scene]\nfile = \"gone.obj\"\n" + kManWalks, "gone.obj"}}) {
    const auto world = stage.load(text);
    ASSERT_FALSE(world.ok()) << text;
    EXPECT_EQ(world.error().file, stage.folder / name) << describe(world.error());
  }
}

TEST(WorldWindows, GoFromPoseToPoseOfAnybody) {
  const SmallStage stage;
  const auto world =
      stage.load(kManWalks + sphereNamed("ball", poseAt(0.05, "0, 9, 0") + poseAt(0.25, "0, 9, 0") +
                                                     poseAt(0.4, "0, 9, 0")));
  ASSERT_TRUE(world.ok());
  const auto cuts = tools::windowsOf(world.value(), {});
  ASSERT_TRUE(cuts.ok());
  EXPECT_EQ(cuts.value(),
            (std::vector<std::int64_t>{0, 50'000, 100'000, 200'000, 250'000, 300'000}));
  // The ball appears at 0.05 s: a window ends there, whatever the rate.
  const auto rated = tools::windowsOf(world.value(), {10.0, 0, 250'000});
  ASSERT_TRUE(rated.ok());
  EXPECT_EQ(rated.value(), (std::vector<std::int64_t>{0, 50'000, 100'000, 200'000, 250'000}));
  for (const tools::WindowRequest& bad :
       {tools::WindowRequest{1e6, std::nullopt, 1'000'000}, tools::WindowRequest{{}, -100'000, {}},
        tools::WindowRequest{{}, 200'000, 200'000}, tools::WindowRequest{{}, {}, kMostUtimeUs}}) {
    EXPECT_FALSE(tools::windowsOf(world.value(), bad).ok());
  }
}

std::vector<tools::WorldTouch> touchesOf(const LoadedWorld& world, tools::WorldTouches& touches) {
  const auto cuts = tools::windowsOf(world, {100.0, {}, {}});
  EXPECT_TRUE(cuts.ok());
  EXPECT_TRUE(tools::replayWorld(world, cuts.value(), [&](const tools::WorldStep& step) {
                touches.add(step);
                return true;
              }).ok());
  touches.finish();
  return touches.listed();
}

TEST(WorldTouchesTest, EndWhereTheTwoPartAndStayOpenWhereNobodyKnows) {
  const SmallStage stage;
  // The walker passes the first ball between 0.12 and 0.18 s; the second one is taken along.
  const auto world = stage.load(
      kManWalks + sphereNamed("ball", "position = [0, 0, 0]\n") +
      sphereNamed("cup",
                  "position = [0.3, 0, 0]\n[[body.attach]]\ntime = 0.2\nto = \"man\"\nlink = "
                  "\"Hips\"\n"));
  ASSERT_TRUE(world.ok()) << describe(world.error());
  tools::WorldTouches touches(world.value(), nullptr);
  touchesOf(world.value(), touches);
  ASSERT_EQ(touches.listed().size(), 2u);
  const tools::Touch &ball = touches.listed()[0], &cup = touches.listed()[1];
  EXPECT_EQ(touches.sidesOf(ball).b, 1);
  EXPECT_NEAR(ball.beginS, 0.12, 3e-4);
  EXPECT_NEAR(ball.endS, 0.18, 0.011);  // the last window that begins in contact
  EXPECT_FALSE(ball.isOpen);
  EXPECT_FALSE(ball.isMissed);
  EXPECT_EQ(touches.sidesOf(cup).b, 2);
  EXPECT_NEAR(cup.beginS, 0.18, 3e-4);
  EXPECT_TRUE(cup.isOpen);
  EXPECT_EQ(touches.counts().bodies, 2);
  EXPECT_EQ(touches.counts().scene + touches.counts().own, 0);
}

TEST(WorldTouchesTest, StayOpenWhereSomebodyIsSilentOrHangsOnSomebodySilent) {
  const SmallStage stage;
  // The lift is known for 0.1 s; who rides on it touches the post from the beginning.
  const std::string world =
      kManWalks +
      sphereNamed("lift",
                  "when_silent = \"undecided\"\n" + poseAt(0, "0, 9, 0") + poseAt(0.1, "0, 9, 0")) +
      sphereNamed("rider", "[[body.attach]]\ntime = 0\nto = \"lift\"\nposition = [0, 1, 0]\n") +
      sphereNamed("post", "position = [0.05, 10, 0]\n");
  const auto loaded = stage.load(world);
  ASSERT_TRUE(loaded.ok()) << describe(loaded.error());
  tools::WorldTouches touches(loaded.value(), nullptr);
  const auto listed = touchesOf(loaded.value(), touches);
  ASSERT_EQ(listed.size(), 1u);
  EXPECT_EQ(touches.sidesOf(listed[0]).a, 2);
  EXPECT_EQ(touches.sidesOf(listed[0]).b, 3);
  EXPECT_TRUE(listed[0].isOpen);
  EXPECT_LE(listed[0].endS, 0.1);
}

}  // namespace
}  // namespace foretouch::test
