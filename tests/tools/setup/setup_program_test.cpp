// `foretouch setup` as a user runs it: on the bundled example, and on real clips in real levels,
// where the judge's own distances decide whether the body is free and on a floor.
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "articulated/motion.h"
#include "assets/avatar/avatar_file.h"
#include "assets/avatar/joint_match.h"
#include "assets/clip/clip_file.h"
#include "assets/import/scene_import.h"
#include "judge/distance.h"
#include "tests/assets/fbx_writer.h"
#include "tests/support/shared_data.h"
#include "tests/support/temp_folder.h"
#include "tests/tools/feet/robot_walk.h"
#include "tests/tools/program_run.h"
#include "tests/tools/small_world.h"

namespace foretouch::test {
namespace {

using nlohmann::json;

const std::string kExample = FORETOUCH_EXAMPLE_FOLDER;

json setupIn(const TempFolder& folder, const std::string& scene, const std::string& body,
             int exitCode = 0) {
  const Ended ended = runForetouch(
      {"setup", scene, body, "--yes", "--json", "--output", folder / "foretouch.toml"});
  EXPECT_EQ(ended.exitCode, exitCode) << ended.err << ended.out;
  return json::parse(ended.out, nullptr, false);
}

std::string stateOf(const json& answer, const std::string& name) {
  for (const json& check : answer["checks"]) {
    if (check["name"] == name) return check["state"];
  }
  return "no such check";
}

TEST(SetupProgram, TheExampleNeedsThreeCommands) {
  const TempFolder folder;
  const json answer = setupIn(folder, kExample + "/room.obj", kExample + "/dancer.bvh");
  EXPECT_EQ(answer["scene"]["scale"]["value"], 1.0);
  EXPECT_EQ(answer["scene"]["up"]["value"], "y");
  EXPECT_EQ(answer["body"]["scale"]["value"], 1.0);
  EXPECT_EQ(answer["body"]["up"]["value"], "y");
  for (const char* const name : {"start", "floor", "level", "path"}) {
    EXPECT_NE(stateOf(answer, name), "bad") << name;
  }
  const std::string project = folder / "foretouch.toml";
  const Ended view =
      runForetouch({"view", "--project", project, "--output", folder / "v.html", "--json"});
  EXPECT_EQ(view.exitCode, 0) << view.err << view.out;
  const Ended replay = runForetouch(
      {"replay", "--project", project, "--rate", "10", "--output", folder / "contacts.jsonl"});
  EXPECT_EQ(replay.exitCode, 0) << replay.err;
  EXPECT_NE(replay.err.find("settings from"), std::string::npos) << "never in silence";
}

TEST(SetupProgram, AnAnimationWithoutABodyMakesNoCapsulesOfItsCameras) {
  const auto node = [](const char* name, int parent, const Eigen::Vector3d& at) {
    FbxNode made;
    made.name = name;
    made.parent = parent;
    made.translation = at;
    made.rotations[1] = {{0.0, 0.0}, {1.0, 20.0}};
    return made;
  };
  FbxFile file;  // in centimetres
  file.stopS = 1.0;
  file.nodes = {node("Hips", -1, {0, 95, 0}),      node("LeftUpLeg", 0, {9, 0, 0}),
                node("LeftLeg", 1, {0, -45, 0}),   node("LeftFoot", 2, {0, -45, 0}),
                node("RightUpLeg", 0, {-9, 0, 0}), node("RightLeg", 4, {0, -45, 0}),
                node("RightFoot", 5, {0, -45, 0}), node("Spine", 0, {0, 25, 0}),
                node("Head", 7, {0, 40, 0}),       node("Camera", -1, {0, 1400, 600})};
  file.nodes.back().onlooker = "Camera";
  const TempFolder folder;
  const std::string clip = folder.write("walk.fbx", file.text());
  const json answer = setupIn(folder, kExample + "/room.obj", clip);
  EXPECT_NE(answer["notes"].dump().find("holds no mesh"), std::string::npos) << answer["notes"];
  EXPECT_EQ(stateOf(answer, "body's unit"), "good") << answer;
  const Avatar avatar = readAvatarFile(folder / "walk.avatar.json").value();
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    EXPECT_NE(avatar.skeleton().name(link), "Camera");
    for (const Lss& lss : avatar.lss(link)) EXPECT_LT((lss.b - lss.a).norm(), 0.6);
  }
}

/// What was said of the clip is the project's, so that every command plays the same part of it.
TEST(SetupProgram, APartOfAClipIsTheProjects) {
  const TempFolder folder;
  const std::string project = folder / "foretouch.toml";
  const Ended ended =
      runForetouch({"setup", kExample + "/room.obj", kExample + "/dancer.bvh", "--yes", "--json",
                    "--output", project, "--from", "5f", "--to", "2"});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  const Ended replay =
      runForetouch({"replay", "--project", project, "--output", folder / "c.jsonl"});
  ASSERT_EQ(replay.exitCode, 0) << replay.err;
  const std::string header = contentOf(folder / "c.jsonl");
  EXPECT_NE(header.find(R"("from":"5f","to":"2")"), std::string::npos) << header.substr(0, 600);
  const Ended beyond =
      runForetouch({"setup", kExample + "/room.obj", kExample + "/dancer.bvh", "--from", "1e6"});
  EXPECT_EQ(beyond.exitCode, 2);
  EXPECT_NE(beyond.err.find("--from: expected an instant of the clip"), std::string::npos);
}

TEST(SetupProgram, ATPoseIsLeftOutWhereAsked) {
  FORETOUCH_REQUIRE_SHARED(clip, "mocap/cmu_cgspeed_walk_crlf.bvh");
  const Ended whole = runForetouch({"setup", kExample + "/room.obj", *clip});
  EXPECT_NE(whole.out.find("--skip-t-pose leaves it out"), std::string::npos) << whole.out;
  const Ended cut = runForetouch({"setup", kExample + "/room.obj", *clip, "--skip-t-pose"});
  EXPECT_EQ(cut.out.find("T-pose"), std::string::npos) << cut.out;
  EXPECT_NE(cut.err.find("left out a T-pose, the first frame"), std::string::npos) << cut.err;
}

TEST(SetupProgram, ARobotsTableNeedsThreeCommandsToo) {
  const TempFolder folder;
  folder.write("bot.urdf", walkerUrdf());
  std::string rows;
  for (const char* const joint : {"x", "y", "z", "qx", "qy", "qz", "qw"}) {
    rows += std::string(rows.empty() ? "" : ",") + "root_" + joint;
  }
  for (const std::string& joint : walkerJoints()) rows += "," + joint;
  rows += "\n";
  for (int row = 0; row < 3; ++row) {
    rows += std::to_string(0.1 * row) + ",0,1,0,0,0,1";
    for (std::size_t i = 0; i < walkerJoints().size(); ++i) rows += ",0";
    rows += "\n";
  }
  folder.write("walk.csv", rows);
  const std::string project = folder / "foretouch.toml";
  const Ended ended = runForetouch({"setup", kExample + "/room.obj", folder / "walk.csv", "--robot",
                                    folder / "bot.urdf", "--row-rate", "30", "--yes", "--json",
                                    "--output", project});
  ASSERT_EQ(ended.exitCode, 0) << ended.err << ended.out;
  const json answer = json::parse(ended.out, nullptr, false);
  EXPECT_EQ(answer["body"]["scale"]["value"], 1.0) << "its format knows metres alone";
  EXPECT_EQ(answer["body"]["scale"]["said_by"], "file");
  EXPECT_EQ(stateOf(answer, "start"), "good") << answer["checks"];
  const Ended replay =
      runForetouch({"replay", "--project", project, "--output", folder / "c.jsonl", "--json"});
  ASSERT_EQ(replay.exitCode, 0) << replay.err;
  const Ended nameless = runForetouch({"setup", kExample + "/room.obj", folder / "walk.csv"});
  EXPECT_EQ(nameless.exitCode, 2);
  EXPECT_NE(nameless.err.find("expected its URDF (--robot FILE)"), std::string::npos)
      << nameless.err;
}

TEST(SetupProgram, TakesABodyAndASceneInAnyOrder) {
  const SmallWorld world;
  const std::string wall = world.folder / "wall.obj", clip = world.folder / "clip.bvh";
  const json answer = setupIn(world.folder, clip, wall);
  EXPECT_EQ(answer["scene"]["file"], wall);
  EXPECT_EQ(answer["body"]["file"], clip);
}

TEST(SetupProgram, WithoutYesNothingIsWritten) {
  const TempFolder folder;
  const Ended ended = runForetouch({"setup", kExample + "/room.obj", kExample + "/dancer.bvh",
                                    "--output", folder / "foretouch.toml"});
  EXPECT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_NE(ended.out.find("nothing was written"), std::string::npos) << ended.out;
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

/// A project names its files from where it lies, which standard output does not say.
TEST(SetupProgram, WritesNoProjectToStandardOutput) {
  const Ended ended =
      runForetouch({"setup", kExample + "/room.obj", kExample + "/dancer.bvh", "--yes", "-o", "-"});
  EXPECT_EQ(ended.exitCode, 2);
  EXPECT_NE(ended.err.find("--output: expected a file"), std::string::npos) << ended.err;
}

/// What is far too small is wrong, not only doubtful; what is large has no exponent. A body whose
/// joints have numbers for names is said to have no trunk by name.
TEST(SetupProgram, SizesAreSaidInPlainFiguresAndTrunksByName) {
  const TempFolder folder;
  const auto levelOf = [](const std::string& size) {
    return "o room\nv 0 0 0\nv " + size + " 0 0\nv " + size + " 0 " + size + "\nv 0 0 " + size +
           "\nf 1 3 2\nf 1 4 3\n";
  };
  const std::string tiny = folder.write("tiny.obj", levelOf("0.001"));
  const std::string huge = folder.write("huge.obj", levelOf("123456"));
  std::string numbered = contentOf(kExample + "/dancer.bvh");
  for (const std::string word : {"ROOT ", "JOINT "}) {
    int number = 0;
    for (std::size_t at = 0; (at = numbered.find(word, at)) != std::string::npos;) {
      at += word.size();
      numbered.replace(at, numbered.find('\n', at) - at,
                       word.substr(0, 1) + std::to_string(number++));
    }
  }
  const std::string body = folder.write("numbered.bvh", numbered);
  const json small = setupIn(folder, tiny, kExample + "/dancer.bvh", 1);
  EXPECT_EQ(stateOf(small, "scene's unit"), "bad");
  const Ended large = runForetouch({"setup", huge, body});
  EXPECT_NE(large.out.find("in metres it is 123000 x 0 x 123000 m"), std::string::npos)
      << large.out;
  EXPECT_EQ(large.out.find("e+"), std::string::npos) << large.out;
  EXPECT_NE(large.err.find("no joint is called a pelvis, spine, neck or head"), std::string::npos)
      << large.err;
}

TEST(SetupProgram, WhatWasThereIsKept) {
  const TempFolder folder;
  folder.write("foretouch.toml", "mine");
  static_cast<void>(setupIn(folder, kExample + "/room.obj", kExample + "/dancer.bvh"));
  EXPECT_EQ(contentOf(folder / "foretouch.toml~"), "mine");
}

TEST(SetupProgram, APlaceThatIsWrongIsKeptAndSaid) {
  const TempFolder folder;
  const Ended ended = runForetouch({"setup", kExample + "/room.obj", kExample + "/dancer.bvh",
                                    "--json", "--place", "100,0,100"});
  EXPECT_EQ(ended.exitCode, 1) << ended.err;
  const json answer = json::parse(ended.out, nullptr, false);
  EXPECT_EQ(answer["place"][0], 100.0);
  EXPECT_EQ(stateOf(answer, "floor"), "bad");
  EXPECT_NE(ended.out.find("--place "), std::string::npos) << "and where it could stand";
}

TEST(SetupProgram, ABodyThatNeverMovesAndASceneWithoutAFloorAreSaid) {
  const TempFolder folder;
  folder.write("wall.obj", "o wall\nv 0 -2 -2\nv 0 2 -2\nv 0 2 2\nf 1 2 3\n");
  folder.write("still.bvh", clipAlongX({0.5, 0.5, 0.5}));
  const json answer = setupIn(folder, folder / "wall.obj", folder / "still.bvh");
  const std::string notes = answer["notes"].dump();
  EXPECT_NE(notes.find("never moves"), std::string::npos) << notes;
  EXPECT_NE(answer["checks"].dump().find("no floor"), std::string::npos) << answer["checks"];
  EXPECT_NE(notes.find("one object"), std::string::npos) << notes;
  EXPECT_FALSE(answer["place_found"]);
}

TEST(SetupProgram, StandsOnWhatIsNamedAndViewAgrees) {
  const TempFolder folder;
  // Large enough that no foot of a wide stance hangs over its edge.
  std::string text = "v -9 0 -9\nv -9 0 9\nv 9 0 9\nv 9 0 -9\no floor\nf 1 2 3 4\n";
  text += "v -1 0.8 -4\nv -1 0.8 4\nv 7 0.8 4\nv 7 0.8 -4\no stage\nf 5 6 7 8\n";
  folder.write("hall.obj", text);
  const std::string body = kExample + "/dancer.bvh", project = folder / "foretouch.toml";
  const json onFloor = setupIn(folder, folder / "hall.obj", body);
  EXPECT_EQ(stateOf(onFloor, "level"), "good") << onFloor["checks"];
  const Ended viewed =
      runForetouch({"view", "--project", project, "--output", folder / "v.html", "--json"});
  const json seen = json::parse(viewed.out, nullptr, false);
  for (const char* const name : {"scene's unit", "scene's axis", "body's unit", "body's axis",
                                 "start", "floor", "level", "path"}) {
    EXPECT_EQ(stateOf(seen, name), stateOf(onFloor, name)) << name << seen << onFloor;
  }
  const Ended asked = runForetouch({"setup", folder / "hall.obj", body, "--json", "--on", "stage"});
  const json onStage = json::parse(asked.out, nullptr, false);
  EXPECT_NEAR(onStage["place"][1].get<double>() - onFloor["place"][1].get<double>(), 0.8, 0.01);
  EXPECT_NE(onStage["checks"].dump().find("as you said"), std::string::npos) << onStage["checks"];
  const Ended wrong = runForetouch({"setup", folder / "hall.obj", body, "--on", "rooof"});
  EXPECT_EQ(wrong.exitCode, 2);
  EXPECT_NE(wrong.err.find("'floor', 'stage'"), std::string::npos) << wrong.err;
}

TEST(SetupProgram, KeepsEveryFileThatWasThere) {
  const TempFolder folder;
  folder.write("hall.obj", "v -5 1 -5\nv -5 1 5\nv 5 1 5\nv 5 1 -5\no floor\nf 1 2 3 4\n");
  folder.write("dancer.avatar.json", "mine");
  const std::string clip = kExample + "/dancer.bvh", avatar = folder / "dancer.avatar.json";
  const Ended refused =
      runForetouch({"setup", folder / "hall.obj", clip, "--yes", "--output", avatar});
  EXPECT_EQ(refused.exitCode, 2) << refused.out;
  EXPECT_EQ(contentOf(avatar), "mine");
  for (int k = 0; k < 2; ++k) static_cast<void>(setupIn(folder, folder / "hall.obj", clip));
  EXPECT_EQ(contentOf(folder / "dancer.avatar.json~"), "mine") << "not the one of the first run";
}

TEST(SetupProgram, ThePageSaysWhereABodyWithoutAClipStands) {
  const TempFolder folder;
  folder.write("hall.obj", "v -5 1 -5\nv -5 1 5\nv 5 1 5\nv 5 1 -5\no floor\nf 1 2 3 4\n");
  static_cast<void>(setupIn(folder, folder / "hall.obj", kExample + "/dancer.bvh"));
  const Ended view = runForetouch({"view", "--scene", folder / "hall.obj", "--avatar",
                                   folder / "dancer.avatar.json", "--place", "1,0.93,-2,90",
                                   "--output", folder / "v.html"});
  EXPECT_NE(view.exitCode, 2) << view.err;
  EXPECT_NE(contentOf(folder / "v.html").find("1, 0.93, -2 m, turned by 90 degrees"),
            std::string::npos);
}

TEST(SetupProgram, BadFilesAreNamed) {
  const TempFolder folder;
  folder.write("broken.bvh", "HIERARCHY\nnonsense\n");
  const Ended broken = runForetouch({"setup", kExample + "/room.obj", folder / "broken.bvh"});
  EXPECT_EQ(broken.exitCode, 2);
  EXPECT_NE(broken.err.find("broken.bvh:2"), std::string::npos) << broken.err;
  const Ended missing = runForetouch({"setup", folder / "no.obj", kExample + "/dancer.bvh"});
  EXPECT_EQ(missing.exitCode, 2);
  EXPECT_NE(missing.err.find("no.obj"), std::string::npos) << missing.err;
}

/// Least distance of a pose's surface to the scene, and the height of its lowest point; by the
/// judge's formulas, over every triangle.
struct JudgedPose {
  double separation = std::numeric_limits<double>::max(), lowest = separation,
         highest = -separation;
  double heightOfNearest = 0.0;
};

JudgedPose judged(const Avatar& avatar, const Pose& pose, const RawScene& scene) {
  JudgedPose result;
  std::vector<LinkState> states;
  ChainMotion(avatar.skeleton(), pose, pose).statesAt(0.0, states);
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    for (const Lss& lss : avatar.lss(link)) {
      const Eigen::Vector3d a = states[static_cast<std::size_t>(link)].pointAt(lss.a);
      const Eigen::Vector3d b = states[static_cast<std::size_t>(link)].pointAt(lss.b);
      result.lowest = std::min({result.lowest, a.y() - lss.radius, b.y() - lss.radius});
      result.highest = std::max({result.highest, a.y() + lss.radius, b.y() + lss.radius});
      for (const Triangle& triangle : scene.triangles) {
        const auto closest = oracle::closestPoints<double>(
            oracle::Vec3<double>(a), oracle::Vec3<double>(b),
            {oracle::Vec3<double>(triangle.vertices[0]), oracle::Vec3<double>(triangle.vertices[1]),
             oracle::Vec3<double>(triangle.vertices[2])});
        if (closest.distance - lss.radius < result.separation) {
          result.separation = closest.distance - lss.radius;
          result.heightOfNearest = closest.onTriangle.y;
        }
      }
    }
  }
  return result;
}

/// Of frames spread over the clip, the one that stands: a tenth of them are lower, as T-poses and
/// toes in the floor are.
std::size_t frameThatStands(const Avatar& avatar, const Clip& clip, const JointMatch& match,
                            bool isZUp) {
  std::vector<std::pair<double, std::size_t>> lowest;
  RawScene nothing;
  for (std::size_t frame = 1; frame < clip.frames.size(); frame += 1 + clip.frames.size() / 64) {
    const Pose pose = placed(avatar.skeleton(), poseOfAvatar(avatar.skeleton(), clip, match, frame),
                             {isZUp, Eigen::Vector3d::Zero(), 0.0});
    lowest.emplace_back(judged(avatar, pose, nothing).lowest, frame);
  }
  if (lowest.empty()) return 0;
  std::sort(lowest.begin(), lowest.end());
  return lowest[lowest.size() / 10].second;
}

struct RealCase {
  const char* scene;
  const char* clip;
  double clipScale;
  const char *sceneUp, *clipUp;
};

/// The body stands free, on its feet, where `setup` has put it.
void judgePlace(const std::string& scene, const std::string& clip, const TempFolder& folder,
                const json& answer) {
  SceneImportOptions options;
  if (answer["scene"]["up"]["value"] == "z") options.up = UpAxis::Z;
  options.scale = answer["scene"]["scale"]["value"].get<double>();
  const auto level = importScene(scene, options);
  ASSERT_TRUE(level.ok());
  ClipFileOptions reading;
  reading.import.scale = answer["body"]["scale"]["value"].get<double>();
  const auto read = readClipFile(clip, reading);
  const std::string avatarPath =
      folder / (std::filesystem::path(clip).stem().string() + ".avatar.json");
  const auto avatar = readAvatarFile(avatarPath);
  ASSERT_TRUE(read.ok() && avatar.ok());
  const Skeleton& skeleton = avatar.value().skeleton();
  const auto match = matchJoints(skeleton, read.value().clip.skeleton);
  ASSERT_TRUE(match.ok());
  const bool isZUp = answer["body"]["up"]["value"] == "z";
  const json& place = answer["place"];
  const std::size_t stands =
      frameThatStands(avatar.value(), read.value().clip, match.value(), isZUp);
  const Pose pose =
      placed(skeleton, poseOfAvatar(skeleton, read.value().clip, match.value(), stands),
             {isZUp,
              {place[0].get<double>(), place[1].get<double>(), place[2].get<double>()},
              place[3].get<double>()});
  const JudgedPose found = judged(avatar.value(), pose, level.value().scene);
  // The product may have taken another one of the frames that are about as low.
  EXPECT_GT(found.separation, -0.01) << "free, but for the soles";
  EXPECT_LE(found.separation, 0.03) << "on a floor";
  EXPECT_LE(found.heightOfNearest, found.lowest + 0.2 * (found.highest - found.lowest))
      << "and it is the feet that are near something";
}

class SetupOfRealFiles : public testing::TestWithParam<RealCase> {};

TEST_P(SetupOfRealFiles, IsRightFreeAndOnAFloor) {
  const RealCase& given = GetParam();
  FORETOUCH_REQUIRE_SHARED(scene, given.scene);
  FORETOUCH_REQUIRE_SHARED(clip, given.clip);
  const TempFolder folder;
  const json answer = setupIn(folder, *scene, *clip);
  EXPECT_EQ(answer["scene"]["scale"]["value"], 1.0);
  EXPECT_EQ(answer["scene"]["up"]["value"], given.sceneUp);
  EXPECT_EQ(answer["body"]["scale"]["value"], given.clipScale);
  EXPECT_EQ(answer["body"]["up"]["value"], given.clipUp);
  ASSERT_TRUE(answer["place_found"]);
  judgePlace(*scene, *clip, folder, answer);
}

INSTANTIATE_TEST_SUITE_P(
    , SetupOfRealFiles,
    testing::Values(
        RealCase{"scenes/dungeon.obj", "mocap/bandai1_kick_normal_001.bvh", 0.01, "y", "y"},
        RealCase{"scenes/dungeon.obj", "mocap/mocapbank.bvh", 0.01, "y", "y"},
        RealCase{"scenes/nav_test.obj", "mocap/cmu_01_01_playground_jumps.bvh", 0.0564, "y", "y"},
        RealCase{"scenes/undulating.obj", "mocap/makehuman_zombieWalk1.bvh", 0.1, "y", "z"},
        RealCase{"scenes/kitchen_fatihrmutfak.ply", "mocap/freebvh_mixamorig.bvh", 0.01, "z", "y"},
        RealCase{"scenes/cpr_office.dae", "mocap/bandai1_punch_normal_001.bvh", 0.01, "z", "y"},
        RealCase{"scenes/cpr_obstacle_world.stl", "mocap/pybvh_YXZ_crlf.bvh", 0.01, "z", "y"},
        RealCase{"scenes/munich_city.ply", "mocap/cmu_jumping_jacks.bvh", 0.0564, "z", "y"},
        RealCase{"scenes/collision-world.glb", "mocap/bandai1_slash_normal_001.bvh", 0.01, "y",
                 "y"}));

/// Every clip in every level, minutes long: --gtest_also_run_disabled_tests. Where no place is
/// found, or a check says that a person should look, the user is asked.
TEST(SetupOfEveryPair, DISABLED_StandsOrAsks) {
  const auto data = sharedData("mocap");
  if (!data) GTEST_SKIP() << "no shared data";
  int stands = 0, asks = 0;
  for (const char* const name : {"collision-world.glb", "cpr_obstacle_world.stl", "cpr_office.dae",
                                 "dungeon.obj", "fcl_env.obj", "kitchen_fatihrmutfak.ply",
                                 "munich_city.ply", "nav_test.obj", "undulating.obj"}) {
    const auto scene = sharedData(std::string("scenes/") + name);
    if (!scene) continue;
    for (const auto& entry : std::filesystem::directory_iterator(*data)) {
      const std::string clip = entry.path().string(), file = entry.path().filename().string();
      if (entry.path().extension() != ".bvh" || file.rfind("odd_", 0) == 0) continue;
      SCOPED_TRACE(std::string(name) + " " + file);
      const TempFolder folder;
      const Ended ended = runForetouch(
          {"setup", *scene, clip, "--yes", "--json", "--output", folder / "foretouch.toml"});
      const json answer = json::parse(ended.out, nullptr, false);
      ASSERT_TRUE(answer.is_object()) << ended.err;
      bool isDoubted = !answer["place_found"].get<bool>();
      for (const json& check : answer["checks"]) isDoubted |= check["state"] != "good";
      ++(isDoubted ? asks : stands);
      if (!isDoubted) judgePlace(*scene, clip, folder, answer);
    }
  }
  std::cout << stands << " stand, " << asks << " are asked about\n";
  EXPECT_GT(stands, 20);
}

}  // namespace
}  // namespace foretouch::test
