// tests/tools/commands/self_program_test.cpp: own links, from `foretouch avatar pairs` to
// `foretouch replay --self`.
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/holds.h"
#include "tests/tools/program_run.h"
#include "tests/tools/small_inputs.h"
#include "tests/tools/small_world.h"
#include "tests/tools/stream/stream_lines.h"

namespace foretouch::test {
namespace {

using nlohmann::json;

/// Two spheres of 0.05 m under a trunk, the right one at x = -0.2, the left one at `leftX`.
std::string handsAvatar(double leftX = 0.5) {
  return R"({"format":"foretouch-avatar","version":1,"links":[
{"name":"Trunk","parent":null,"offset":[0,1,0],"lss":[{"a":[0,0,0],"b":[0,0,0],"radius":0.1}]},
{"name":"LeftHand","parent":"Trunk","offset":[)" +
         std::to_string(leftX) + R"(,-1,0],"lss":[{"a":[0,0,0],"b":[0,0,0],"radius":0.05}]},
{"name":"RightHand","parent":"Trunk","offset":[-0.2,-1,0],
 "lss":[{"a":[0,0,0],"b":[0,0,0],"radius":0.05}]}
]})";
}

/// The left hand at the given places along x, ten frames per second; the rest stands still.
std::string handsClip(const std::vector<double>& places) {
  std::string text =
      "HIERARCHY\nROOT Trunk\n{\n  OFFSET 0 1 0\n"
      "  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n"
      "  JOINT LeftHand\n  {\n    OFFSET 0.5 -1 0\n    CHANNELS 1 Xposition\n"
      "    End Site\n    {\n      OFFSET 0 -0.1 0\n    }\n  }\n"
      "  JOINT RightHand\n  {\n    OFFSET -0.2 -1 0\n"
      "    CHANNELS 3 Zrotation Xrotation Yrotation\n"
      "    End Site\n    {\n      OFFSET 0 -0.1 0\n    }\n  }\n}\nMOTION\n";
  text += "Frames: " + std::to_string(places.size()) + "\nFrame Time: 0.1\n";
  for (const double x : places) text += "0 1 0 0 0 0 " + std::to_string(x) + " 0 0 0\n";
  return text;
}

/// Through the right hand in the first step, and away in the second. Beside the wall, so that the
/// scene is never touched.
class Hands : public SmallWorld {
 public:
  Hands() {
    folder.write("hands.json", handsAvatar());
    folder.write("hands.bvh", handsClip({0.5, -0.7, -0.8}));
  }
  [[nodiscard]] std::vector<std::string> replayed(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = replay(more, "wall.obj", "hands.json", "hands.bvh");
    arguments.insert(arguments.end(), {"--place", "0,0,7", "--output", out});
    return arguments;
  }
  [[nodiscard]] std::vector<json> lines() const {
    std::vector<json> lines;
    std::istringstream stream(contentOf(out));
    for (std::string line; std::getline(stream, line);) {
      if (!isOfTouches(line)) lines.push_back(json::parse(line));
    }
    return lines;
  }
  std::string out = folder / "out.jsonl";
};

