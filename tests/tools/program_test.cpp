// tests/tools/program_test.cpp: help, exit codes and the small commands of the program.
#include <array>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "assets/avatar/avatar_file.h"
#include "tests/support/holds.h"
#include "tests/tools/program_run.h"
#include "tests/tools/small_world.h"

namespace foretouch::test {
namespace {

TEST(Program, SaysItsVersion) {
  const Ended ended = runForetouch({"--version"});
  EXPECT_EQ(ended.exitCode, 0);
  EXPECT_EQ(ended.out.rfind("foretouch ", 0), 0u) << ended.out;
  EXPECT_EQ(ended.err, "");
}

TEST(Program, HelpsWithEverySubcommandAndGivesAnExample) {
  const Ended top = runForetouch({"--help"});
  EXPECT_EQ(top.exitCode, 0);
  for (const std::string command : {"demo", "replay", "avatar", "scene", "sweep"}) {
    EXPECT_TRUE(holds(top.out, "\n  " + command)) << command;
  }
  for (const std::vector<std::string>& command :
       std::vector<std::vector<std::string>>{{"demo", "--help"},
                                             {"replay", "--help"},
                                             {"avatar", "bvh", "--help"},
                                             {"avatar", "mesh", "--help"},
                                             {"avatar", "urdf", "--help"},
                                             {"avatar", "check", "--help"},
                                             {"avatar", "pairs", "--help"},
                                             {"scene", "check", "--help"},
                                             {"log", "info", "--help"}}) {
    const Ended ended = runForetouch(command);
    EXPECT_EQ(ended.exitCode, 0);
    EXPECT_TRUE(holds(ended.out, "Example")) << ended.out;
    EXPECT_TRUE(holds(ended.out, "\n  foretouch " + command[0])) << ended.out;
    EXPECT_EQ(ended.err, "");
  }
  const Ended replay = runForetouch({"replay", "--help"});
  for (const char* option :
       {"--scene ", "--avatar ", "--motion ", "--animation ", "--robot ", "--package ", "--rate ",
        "--clip-scale ", "--clip-up ", "--scene-up ", "--scene-scale ", "--place ", "--fidelity ",
        "--tolerance ", "--threads ", "--ignore ", "--map ", "-o,--output "}) {
    EXPECT_TRUE(holds(replay.out, std::string("\n  ") + option)) << option;
  }
  for (const char* gone :
       {"--culler", "--leaves", "--compare-", "--rays", " --scale", " --motion-up", " --up"}) {
    EXPECT_FALSE(holds(replay.out, gone)) << gone;
  }
}

TEST(Program, EndsWithTwoOnBadUse) {
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"dance"},
                                             {"avatar"},
                                             {"scene"},
                                             {"replay"},
                                             {"replay", "--scene"},
                                             {"demo", "extra"},
                                             {"avatar", "check"},
                                             {"avatar", "check", "a.json", "--map", "m.json"},
                                             {"--bogus"}}) {
    const Ended ended = runForetouch(arguments);
    EXPECT_EQ(ended.exitCode, 2);
    EXPECT_EQ(ended.out, "");
    EXPECT_EQ(ended.err.rfind("foretouch: ", 0), 0u) << ended.err;
    EXPECT_TRUE(holds(ended.err, " --help\n")) << ended.err;
  }
}

TEST(Program, HelpsWhoeverTypesNothingAndEndsWithTwo) {
  const Ended ended = runForetouch({});
  EXPECT_EQ(ended.exitCode, 2);
  EXPECT_EQ(ended.out, runForetouch({"--help"}).out);
  EXPECT_EQ(ended.err, "");
}

TEST(Program, NamesWhatWasTypedAndWhatWasMeant) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{"replya"}, "unknown command 'replya'; did you mean 'replay'? See foretouch --help"},
      {{"help", "replya"}, "unknown command 'replya'; did you mean 'replay'?"},
      {{"avatar", "chek"}, "avatar: unknown command 'chek'; did you mean 'check'?"},
      {{"avatar"}, "avatar: expected a command: bvh mesh urdf check pairs"},
      {{"replay", "-o", "x.jsonl"}, "replay: --scene, --avatar and --motion are required"},
      {{"avatar", "bvh", "x.bvh"}, "avatar bvh: --output is required"},
      {{"scene", "check", "X", "--scale", "0.01"},
       "scene check: unknown option '--scale'; did you mean '--scene-scale'?"},
      {{"scene", "check"}, "scene check: expected a scene file"},
      {{"demo", "extra"}, "demo: expected no argument 'extra'"}};
  for (const auto& [arguments, expected] : cases) {
    const Ended ended = runForetouch(arguments);
    EXPECT_EQ(ended.exitCode, 2);
    EXPECT_EQ(ended.err.rfind("foretouch: " + expected, 0), 0u) << ended.err;
  }
}

