// tests/tools/solid/solid_program_test.cpp: `foretouch replay --solid` and `foretouch solid check`
// as a user runs them.
#include <cmath>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/tools/program_run.h"
#include "tests/tools/small_world.h"

namespace foretouch::test {
namespace {

using nlohmann::json;

std::vector<json> linesOf(const std::string& path) {
  std::istringstream text(contentOf(path));
  std::vector<json> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(json::parse(line));
  return lines;
}

/// The man walks into the wall, stays behind it for a while, and comes back.
std::string clipIntoTheWall() {
  std::vector<double> places;
  for (int i = 0; i <= 20; ++i) places.push_back(-0.5 + 0.04 * i);
  for (int i = 0; i < 10; ++i) places.push_back(0.3);
  for (int i = 0; i <= 20; ++i) places.push_back(0.3 - 0.04 * i);
  return clipAlongX(places, 1.0 / 60.0);
}

class SolidReplay : public testing::Test {
 protected:
  SolidReplay() { world_.folder.write("clip.bvh", clipIntoTheWall()); }

  [[nodiscard]] Ended replay(std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"--solid", "--output", out_});
    return runForetouch(world_.replay(more));
  }
  [[nodiscard]] Ended check(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{"solid", "check", out_};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return runForetouch(arguments);
  }

  SmallWorld world_;
  std::string out_ = world_.folder / "shown.jsonl";
};

TEST_F(SolidReplay, WritesShownPosesThatStayOnTheirSideOfTheWall) {
  const Ended ended = replay();
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_NE(ended.out.find("certified"), std::string::npos) << ended.out;
  const std::vector<json> lines = linesOf(out_);
  ASSERT_EQ(lines.size(), 54u);  // header, 52 ticks, summary
  EXPECT_EQ(lines.front()["format"], "foretouch-solid");
  EXPECT_EQ(lines.front()["ticks"], 52);
  EXPECT_EQ(lines.front()["scene"], "wall.obj");
  EXPECT_EQ(lines.front()["options"]["skin"], 0.002);
  double farthest = -1.0;
  int kept = 0;
  for (std::size_t i = 1; i + 1 < lines.size(); ++i) {
    const json& tick = lines[i];
    EXPECT_EQ(tick["tick"], i - 1);
    EXPECT_TRUE(tick["certified"].get<bool>()) << i;
    kept += tick["state"] != "equal" ? 1 : 0;
    EXPECT_EQ(tick.contains("tracked"), tick["state"] != "equal") << i;
    for (const json& pose : tick["way"]) {
      // The hips are a ball of 10 cm; the wall is at 0.
      farthest = std::max(farthest, pose["translations"][0][0].get<double>());
    }
  }
  EXPECT_GT(kept, 15);
  EXPECT_LT(farthest, -0.1);
  EXPECT_GT(farthest, -0.2);               // it comes near
  EXPECT_EQ(lines[52]["state"], "equal");  // and is back where it is tracked
  EXPECT_EQ(lines.back()["summary"]["ticks"], 52);
  EXPECT_EQ(lines.back()["summary"]["certified"], 52);
}

TEST_F(SolidReplay, GivesTheSameBytesTwiceAndOnStandardOutput) {
  ASSERT_EQ(replay().exitCode, 0);
  const std::string first = contentOf(out_);
  ASSERT_EQ(replay({"--quiet"}).exitCode, 0);
  EXPECT_TRUE(contentOf(out_) == first);
  const Ended streamed = runForetouch(world_.replay({"--solid", "--output", "-"}));
  ASSERT_EQ(streamed.exitCode, 0) << streamed.err;
  EXPECT_TRUE(streamed.out == first);
  EXPECT_NE(streamed.err.find("certified"), std::string::npos);  // the summary gave way
}

TEST_F(SolidReplay, SummarisesAsJson) {
  const Ended ended = replay({"--json"});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  const json summary = json::parse(ended.out);
  EXPECT_EQ(summary["ticks"], 52);
  EXPECT_EQ(summary["certified"], 52);
  EXPECT_EQ(summary["states"]["placing"], 0);
  EXPECT_GT(summary["deviation"]["max"].get<double>(), 0.3);
  EXPECT_GT(summary["clearance"].get<double>(), 0.0);
  EXPECT_EQ(summary["output"], out_);
}

TEST_F(SolidReplay, CheckCertifiesEveryWayOnceMore) {
  ASSERT_EQ(replay().exitCode, 0);
  const Ended ended = check();
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_NE(ended.out.find("sound. 52 of 52 ticks are certified"), std::string::npos) << ended.out;
  const Ended asJson = check({"--json"});
  const json checked = json::parse(asJson.out);
  EXPECT_EQ(checked["sound"], true);
  EXPECT_EQ(checked["begins"], 1);
  EXPECT_GT(checked["motions"].get<int>(), 20);
}

