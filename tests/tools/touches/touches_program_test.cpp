// Touches of the program's results, held against a script that counts them from the step lines.
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/shared_data.h"
#include "tests/tools/program_run.h"
#include "tests/tools/small_world.h"
#include "tools/inputs/example_folder.h"

namespace foretouch::test {
namespace {

using nlohmann::json;
using Words = std::vector<std::string>;

std::vector<json> linesOf(const std::string& path) {
  std::vector<json> lines;
  std::istringstream text(contentOf(path));
  for (std::string line; std::getline(text, line);) lines.push_back(json::parse(line));
  return lines;
}

std::vector<json> touchesIn(const std::string& path) {
  std::vector<json> touches;
  for (const json& line : linesOf(path)) {
    if (line.count("touch") > 0) touches.push_back(line["touch"]);
  }
  return touches;
}

/// What the script counts, after it has agreed with the file.
json counted(const std::string& results) {
  ProgramRun run({FORETOUCH_SOURCE_DIR "/tests/tools/touches/count_touches.py", results}, {}, "",
                 "python3");
  const Ended ended = run.ended();
  EXPECT_EQ(ended.exitCode, 0) << ended.err;
  std::cout << results.substr(results.rfind('/') + 1) << ": " << ended.out;
  return ended.exitCode == 0 ? json::parse(ended.out) : json();
}

TEST(TouchesProgram, WritesATouchALineBehindTheSteps) {
  const SmallWorld world;
  // Into the wall in step 1, in it for two poses, out of it, and through it on the way back.
  world.folder.write("clip.bvh", clipAlongX({-0.5, -0.25, 0.02, 0.03, 0.5, 0.75, -0.75, -0.8}));
  const std::string out = world.folder / "out.jsonl";
  const Ended ended = runForetouch(world.replay({"--output", out}));
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_NE(
      ended.out.find("The man touches the wall 4 times. Checking the poses alone would miss 2 "
                     "of them.\n"),
      std::string::npos)
      << ended.out;
  const std::vector<json> touches = touchesIn(out), lines = linesOf(out);
  ASSERT_EQ(touches.size(), 4u);
  const json& first = touches[0];
  EXPECT_EQ(first["link"], "Hips");
  EXPECT_EQ(first["object"], "wall");
  EXPECT_EQ(first["steps"], json({1, 3}));
  EXPECT_EQ(first["begins"], "contact");
  EXPECT_EQ(first["ends"], "left");
  EXPECT_EQ(first["contacts"], 3);
  EXPECT_EQ(first["begin"], lines[2]["contacts"][0]["time"]);
  // It leaves at 4.7 m/s: where it is farther than nothing, but no farther than twice 1 mm.
  const double apartS = lines[4]["t0"].get<double>() + (0.1 - 0.03) / 4.7;
  EXPECT_GE(first["end"], apartS);
  EXPECT_LE(first["end"], apartS + 0.002 / 4.7 + 1e-9);
  EXPECT_NEAR(first["penetration"].get<double>(), 0.08, 1e-9);
  EXPECT_EQ(first.count("missed"), 0u);
  EXPECT_EQ(touches[3]["missed"], true);
  EXPECT_EQ(touches[3]["steps"], json({5, 5}));
  EXPECT_EQ(lines.back()["summary"], json::parse(R"({"steps":7,"touches":4,"touches_missed":2,
                                                     "touches_ground":0,"followed":true})"));
  EXPECT_EQ(counted(out)["touches"], 4);
}

/// The bundled dancer; returns where the results are.
std::string danced(const TempFolder& folder, const std::string& name, const Words& more,
                   const std::string& rate = "10") {
  const std::string example = tools::exampleFolder().value(), out = folder / name;
  Words words{"replay",
              "--scene",
              example + "/room.obj",
              "--avatar",
              example + "/dancer.avatar.json",
              "--motion",
              example + "/dancer.bvh",
              "--rate",
              rate,
              "--output",
              out};
  words.insert(words.end(), more.begin(), more.end());
  const Ended ended = runForetouch(words);
  EXPECT_EQ(ended.exitCode, 0) << ended.err;
  return out;
}

TEST(TouchesProgram, AgreesWithTheCountOfTheScript) {
  const TempFolder folder;
  EXPECT_GT(counted(danced(folder, "links", {}))["touches"], 100);
  EXPECT_GT(counted(danced(folder, "objects", {"--scope", "objects"}))["touches"], 100);
  EXPECT_GT(counted(danced(folder, "avatar", {"--scope", "avatar"}))["touches"], 30);
  EXPECT_GT(counted(danced(folder, "own", {"--self"}))["told_touches_own"], 0);
  EXPECT_GT(counted(danced(folder, "budget", {"--budget-us", "20"}))["touches"], 30);
  counted(danced(folder, "separating", {"--pass-separating", "--tolerance", "0.02"}));
  EXPECT_GT(counted(danced(folder, "every-pose", {}, "all"))["rows"], 500);
}

TEST(TouchesProgram, CountsTheGroundApartListsItOrNotAndNeverChangesTheSteps) {
  const TempFolder folder;
  std::vector<std::string> files;
  for (const char* use : {"apart", "keep", "ignore"}) {
    files.push_back(danced(folder, use, {"--ground", use}));
  }
  const auto summary = [&](std::size_t i) { return linesOf(files[i]).back()["summary"]; };
  const auto number = [&](std::size_t i, const char* name) { return summary(i)[name].get<int>(); };
  EXPECT_GT(number(0, "touches_ground"), 0);
  EXPECT_EQ(number(1, "touches_ground"), 0);
  EXPECT_EQ(number(1, "touches"), number(0, "touches") + number(0, "touches_ground"));
  EXPECT_EQ(summary(2), summary(0));
  const std::size_t all = touchesIn(files[0]).size();
  EXPECT_EQ(touchesIn(files[1]).size(), all);
  EXPECT_EQ(touchesIn(files[2]).size(),
            all - static_cast<std::size_t>(number(0, "touches_ground")));
  const std::vector<json> apart = linesOf(files[0]), ignored = linesOf(files[2]);
  EXPECT_EQ(ignored[0]["ground"], "ignore");
  EXPECT_EQ(apart[0]["ground_height"], 0.25);
  for (std::size_t i = 1; i < apart.size() && apart[i].count("step") > 0; ++i) {
    EXPECT_EQ(apart[i]["contacts"], ignored[i]["contacts"]);
  }
  counted(files[2]);
}

TEST(TouchesProgram, RefusesGroundThatIsNone) {
  const SmallWorld world;
  for (const auto& [option, value] :
       {std::pair("--ground", "floor"), std::pair("--ground-angle", "91"),
        std::pair("--ground-height", "-1")}) {
    const Ended ended =
        runForetouch(world.replay({"--output", world.folder / "x.jsonl", option, value}));
    EXPECT_EQ(ended.exitCode, 2) << option;
    EXPECT_NE(ended.err.find(option), std::string::npos) << ended.err;
  }
}

/// A real clip of 20 s and more that stands and walks in a real level.
struct Real {
  std::string name, clip, scene;
  Words ofAvatar, ofReplay;
};

json countedIn(const Real& real, const TempFolder& folder, const Words& more) {
  const std::string avatar = folder / (real.name + ".avatar.json"), out = folder / real.name;
  Words make{"avatar", "bvh", real.clip, "-o", avatar};
  make.insert(make.end(), real.ofAvatar.begin(), real.ofAvatar.end());
  const Ended made = runForetouch(make);
  EXPECT_EQ(made.exitCode, 0) << made.err;
  Words words{"replay",   "--scene", real.scene, "--avatar", avatar,
              "--motion", real.clip, "--output", out};
  for (const Words& list : {real.ofAvatar, real.ofReplay, more}) {
    words.insert(words.end(), list.begin(), list.end());
  }
  const Ended ended = runForetouch(words);
  EXPECT_EQ(ended.exitCode, 0) << ended.err;
  const json found = counted(out);
  // A body that stands for 20 s has far more contacts than touches.
  EXPECT_GT(found.value("touches", 0), 20) << real.name;
  EXPECT_GT(found.value("rows", 0), 5 * found.value("touches", 0)) << real.name;
  return found;
}

TEST(TouchesProgram, AgreesWithTheScriptOnJumpsInANavigationLevel) {
  FORETOUCH_REQUIRE_SHARED(clip, "mocap/cmu_01_01_playground_jumps.bvh");
  FORETOUCH_REQUIRE_SHARED(scene, "scenes/nav_test.obj");
  const TempFolder folder;
  countedIn({"jumps", *clip, *scene, {"--scale", "0.0564"}, {"--place", "15,-2.4,2"}}, folder, {});
}

TEST(TouchesProgram, AgreesWithTheScriptOnADanceOnHills) {
  FORETOUCH_REQUIRE_SHARED(clip, "mocap/bandai1_dance-short_normal_001.bvh");
  FORETOUCH_REQUIRE_SHARED(scene, "scenes/undulating.obj");
  const TempFolder folder;
  countedIn({"dance", *clip, *scene, {"--scale", "0.01"}, {"--place", "5011.5,1,5024.4"}}, folder,
            {});
}

TEST(TouchesProgram, AgreesWithTheScriptOnADanceInADungeonObjectByObject) {
  FORETOUCH_REQUIRE_SHARED(clip, "mocap/bandai1_dance-short_normal_001.bvh");
  FORETOUCH_REQUIRE_SHARED(scene, "scenes/dungeon.obj");
  const TempFolder folder;
  countedIn({"dungeon", *clip, *scene, {"--scale", "0.01"}, {"--place", "21.4,9.97,-3.5"}}, folder,
            {"--scope", "objects"});
}

}  // namespace
}  // namespace foretouch::test