TEST(Program, HelpsByEveryUsualWord) {
  const std::string help = runForetouch({"replay", "--help"}).out;
  EXPECT_EQ(runForetouch({"help", "replay"}).out, help);
  EXPECT_EQ(runForetouch({"avatar", "help"}).out, runForetouch({"help", "avatar"}).out);
  const std::string version = runForetouch({"--version"}).out;
  for (const char* const word : {"-V", "version"}) EXPECT_EQ(runForetouch({word}).out, version);
  EXPECT_TRUE(holds(runForetouch({"--help-all"}).out, help));
  for (const char* const title :
       {"Input:", "Units, axes and place:", "What touches:", "Output:", "Effort:", "General:"}) {
    EXPECT_TRUE(holds(help, std::string("\n") + title + "\n")) << title;
  }
  std::istringstream lines(help);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80u) << line;
}

TEST(Program, TakesTheFormerNamesOfOptions) {
  const SmallWorld world;
  const std::string scene = world.folder / "wall.obj";
  EXPECT_EQ(runForetouch({"scene", "check", scene, "--up", "z"}).out,
            runForetouch({"scene", "check", scene, "--scene-up", "z"}).out);
  const std::string out = world.folder / "out.jsonl";
  std::vector<std::string> before, now;
  for (auto [words, names] :
       {std::pair(&before, std::array{"--scale", "--up", "--motion-up"}),
        std::pair(&now, std::array{"--clip-scale", "--scene-up", "--clip-up"})}) {
    const Ended ended = runForetouch(
        world.replay({"--output", out, names[0], "0.5", names[1], "y", names[2], "y"}));
    EXPECT_EQ(ended.exitCode, 0) << ended.err;
    const std::string results = contentOf(out);
    words->push_back(results.substr(0, results.find('\n')));  // the rest has latencies
  }
  EXPECT_EQ(before, now);
  EXPECT_TRUE(holds(now.front(), "\"scale\":0.5")) << now.front().substr(0, 400);
}

TEST(Program, EndsWithTwoWhereItsOutputDoesNotArrive) {
  ProgramRun run({"--help"}, {}, "/dev/full");
  const Ended ended = run.ended();
  EXPECT_EQ(ended.exitCode, 2);
  EXPECT_TRUE(holds(ended.err, "standard output")) << ended.err;
}

TEST(AvatarBvh, MakesAnAvatarThatTheCheckAccepts) {
  const SmallWorld world;
  const std::string made = world.folder / "made.json";
  // Its bones measure 0.3 and 0.5 units; doubled, they make something of plausible size.
  const Ended make =
      runForetouch({"avatar", "bvh", world.folder / "clip.bvh", "--scale", "2", "-o", made});
  EXPECT_EQ(make.exitCode, 0) << make.err;
  const auto avatar = readAvatarFile(made);
  ASSERT_TRUE(avatar.ok());
  EXPECT_EQ(avatar.value().skeleton().name(1), "Arm");
  EXPECT_EQ(avatar.value().skeleton().restOffset(1), Eigen::Vector3d(0, 0.6, 0));

  const Ended check = runForetouch({"avatar", "check", made});
  EXPECT_EQ(check.exitCode, 0) << check.err;
  EXPECT_TRUE(holds(check.out, "links")) << check.out;
  const Ended matched = runForetouch(
      {"avatar", "check", made, "--motion", world.folder / "clip.bvh", "--scale", "2"});
  EXPECT_EQ(matched.exitCode, 0) << matched.err;
  EXPECT_TRUE(holds(matched.out, "2 of 2")) << matched.out;
}

