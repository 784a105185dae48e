// `foretouch ask`: what a ray meets in a world file's world, at an instant.
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/holds.h"
#include "tests/tools/program_run.h"
#include "tests/tools/world/small_stage.h"

namespace foretouch::test {
namespace {

/// A ball that flies along x, 1 m/s, from 0 on.
class AskProgram : public testing::Test {
 protected:
  Ended ask(std::vector<std::string> rest) const {
    std::vector<std::string> arguments{"ask", world_};
    arguments.insert(arguments.end(), rest.begin(), rest.end());
    return runForetouch(arguments);
  }

  SmallStage stage_;
  std::string world_ =
      stage_.write(sphereNamed("ball", poseAt(0.0, "0, 0, 0") + poseAt(2.0, "2, 0, 0")));
};

TEST_F(AskProgram, TellsWhatARayHitsBetweenTwoPoses) {
  const Ended ended = ask({"--at", "1.5", "--from", "1.5,3,0", "--along", "0,-1,0", "--json"});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  const auto answer = nlohmann::json::parse(ended.out);
  EXPECT_EQ(answer.at("verdict"), "hit");
  EXPECT_EQ(answer.at("utime"), 1'500'000);
  ASSERT_EQ(answer.at("hits").size(), 1U);
  const auto& hit = answer.at("hits").front();
  EXPECT_NEAR(hit.at("distance").get<double>(), 2.95, 1e-8);
  EXPECT_EQ(hit.at("of").at("body"), "ball");
  EXPECT_NEAR(hit.at("normal").at(1).get<double>(), 1.0, 1e-8);
}

TEST_F(AskProgram, TellsThatItIsClearAndWhoIsUnknown) {
  const Ended clear = ask({"--at", "0.5", "--from", "1.5,3,0", "--along", "0,-1,0"});
  ASSERT_EQ(clear.exitCode, 0) << clear.err;
  EXPECT_TRUE(holds(clear.out, "at 0.5 s: clear"));
  const Ended unknown = ask({"--at", "9", "--from", "1.5,3,0", "--along", "0,-1,0"});
  EXPECT_TRUE(holds(unknown.out, "at 9 s: unknown"));
  EXPECT_TRUE(holds(unknown.out, "ball is silent"));
}

TEST_F(AskProgram, AsksABodyAtAnInstantOfItsOwnAndLeavesOthersOut) {
  const Ended late =
      ask({"--at", "0.5", "--from", "1.5,3,0", "--along", "0,-1,0", "--seen", "ball=1.5"});
  EXPECT_TRUE(holds(late.out, "2.9500 m: ball")) << late.out << late.err;
  const Ended without =
      ask({"--at", "1.5", "--from", "1.5,3,0", "--along", "0,-1,0", "--without", "ball"});
  EXPECT_TRUE(holds(without.out, "clear"));
}

TEST_F(AskProgram, OverlapsAndTheNearest) {
  EXPECT_TRUE(holds(ask({"--at", "1", "--from", "1,0.2,0", "--radius", "0.2"}).out, "hit"));
  EXPECT_TRUE(holds(ask({"--at", "1", "--from", "1,0.2,0", "--radius", "0.1"}).out, "clear"));
  EXPECT_TRUE(
      holds(ask({"--at", "1", "--from", "1,0.2,0", "--within", "1"}).out, "0.1500 m: ball"));
}

TEST_F(AskProgram, CastsBoxesAndHulls) {
  // The ball's top is at 0.05.
  const auto toldOf = [&](std::vector<std::string> shape) {
    std::vector<std::string> all{"--at", "1", "--from", "1,2,0", "--along", "0,-1,0"};
    all.insert(all.end(), shape.begin(), shape.end());
    return ask(all).out;
  };
  EXPECT_TRUE(holds(toldOf({"--box", "0.5,0.25,0.5"}), "1.7000 m: ball"));
  // On its edge a box reaches half a diagonal down.
  EXPECT_TRUE(
      holds(toldOf({"--box", "0.1,0.1,0.1", "--turn", "0.92388,0,0,0.38268"}), "1.8086 m: ball"));
  EXPECT_TRUE(holds(toldOf({"--hull", "0,-1,0,1,0,0,-1,0,0,0,0,1"}), "0.9500 m: ball"));
  EXPECT_TRUE(holds(toldOf({"--hull", "0,-1,0", "--radius", "0.5"}), "0.4500 m: ball"));
}

TEST_F(AskProgram, RefusesByName) {
  const auto errorOf = [&](const std::vector<std::string>& rest) {
    const Ended ended = ask(rest);
    EXPECT_EQ(ended.exitCode, 2);
    return ended.err;
  };
  EXPECT_TRUE(holds(errorOf({"--from", "0,0"}), "--from: expected three numbers"));
  EXPECT_TRUE(holds(errorOf({"--from", "0,0,0", "--along", "0,0,0"}), "direction"));
  EXPECT_TRUE(holds(errorOf({"--from", "0,0,0", "--box", "1,1"}), "--box: expected three"));
  EXPECT_TRUE(holds(errorOf({"--from", "0,0,0", "--box", "1,1,1", "--to", "1,0,0"}), "--to"));
  EXPECT_TRUE(holds(errorOf({"--from", "0,0,0", "--turn", "1,0,0,0"}), "--box beside it"));
  EXPECT_TRUE(holds(errorOf({"--from", "0,0,0", "--box", "1,1,1", "--turn", "1,1,0,0"}), "unit"));
  EXPECT_TRUE(holds(errorOf({"--from", "0,0,0", "--hull", "1,1,1,2"}), "three numbers per corner"));
  EXPECT_TRUE(holds(errorOf({"--from", "0,0,0", "--only", "Bal"}), "expected one of ball"));
  EXPECT_TRUE(holds(errorOf({"--from", "0,0,0", "--seen", "ball"}), "BODY=SECONDS"));
  EXPECT_TRUE(holds(errorOf({"--from", "0,0,0", "--along", "1,0,0", "--within", "1"}), "--within"));
}

}  // namespace
}  // namespace foretouch::test