TEST_F(SolidReplay, CheckFindsAFileThatSomebodyChanged) {
  ASSERT_EQ(replay().exitCode, 0);
  const std::string whole = contentOf(out_);
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = whole;
    const std::size_t at = text.find(from, text.find("\"tick\":20,"));
    EXPECT_NE(at, std::string::npos) << from;
    world_.folder.write("shown.jsonl", text.replace(at, from.size(), to));
    return check();
  };
  const Ended flag = changed("\"certified\":true", "\"certified\":false");
  EXPECT_EQ(flag.exitCode, 1);
  EXPECT_NE(flag.err.find("tick 20: the line is not the one that was written"), std::string::npos)
      << flag.err;
  EXPECT_EQ(changed("\"limit\":\"none\"", "\"limit\":\"inside\"").exitCode, 1);
  EXPECT_EQ(changed("\"way\":[", "\"way\": [").exitCode, 1);
  // A tick that is left out, and a file that was cut off.
  const std::size_t tick = whole.find("{\"tick\":20,"), next = whole.find("{\"tick\":21,");
  world_.folder.write("shown.jsonl", whole.substr(0, tick) + whole.substr(next));
  EXPECT_EQ(check().exitCode, 1);
  world_.folder.write("shown.jsonl", whole.substr(0, next));
  const Ended cut = check();
  EXPECT_EQ(cut.exitCode, 1);
  EXPECT_NE(cut.err.find("expected 52 ticks"), std::string::npos) << cut.err;
}

TEST_F(SolidReplay, CheckWantsTheFilesThatItWasMadeWith) {
  ASSERT_EQ(replay().exitCode, 0);
  const Ended other = check({"--avatar", world_.folder / "clip.bvh"});
  EXPECT_EQ(other.exitCode, 2);
  EXPECT_NE(other.err.find("is not the file that"), std::string::npos) << other.err;
  world_.folder.write("wall.obj", std::string(kWallObj) + "# another\n");
  const Ended changed = check();
  EXPECT_EQ(changed.exitCode, 2);
  EXPECT_NE(changed.err.find("expected the mark"), std::string::npos) << changed.err;
  world_.folder.write("shown.jsonl", "{\"format\":\"foretouch-results\"}\n");
  EXPECT_NE(check().err.find("expected shown poses"), std::string::npos);
  world_.folder.write("shown.jsonl", "{\"format\":\"foretouch-solid\",\"version\":2}\n");
  EXPECT_NE(check().err.find("expected version 1, found 2"), std::string::npos);
  world_.folder.write("shown.jsonl", "\x00\xff[[[");
  EXPECT_EQ(check().exitCode, 2);
  EXPECT_EQ(runForetouch({"solid", "check", world_.folder / "none.jsonl"}).exitCode, 2);
}

TEST_F(SolidReplay, RefusesByNameWhatItCannotHonour) {
  const std::pair<std::string, std::string> options[] = {
      {"--fidelity", "exact"}, {"--scope", "objects"}, {"--pass-separating", ""},
      {"--threads", "2"},      {"--ground", "keep"},   {"--ground-angle", "5"}};
  for (const auto& [option, value] : options) {
    std::vector<std::string> more{option};
    if (!value.empty()) more.push_back(value);
    const Ended ended = replay(more);
    EXPECT_EQ(ended.exitCode, 2) << option;
    EXPECT_NE(ended.err.find(option), std::string::npos) << ended.err;
    EXPECT_NE(ended.err.find("--solid"), std::string::npos) << ended.err;
  }
  for (const char* const option : {"--solid-skin", "--catch-up", "--around"}) {
    const Ended ended = runForetouch(world_.replay({"--output", out_, option, "1"}));
    EXPECT_EQ(ended.exitCode, 2) << option;
    EXPECT_NE(ended.err.find(option), std::string::npos) << ended.err;
  }
  const Ended coarse = replay({"--tolerance", "0.01"});
  EXPECT_EQ(coarse.exitCode, 2);
  EXPECT_NE(coarse.err.find("--tolerance"), std::string::npos) << coarse.err;
}

TEST_F(SolidReplay, WritesTheShownMotionAsAClip) {
  const std::string bvh = world_.folder / "shown.bvh";
  ASSERT_EQ(replay({"--bvh", bvh}).exitCode, 0);
  // Played again, it is where it was shown: nothing keeps it from its tracked pose.
  const std::string again = world_.folder / "again.jsonl";
  const Ended ended = runForetouch(
      world_.replay({"--solid", "--output", again}, "wall.obj", "man.json", "shown.bvh"));
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  const std::vector<json> first = linesOf(out_), second = linesOf(again);
  ASSERT_EQ(first.size(), second.size());
  EXPECT_EQ(second.back()["summary"]["states"]["equal"], 52);
}

TEST_F(SolidReplay, ShowsBothBodiesOnThePageAndInTheGlb) {
  const std::string page = world_.folder / "shown.html", glb = world_.folder / "shown.glb";
  const Ended ended = replay({"--report", page, "--glb", glb});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  const std::string html = contentOf(page);
  const std::string mark = "id=\"foretouch-view\">";
  const std::size_t from = html.find(mark) + mark.size();
  const json view = json::parse(html.substr(from, html.find("</script>", from) - from));
  const json& avatar = view["avatars"][0];
  for (const char* const key : {"track", "tracked", "solid"}) EXPECT_TRUE(avatar.contains(key));
  const std::string content = contentOf(glb);
  for (const char* const name : {"\"avatar\"", "\"tracked\"", "\"tracked Hips\""}) {
    EXPECT_NE(content.find(name), std::string::npos) << name;
  }
}

TEST_F(SolidReplay, DemoHasADancerWhoPassesThroughNothing) {
  const Ended ended = runForetouch({"demo", "--solid", "--output", out_});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_NE(ended.out.find("passes through nothing: 817 of 817 ways"), std::string::npos)
      << ended.out;
  EXPECT_NE(contentOf(world_.folder / "shown.html").find("\"solid\""), std::string::npos);
}

}  // namespace
}  // namespace foretouch::test