TEST(AvatarBvh, MultipliesRadii) {
  const SmallWorld world;
  std::vector<double> radii;
  for (const std::string scale : {"1", "0.5"}) {
    const std::string made = world.folder / "made.json";
    ASSERT_EQ(runForetouch(
                  {"avatar", "bvh", world.folder / "clip.bvh", "--radius-scale", scale, "-o", made})
                  .exitCode,
              0);
    const Avatar avatar = readAvatarFile(made).value();
    for (LinkId link = 0; link < avatar.numLinks(); ++link) {
      for (const Lss& lss : avatar.lss(link)) radii.push_back(lss.radius);
    }
  }
  ASSERT_GE(radii.size(), 2u);
  EXPECT_NEAR(radii[radii.size() / 2], 0.5 * radii[0], 1e-15);
}

TEST(AvatarBvh, RefusesBadInputAndLeavesNothing) {
  const SmallWorld world;
  world.folder.write("broken.bvh", "HIERARCHY\nROOT");
  const auto before = world.folder.names();
  const std::string made = world.folder / "made.json";
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {"avatar", "bvh", world.folder / "broken.bvh", "-o", made},
           {"avatar", "bvh", world.folder / "absent.bvh", "-o", made},
           {"avatar", "bvh", world.folder / "clip.bvh", "-o", world.folder / "clip.bvh"},
           {"avatar", "bvh", world.folder / "clip.bvh", "-o", world.folder / "no/made.json"},
           {"avatar", "bvh", world.folder / "clip.bvh", "-o", made, "--scale", "0"},
           {"avatar", "bvh", world.folder / "clip.bvh", "-o", made, "--radius-scale", "nan"},
           {"avatar", "bvh", world.folder / "clip.bvh"}}) {
    const Ended ended = runForetouch(arguments);
    EXPECT_EQ(ended.exitCode, 2) << ended.err;
    EXPECT_EQ(ended.err.rfind("foretouch: ", 0), 0u) << ended.err;
    EXPECT_EQ(world.folder.names(), before);
  }
  EXPECT_EQ(contentOf(world.folder / "clip.bvh"), clipThroughWall());
}

TEST(AvatarCheck, SaysNoToUnlikelySizesAndToClipsThatDoNotMatch) {
  const SmallWorld world;
  const Ended plain = runForetouch({"avatar", "check", world.folder / "man.json"});
  EXPECT_EQ(plain.exitCode, 0) << plain.err;

  std::string big = kManAvatar;
  big.replace(big.find("0,0.5,0"), 7, "0,500,0");
  const Ended inCentimetres =
      runForetouch({"avatar", "check", world.folder.write("big.json", big)});
  EXPECT_EQ(inCentimetres.exitCode, 1);
  EXPECT_TRUE(holds(inCentimetres.err, "is the unit")) << inCentimetres.err;

  std::string other = clipThroughWall();
  other.replace(other.find("Hips"), 4, "Root");
  const std::string half = world.folder.write("half.bvh", other);
  const Ended partly =
      runForetouch({"avatar", "check", world.folder / "man.json", "--motion", half});
  EXPECT_EQ(partly.exitCode, 0) << partly.err;
  EXPECT_TRUE(holds(partly.out, "1 of 2")) << partly.out;
  EXPECT_TRUE(holds(partly.out, "'Root'")) << partly.out;
  const Ended mapped =
      runForetouch({"avatar", "check", world.folder / "man.json", "--motion", half, "--map",
                    world.folder.write("map.json", R"({"Hips": "Root"})")});
  EXPECT_TRUE(holds(mapped.out, "2 of 2")) << mapped.out << mapped.err;

  other.replace(other.find("Arm"), 3, "Leg");
  const Ended none = runForetouch({"avatar", "check", world.folder / "man.json", "--motion",
                                   world.folder.write("none.bvh", other)});
  EXPECT_EQ(none.exitCode, 1);
  EXPECT_TRUE(holds(none.err, "no joint of the avatar")) << none.err;

  EXPECT_EQ(runForetouch({"avatar", "check", world.folder / "absent.json"}).exitCode, 2);
}