TEST(SelfReplay, FindsOwnContactsBetweenThePoses) {
  const Hands world;
  const Ended ended = runForetouch(world.replayed({"--self"}));
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_TRUE(holds(ended.err,
                    "--self: 2 of 3 pairs of own links are left out, so nothing is said "
                    "of them (2 adjacent); list them: foretouch avatar pairs "))
      << ended.err;
  EXPECT_TRUE(holds(ended.out, "own pairs asked                1   of 3 pairs of own links\n"))
      << ended.out;
  EXPECT_TRUE(holds(ended.out, "steps with own contact         1   50.0 %\n")) << ended.out;
  EXPECT_TRUE(holds(ended.out, "own contacts                   1\n")) << ended.out;
  EXPECT_TRUE(holds(ended.out, "\nLeftHand                 RightHand                         1"))
      << ended.out;

  const std::vector<json> lines = world.lines();
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[0]["self"]["pairs"], 3);
  EXPECT_EQ(lines[0]["self"]["asked"], 1);
  EXPECT_EQ(lines[0]["self"]["radii"], 0);
  EXPECT_EQ(lines[0]["self"]["left_out"].size(), 2u);
  EXPECT_EQ(lines[0]["self"]["left_out"][0],
            json({{"a", "Trunk"}, {"b", "LeftHand"}, {"reason", "adjacent"}}));
  EXPECT_EQ(lines[0]["self"].count("file"), 0u);
  ASSERT_EQ(lines[1]["pairs"].size(), 1u);
  EXPECT_EQ(lines[1]["contacts"].size(), 0u);
  EXPECT_EQ(lines[2]["pairs"].size(), 0u);
  const json contact = lines[1]["pairs"][0];
  EXPECT_EQ(contact["link"], "LeftHand");
  EXPECT_EQ(contact["other"], "RightHand");
  EXPECT_EQ(contact["verdict"], "contact");
  // 0.5 - 1.2 t is 0.1 from -0.2 at t = 0.5.
  EXPECT_LE(contact["toi"].get<double>(), 0.5 + 1e-12);
  EXPECT_GE(contact["toi"].get<double>(), 0.5 - 1e-3 / 1.2 - 1e-9);
  EXPECT_NEAR(contact["time"].get<double>(), 0.1 * contact["toi"].get<double>(), 1e-15);
  EXPECT_LE(contact["separation"].get<double>(), 1e-3);
  EXPECT_NEAR(contact["normal"][0].get<double>(), 1.0, 1e-9);
  EXPECT_NEAR(contact["point"][0].get<double>(), -0.15, 1e-9);
  EXPECT_NEAR(contact["point"][2].get<double>(), 7.0, 1e-9);
  EXPECT_EQ(contact.count("object"), 0u);
  EXPECT_EQ(contact.count("triangle"), 0u);
}

TEST(SelfReplay, ChangesNothingWhereItIsNotAsked) {
  const Hands world;
  ASSERT_EQ(runForetouch(world.replayed({})).exitCode, 0);
  const std::vector<json> without = world.lines();
  ASSERT_EQ(runForetouch(world.replayed({"--self"})).exitCode, 0);
  std::vector<json> with = world.lines();
  ASSERT_EQ(with.size(), without.size());
  EXPECT_EQ(without[0].count("self"), 0u);
  with[0].erase("self");
  EXPECT_EQ(with[0], without[0]);
  for (std::size_t i = 1; i < with.size(); ++i) {
    EXPECT_EQ(without[i].count("pairs"), 0u);
    EXPECT_EQ(with[i].erase("pairs"), 1u);
    with[i]["latency_us"] = without[i]["latency_us"];
    EXPECT_EQ(with[i], without[i]);
  }
}

TEST(SelfReplay, WritesTheSameBytesForAnyThreads) {
  const Hands world;
  std::vector<double> places;
  for (int i = 0; i < 300; ++i) places.push_back((i % 3 - 1) * (0.4 + 1e-4 * i));
  world.folder.write("hands.bvh", handsClip(places));
  std::string first;
  for (const char* threads : {"1", "2", "4"}) {
    ASSERT_EQ(runForetouch(world.replayed({"--self", "--threads", threads})).exitCode, 0);
    std::string text;
    for (json line : world.lines()) {
      line.erase("latency_us");
      text += line.dump() + "\n";
    }
    if (first.empty()) first = text;
    EXPECT_EQ(text, first) << threads;
  }
  EXPECT_TRUE(holds(first, "\"other\"")) << first.substr(0, 1000);
}

TEST(SelfReplay, TakesTheRulesOfAFile) {
  const Hands world;
  const std::string pairs = world.folder / "hands.pairs.json";
  const Ended made = runForetouch({"avatar", "pairs", world.folder / "hands.json", "--clip",
                                   world.folder / "hands.bvh", "-o", pairs});
  ASSERT_EQ(made.exitCode, 0) << made.err;
  const Ended ended = runForetouch(world.replayed({"--self", "--pairs", pairs}));
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_EQ(ended.err, "");
  EXPECT_EQ(world.lines()[0]["self"]["file"], "hands.pairs.json");
  EXPECT_EQ(world.lines()[1]["pairs"].size(), 1u);

  // All pairs but the one that meets.
  world.folder.write("other.json", R"({"format":"foretouch-pairs","version":1,"left_out":[)"
                                   R"({"a":"RightHand","b":"LeftHand","reason":"user"}]})");
  ASSERT_EQ(
      runForetouch(world.replayed({"--self", "--pairs", world.folder / "other.json"})).exitCode, 0);
  EXPECT_EQ(world.lines()[0]["self"]["asked"], 2);
  EXPECT_EQ(world.lines()[1]["pairs"].size(), 0u);
}