/// A person of 1.8 m by the length of the legs, in centimetres.
std::string personInCentimetres() {
  std::string text =
      "HIERARCHY\nROOT Hips\n{\n OFFSET 0 0 0\n"
      " CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n";
  for (const auto& [side, x] : {std::pair("Left", "10"), std::pair("Right", "-10")}) {
    const std::string turns = " CHANNELS 3 Zrotation Xrotation Yrotation\n";
    text += std::string(" JOINT ") + side + "UpLeg\n {\n OFFSET " + x + " 0 0\n" + turns +
            " JOINT " + side + "Leg\n {\n OFFSET 0 -45 0\n" + turns + " JOINT " + side +
            "Foot\n {\n OFFSET 0 -43 0\n" + turns +
            " End Site\n {\n OFFSET 0 0 15\n }\n }\n }\n }\n";
  }
  text +=
      " JOINT Spine\n {\n OFFSET 0 10 0\n CHANNELS 3 Zrotation Xrotation Yrotation\n"
      " JOINT Head\n {\n OFFSET 0 50 0\n CHANNELS 3 Zrotation Xrotation Yrotation\n"
      " End Site\n {\n OFFSET 0 20 0\n }\n }\n }\n}\nMOTION\nFrames: 2\nFrame Time: 0.1\n";
  for (int i = 0; i < 60; ++i) text += i % 30 == 29 ? "0\n" : "0 ";  // 6 of the hips, 3 of 8 joints
  return text;
}

TEST(AvatarCheck, SaysNoToAPersonInAnotherUnit) {
  const TempFolder folder;
  const std::string clip = folder.write("person.bvh", personInCentimetres());
  const auto checked = [&](const std::string& scale, const std::string& name) {
    const Ended make = runForetouch({"avatar", "bvh", clip, "--scale", scale, "-o", folder / name});
    EXPECT_EQ(make.exitCode, 0) << make.err;
    return runForetouch({"avatar", "check", folder / name});
  };
  const Ended right = checked("0.01", "right.json");
  EXPECT_EQ(right.exitCode, 0) << right.err;
  // 0.66 m by legs, and a box that a child of a year would fill.
  const Ended wrong = checked("0.00369", "wrong.json");
  EXPECT_EQ(wrong.exitCode, 1) << wrong.out;
  EXPECT_TRUE(holds(wrong.err, "is 0.663 m tall, by the length of its legs; expected 0.8 to 2.5 m"))
      << wrong.err;
  // The clip's unit is told by the avatar's.
  const std::vector<std::string> match{"avatar",   "check", folder / "right.json",
                                       "--motion", clip,    "--scale"};
  std::vector<std::string> good = match, bad = match;
  good.emplace_back("0.01");
  bad.emplace_back("1");
  EXPECT_EQ(runForetouch(good).exitCode, 0);
  const Ended ended = runForetouch(bad);
  EXPECT_EQ(ended.exitCode, 1);
  EXPECT_TRUE(holds(ended.err, "its bones are 100 times as long as the avatar's")) << ended.err;
}

TEST(SceneCheck, MeasuresObjectsAndSize) {
  const SmallWorld world;
  const Ended ended = runForetouch({"scene", "check", world.folder / "wall.obj"});
  EXPECT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_TRUE(holds(ended.out, "18 x 7 x 18 m")) << ended.out;
  EXPECT_TRUE(holds(ended.out, "2  'wall'")) << ended.out;
  EXPECT_TRUE(holds(ended.out, "2  'floor'")) << ended.out;
  const Ended turned = runForetouch(
      {"scene", "check", world.folder / "wall.obj", "--up", "z", "--scene-scale", "10"});
  EXPECT_TRUE(holds(turned.out, "180 x 180 x 70 m")) << turned.out;
}

TEST(SceneCheck, SaysNoToUnlikelySizesAndTwoToBadFiles) {
  const SmallWorld world;
  const Ended tiny =
      runForetouch({"scene", "check", world.folder / "wall.obj", "--scene-scale", "0.01"});
  EXPECT_EQ(tiny.exitCode, 1);
  EXPECT_TRUE(holds(tiny.err, "is the unit")) << tiny.err;
  EXPECT_EQ(runForetouch({"scene", "check", world.folder / "absent.obj"}).exitCode, 2);
  EXPECT_EQ(runForetouch({"scene", "check", world.folder / "wall.obj", "--up", "q"}).exitCode, 2);
}

}  // namespace
}  // namespace foretouch::test