TEST(SelfReplay, RefusesByNameWhatCannotBeHonoured) {
  const Hands world;
  world.folder.write("overlap.json", handsAvatar(-0.12));
  const std::string radii = world.folder / "radii.json";
  ASSERT_EQ(
      runForetouch({"avatar", "pairs", world.folder / "overlap.json", "--pair-radii", "-o", radii})
          .exitCode,
      0);
  world.folder.write("man.pairs.json",
                     R"({"format":"foretouch-pairs","version":1,)"
                     R"("left_out":[{"a":"Trunk","b":"LeftHnd","reason":"adjacent"}]})");
  const std::vector<std::pair<std::vector<std::string>, std::string>> trials = {
      {{"--self", "--fidelity", "skinned", "--skin", "x.glb"},
       "--self: expected --fidelity link or exact, found skinned"},
      {{"--self", "--scope", "avatar"}, "--self: expected --scope links or objects, found avatar"},
      {{"--pairs", radii}, "--pairs requires --self"},
      {{"--self", "--pairs", "absent.json"}, "absent.json: "},
      {{"--self", "--pairs", world.folder / "man.pairs.json"},
       "man.pairs.json:1: left_out[0]: expected a link of the avatar for \"b\", found 'LeftHnd'; "
       "did you mean 'LeftHand'"},
      {{"--self", "--avatar", world.folder / "hands.json"}, "--avatar"},
  };
  for (const auto& [options, expected] : trials) {
    const Ended ended = runForetouch(world.replayed(options));
    EXPECT_EQ(ended.exitCode, 2) << options.back();
    EXPECT_TRUE(holds(ended.err, expected)) << ended.err;
  }
  std::vector<std::string> exact =
      world.replay({"--self", "--pairs", radii, "--fidelity", "exact", "--output", world.out},
                   "wall.obj", "overlap.json", "hands.bvh");
  EXPECT_TRUE(holds(runForetouch(exact).err,
                    "--pairs: expected rules without pair radii at exact fidelity"));
  const Ended none = runForetouch(SmallWorld().replay({"--self", "--output", world.out}));
  EXPECT_EQ(none.exitCode, 2);
  EXPECT_TRUE(holds(none.err, "--self: expected at least one pair of links to ask")) << none.err;
}

/// Two plates, 80 mm apart, on both ends of a pin, and a knob on them: the LSS around the plates
/// overlap.
std::string platesUrdf() {
  const auto link = [](const std::string& name, const std::string& shape) {
    return "<link name=\"" + name + "\"><collision><geometry>" + shape +
           "</geometry></collision></link>";
  };
  const auto turn = [](const std::string& parent, const std::string& child) {
    return "<joint name=\"to_" + child + "\" type=\"revolute\"><parent link=\"" + parent +
           "\"/><child link=\"" + child +
           "\"/><origin xyz=\"0 0 0.05\"/><axis xyz=\"0 0 1\"/><limit lower=\"-0.1\" "
           "upper=\"0.1\" effort=\"1\" velocity=\"1\"/></joint>";
  };
  const std::string plate = "<box size=\"0.4 0.4 0.02\"/>";
  return "<robot name=\"plates\">" + link("low", plate) + link("pin", "<sphere radius=\"0.01\"/>") +
         link("high", plate) + link("knob", "<sphere radius=\"0.01\"/>") + turn("high", "knob") +
         turn("low", "pin") + turn("pin", "high") + "</robot>";
}

TEST(SelfReplay, HintsAtMeshesThatAreApartThoughTheirLssTouch) {
  const SmallWorld world;
  const TempFolder& folder = world.folder;
  folder.write("plates.urdf", platesUrdf());
  folder.write("turn.csv", "time,to_high\n0,0\n1,0.1\n");
  const Ended made =
      runForetouch({"avatar", "urdf", folder / "plates.urdf", "-o", folder / "plates.json"});
  ASSERT_EQ(made.exitCode, 0) << made.err;
  std::vector<std::string> exact =
      world.replay({"--self", "--fidelity", "exact", "--robot", folder / "plates.urdf", "--output",
                    folder / "out.jsonl"},
                   "wall.obj", "plates.json", "turn.csv");
  const Ended ended = runForetouch(exact);
  EXPECT_TRUE(holds(ended.err,
                    "--self: 1 pair of own links is left out because their LSS touch, though "
                    "their meshes are apart at each of 2 poses: 'low:high'; to ask"))
      << ended.err;
}

TEST(SelfReplay, HintsAtPairsThatOnlyTheirLssMakeTouch) {
  const SmallWorld world;
  const TempFolder& folder = world.folder;
  folder.write("plates.urdf", platesUrdf());
  folder.write("turn.csv", "time,to_high\n0,0\n1,0.1\n");
  const Ended made =
      runForetouch({"avatar", "urdf", folder / "plates.urdf", "-o", folder / "plates.json"});
  ASSERT_EQ(made.exitCode, 0) << made.err;
  // All pairs are asked but those that are one beside the other.
  folder.write("all.json",
               R"({"format":"foretouch-pairs","version":1,"left_out":[
{"a":"low","b":"pin","reason":"adjacent"},{"a":"pin","b":"high","reason":"adjacent"},
{"a":"high","b":"knob","reason":"adjacent"}]})");
  const auto replayed = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"--self", "--robot", folder / "plates.urdf", "--output",
                                       folder / "out.jsonl"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return runForetouch(world.replay(arguments, "wall.obj", "plates.json", "turn.csv"));
  };
  const Ended thick = replayed({"--pairs", folder / "all.json"});
  ASSERT_EQ(thick.exitCode, 0) << thick.err;
  EXPECT_TRUE(holds(thick.err,
                    "--self: 1 pair of own links starts in contact by LSS in up to 1 of 1 steps, "
                    "though their meshes are apart at each of 2 poses; leave them out: foretouch "
                    "avatar pairs "))
      << thick.err;
  EXPECT_TRUE(holds(thick.err, "--leave-out 'low:high' -o own.pairs.json, then --pairs"))
      << thick.err;
  // The hint's own words do it.
  const Ended written =
      runForetouch({"avatar", "pairs", folder / "plates.json", "--robot", folder / "plates.urdf",
                    "--leave-out", "low:high", "-o", folder / "own.pairs.json"});
  ASSERT_EQ(written.exitCode, 0) << written.err;
  const Ended rid = replayed({"--pairs", folder / "own.pairs.json"});
  EXPECT_EQ(rid.exitCode, 0) << rid.err;
  EXPECT_FALSE(holds(rid.err, "start in contact by LSS")) << rid.err;
}

/// A box that slides along x into another one: at 0.75 m by 50 mm, at 0.76 m by 60 mm.
std::string boxesUrdf() {
  return R"(<robot name="boxes">
<link name="base"><collision><geometry><box size="0.4 0.4 0.4"/></geometry></collision></link>
<link name="pin"><collision><geometry><sphere radius="0.01"/></geometry></collision></link>
<link name="box"><collision><geometry><box size="0.2 0.2 0.2"/></geometry></collision></link>
<joint name="up" type="fixed"><parent link="base"/><child link="pin"/><origin xyz="0 0 1"/></joint>
<joint name="slide" type="prismatic"><parent link="pin"/><child link="box"/><origin xyz="-1 0 -1"/>
<axis xyz="1 0 0"/><limit lower="0" upper="1" effort="1" velocity="1"/></joint></robot>)";
}

TEST(SelfReplay, TellsHowDeepMeshesBeginInEachOther) {
  const SmallWorld world;
  const TempFolder& folder = world.folder;
  folder.write("boxes.urdf", boxesUrdf());
  folder.write("slide.csv", "time,slide\n0,0.2\n1,0.75\n2,0.76\n3,0.1\n");
  const Ended made =
      runForetouch({"avatar", "urdf", folder / "boxes.urdf", "-o", folder / "boxes.json"});
  ASSERT_EQ(made.exitCode, 0) << made.err;
  const Ended ended =
      runForetouch(world.replay({"--self", "--fidelity", "exact", "--robot", folder / "boxes.urdf",
                                 "--output", folder / "out.jsonl"},
                                "wall.obj", "boxes.json", "slide.csv"));
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_TRUE(holds(ended.out, "deepest, mm\n")) << ended.out;
  EXPECT_TRUE(holds(ended.out, " 60.0\n")) << ended.out;
  std::istringstream stream(contentOf(folder / "out.jsonl"));
  std::vector<double> deep;
  for (std::string line; std::getline(stream, line);) {
    const json read = json::parse(line);
    if (read.count("touch") != 0 && read["touch"].count("other") != 0) {
      EXPECT_NEAR(read["touch"]["penetration"].get<double>(), 0.06, 1e-6);
    }
    if (read.count("pairs") == 0) continue;
    for (const json& pair : read["pairs"]) {
      if (pair["verdict"] != "starts_in_contact") continue;
      const double least = pair["penetration"], most = pair["penetration_at_most"];
      EXPECT_LE(least, most);
      EXPECT_NEAR(least, most, 1e-6);
      deep.push_back(least);
    }
  }
  ASSERT_EQ(deep.size(), 2u);
  EXPECT_NEAR(deep[0], 0.05, 1e-6);
  EXPECT_NEAR(deep[1], 0.06, 1e-6);
}

TEST(AvatarPairs, ListsEveryHoleWithItsReason) {
  const Hands world;
  const Ended ended = runForetouch({"avatar", "pairs", world.folder / "hands.json"});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_TRUE(holds(ended.out, "  pairs of links           3\n")) << ended.out;
  EXPECT_TRUE(holds(ended.out, "    asked                  1\n")) << ended.out;
  EXPECT_TRUE(holds(ended.out, "    left out               2: 2 adjacent\n")) << ended.out;
  EXPECT_TRUE(holds(ended.out, "each is a hole in the proof")) << ended.out;
  EXPECT_TRUE(holds(ended.out, "  Trunk                    LeftHand                 adjacent\n"))
      << ended.out;
}

TEST(AvatarPairs, LooksAtUsualPosesOfAClipAndOfTheClipThatIsTheAvatar) {
  const Hands world;
  world.folder.write("clap.bvh", handsClip({-0.15, -0.15, -0.15, 0.5}));
  const std::string avatar = world.folder / "hands.json", clap = world.folder / "clap.bvh";
  const Ended none = runForetouch({"avatar", "pairs", avatar, "--clip", clap});
  EXPECT_EQ(none.exitCode, 0) << none.err;
  EXPECT_TRUE(holds(none.out, "  usual poses              4\n")) << none.out;
  const Ended always =
      runForetouch({"avatar", "pairs", avatar, "--clip", clap, "--always-share", "0.7"});
  EXPECT_EQ(always.exitCode, 2);
  EXPECT_TRUE(holds(always.err, "hands.json: expected at least one pair of links to ask"))
      << always.err;
  const Ended made = runForetouch({"avatar", "pairs", clap});
  EXPECT_EQ(made.exitCode, 0) << made.err;
  EXPECT_TRUE(holds(made.out, "  usual poses              4\n")) << made.out;
}

TEST(AvatarPairs, ListsRadiiAndRefusesBadOptions) {
  const Hands world;
  const std::string overlap = world.folder.write("overlap.json", handsAvatar(-0.12));
  EXPECT_EQ(runForetouch({"avatar", "pairs", overlap}).exitCode, 2);  // nothing is left to ask
  const Ended radii = runForetouch({"avatar", "pairs", overlap, "--pair-radii"});
  EXPECT_EQ(radii.exitCode, 0) << radii.err;
  EXPECT_TRUE(holds(radii.out,
                    "LeftHand [0]             RightHand [0]            0.078 m instead "
                    "of 0.1 m\n"))
      << radii.out;
  const std::string hands = world.folder / "hands.json";
  const std::vector<std::pair<std::vector<std::string>, std::string>> trials = {
      {{"--leave-out", "LeftHnd:Trunk"}, "--leave-out: 'LeftHnd' of"},
      {{"--leave-out", "LeftHand:RightHand"}, "hands.json: expected at least one pair"},
      {{"--rest-skin", "0.01"}, "--rest-skin requires --pair-radii"},
      {{"--pair-radii", "--rest-skin", "0"}, "--rest-skin: expected"},
      {{"--always-share", "0"}, "--always-share: expected"},
      {{"--always-share", "1.5"}, "--always-share: expected"},
      {{"--clip", "absent.bvh"}, "absent.bvh: "},
      {{"-o", hands}, "is an input"},
  };
  for (const auto& [options, expected] : trials) {
    std::vector<std::string> arguments{"avatar", "pairs", hands};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Ended ended = runForetouch(arguments);
    EXPECT_EQ(ended.exitCode, 2) << options.back();
    EXPECT_TRUE(holds(ended.err, expected)) << ended.err;
  }
}

}  // namespace
}  // namespace foretouch::test
