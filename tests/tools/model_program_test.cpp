// The program with models, robots and their motions: made, checked and replayed as a user would.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "articulated/motion.h"
#include "assets/avatar/avatar_file.h"
#include "assets/avatar/joint_match.h"
#include "assets/import/model_import.h"
#include "assets/model/model_avatar.h"
#include "lss/lss_cover.h"
#include "tests/support/holds.h"
#include "tests/support/shared_data.h"
#include "tests/tools/program_run.h"
#include "tests/tools/small_world.h"
#include "tools/audit/audits.h"

namespace foretouch::test {
namespace {

/// Two boxes, 0.5 m wide, one on the other: 24 triangles.
std::string twoBoxes() {
  std::string text;
  for (int box = 0; box < 2; ++box) {
    text += "o box" + std::to_string(box) + "\n";
    for (int i = 0; i < 8; ++i) {
      text += "v " + std::to_string(0.5 * (i & 1)) + " " + std::to_string(box + (i >> 1 & 1)) +
              " " + std::to_string(0.5 * (i >> 2)) + "\n";
    }
    for (const auto& face : {"1 2 4 3", "5 6 8 7", "1 2 6 5", "3 4 8 7", "1 3 7 5", "2 4 8 6"}) {
      text += "f";
      for (const char* c = face; *c != '\0'; c += *(c + 1) == '\0' ? 1 : 2) {
        text += " " + std::to_string(*c - '0' + 8 * box);
      }
      text += "\n";
    }
  }
  return text;
}

/// Z-up: an arm of 0.9 m along x that turns about z.
constexpr char kRobot[] = R"(<robot name="arm">
<link name="base"/>
<link name="arm"><collision><origin xyz="0.5 0 0" rpy="0 1.5707963267948966 0"/>
<geometry><capsule radius="0.05" length="0.8"/></geometry></collision></link>
<joint name="shoulder" type="revolute"><parent link="base"/><child link="arm"/>
<axis xyz="0 0 1"/><limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
</robot>)";

TEST(AvatarMesh, MakesAnAvatarAndItsMeshThatTheCheckAccepts) {
  const TempFolder folder;
  const std::string made = folder / "boxes.avatar.json";
  const Ended make =
      runForetouch({"avatar", "mesh", folder.write("boxes.obj", twoBoxes()), "-o", made});
  ASSERT_EQ(make.exitCode, 0) << make.err;
  EXPECT_TRUE(holds(make.out, "triangles read           24\n")) << make.out;
  EXPECT_EQ(folder.names(),
            (std::set<std::string>{"boxes.obj", "boxes.avatar.json", "boxes.avatar.mesh.glb"}));
  const Avatar avatar = readAvatarFile(made).value();
  std::size_t meshes = 0;
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    if (avatar.mesh(link).file.empty()) continue;
    EXPECT_EQ(avatar.mesh(link).file, "boxes.avatar.mesh.glb");
    ++meshes;
  }
  EXPECT_EQ(meshes, 2u);
  const Ended check = runForetouch({"avatar", "check", made});
  EXPECT_EQ(check.exitCode, 0) << check.err;
  EXPECT_TRUE(holds(check.out, "triangles of links       24\n")) << check.out;
  EXPECT_TRUE(holds(check.out, "outside their LSS      0\n")) << check.out;
}

TEST(AvatarMesh, ScalesAndTurns) {
  const TempFolder folder;
  const std::string model = folder.write("boxes.obj", twoBoxes());
  const Ended ended = runForetouch({"avatar", "mesh", model, "-o", folder / "a.json",
                                    "--model-scale", "0.5", "--model-up", "z", "--max-lss", "1"});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  const Avatar avatar = readAvatarFile(folder / "a.json").value();
  EXPECT_EQ(avatar.numLss(), 2);
  const auto audit = tools::auditAvatar(avatar, restPose(avatar.skeleton()));
  EXPECT_GT(audit.extent.z(), audit.extent.y());  // the stack's y became -z
  EXPECT_LT(audit.extent.z(), 1.5);
}

TEST(AvatarMesh, RefusesBadInputAndLeavesNothing) {
  const TempFolder folder;
  const std::string model = folder.write("boxes.obj", twoBoxes());
  folder.write("empty.obj", "v 0 0 0\n");
  const auto before = folder.names();
  const std::string made = folder / "a.json";
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {"avatar", "mesh", folder / "absent.glb", "-o", made},
           {"avatar", "mesh", folder / "empty.obj", "-o", made},
           {"avatar", "mesh", model, "-o", model},
           {"avatar", "mesh", model, "-o", folder / "no/a.json"},
           {"avatar", "mesh", model, "-o", made, "--scale", "0"},
           {"avatar", "mesh", model, "-o", made, "--up", "x"},
           {"avatar", "mesh", model, "-o", made, "--max-lss", "0"},
           {"avatar", "urdf", folder / "absent.urdf", "-o", made},
           {"avatar", "mesh", model}}) {
    const Ended ended = runForetouch(arguments);
    EXPECT_EQ(ended.exitCode, 2) << ended.err;
    EXPECT_EQ(ended.err.rfind("foretouch: ", 0), 0u) << ended.err;
    EXPECT_EQ(folder.names(), before);
  }
}

TEST(AvatarUrdf, RefusesMeshesThatAreMissingUnlessTheyMayBe) {
  const TempFolder folder;
  const std::string robot = folder.write("r.urdf", R"(<robot name="r"><link name="base"><collision>
<geometry><sphere radius="0.1"/></geometry></collision></link><link name="arm"><collision><geometry>
<mesh filename="absent.stl"/></geometry></collision></link><joint name="j" type="continuous">
<parent link="base"/><child link="arm"/><axis xyz="0 0 1"/></joint></robot>)");
  const std::string made = folder / "a.json";
  const Ended refused = runForetouch({"avatar", "urdf", robot, "-o", made});
  EXPECT_EQ(refused.exitCode, 2);
  EXPECT_TRUE(holds(refused.err, "'absent.stl' of link 'arm' was not found")) << refused.err;
  EXPECT_TRUE(holds(refused.err, "--allow-missing")) << refused.err;
  EXPECT_EQ(folder.names(), std::set<std::string>{"r.urdf"});
  const Ended allowed = runForetouch({"avatar", "urdf", robot, "-o", made, "--allow-missing"});
  EXPECT_EQ(allowed.exitCode, 0) << allowed.err;
  EXPECT_TRUE(holds(allowed.err, "'absent.stl' of link 'arm' was not found")) << allowed.err;
  EXPECT_TRUE(holds(allowed.out, "links without an LSS")) << allowed.out;
}

TEST(AvatarPairs, OfARobotAreDrawnWithinItsLimits) {
  const TempFolder folder;
  // At zero, outside its limits, the fold lies on the base; within them it points away.
  const std::string robot = folder.write("r.urdf", R"(<robot name="r"><link name="base"><collision>
<origin xyz="0.5 0 0" rpy="0 1.5707963267948966 0"/><geometry><capsule radius="0.05" length="1"/>
</geometry></collision></link><link name="arm"><collision><origin xyz="0 0.3 0"/><geometry>
<sphere radius="0.05"/></geometry></collision></link><link name="fold"><collision>
<origin xyz="-0.5 -0.25 0"/><geometry><sphere radius="0.05"/></geometry></collision></link>
<joint name="a" type="revolute"><parent link="base"/><child link="arm"/><origin xyz="1 0 0"/>
<axis xyz="0 0 1"/><limit lower="-0.1" upper="0.1" effort="1" velocity="1"/></joint>
<joint name="f" type="revolute"><parent link="arm"/><child link="fold"/><origin xyz="0 0.3 0"/>
<axis xyz="0 0 1"/><limit lower="2" upper="4" effort="1" velocity="1"/></joint></robot>)");
  const std::string made = folder / "a.json";
  ASSERT_EQ(runForetouch({"avatar", "urdf", robot, "-o", made}).exitCode, 0);
  const Ended ofRest = runForetouch({"avatar", "pairs", made, "--json"});
  EXPECT_EQ(ofRest.exitCode, 2) << "it leaves no pair to ask";
  const Ended drawn = runForetouch({"avatar", "pairs", made, "--robot", robot, "--json"});
  ASSERT_EQ(drawn.exitCode, 0) << drawn.err;
  EXPECT_TRUE(holds(drawn.out, R"("pairs":3,"asked":1,)")) << drawn.out;
  EXPECT_TRUE(holds(drawn.out, R"({"a":"base","b":"fold","touches":0})")) << drawn.out;
  EXPECT_TRUE(holds(drawn.out, R"("usual_poses":10000)")) << drawn.out;
  const Ended told = runForetouch({"avatar", "pairs", made, "--robot", robot});
  EXPECT_TRUE(holds(told.out, "asked, never touching  1\n")) << told.out;
}

TEST(AvatarCheck, SaysNoToTrianglesOutsideTheirLssAndTwoToMeshesThatAreNotThere) {
  const TempFolder folder;
  const std::string made = folder / "a.json";
  const std::string model = folder.write("boxes.obj", twoBoxes());
  ASSERT_EQ(runForetouch({"avatar", "mesh", model, "-o", made}).exitCode, 0);
  const Avatar good = readAvatarFile(made).value();
  std::vector<std::vector<Lss>> thin;
  std::vector<MeshReference> meshes;
  for (LinkId link = 0; link < good.numLinks(); ++link) {
    thin.push_back(good.lss(link));
    for (Lss& lss : thin.back()) lss.radius -= 0.01;
    meshes.push_back(good.mesh(link));
  }
  const Avatar bad = Avatar::build(good.skeleton(), thin, meshes).value();
  ASSERT_TRUE(writeAvatarFile(bad, folder / "thin.json").ok());
  const Ended check = runForetouch({"avatar", "check", folder / "thin.json"});
  EXPECT_EQ(check.exitCode, 1);
  EXPECT_TRUE(holds(check.err, "stick out of their link's LSS, the worst by 10 mm")) << check.err;
  std::filesystem::remove(folder / "a.mesh.glb");
  EXPECT_EQ(runForetouch({"avatar", "check", made}).exitCode, 2);
}

/// Legs 0.44 m long for the unit of 1; Z-up, with the names of a person's legs.
std::string smallHumanoid() {
  const auto link = [](const std::string& name, const std::string& length) {
    return "<link name=\"" + name + "\"><collision><origin xyz=\"0 0 -0.05\"/><geometry>" +
           "<capsule radius=\"0.02\" length=\"" + length + "\"/></geometry></collision></link>";
  };
  const auto joint = [](const std::string& parent, const std::string& child,
                        const std::string& at) {
    return "<joint name=\"to_" + child + "\" type=\"fixed\"><parent link=\"" + parent +
           "\"/><child link=\"" + child + "\"/><origin xyz=\"" + at + "\"/></joint>";
  };
  std::string text = "<robot name=\"small\">" + link("torso", "0.2");
  for (const auto& [side, y] : {std::pair("left_", "0.05"), std::pair("right_", "-0.05")}) {
    const std::string lead = side;
    text += link(lead + "thigh", "0.1") + link(lead + "shin", "0.1") + link(lead + "foot", "0.01") +
            joint("torso", lead + "thigh", std::string("0 ") + y + " -0.1") +
            joint(lead + "thigh", lead + "shin", "0 0 -0.12") +
            joint(lead + "shin", lead + "foot", "0 0 -0.1");
  }
  return text + "</robot>";
}

TEST(AvatarCheck, TakesARobotForAsLargeAsItsFileSays) {
  const TempFolder folder;
  const std::string made = folder / "small.json";
  const Ended make =
      runForetouch({"avatar", "urdf", folder.write("small.urdf", smallHumanoid()), "-o", made});
  ASSERT_EQ(make.exitCode, 0) << make.err;
  EXPECT_EQ(make.err, "");
  const Avatar robot = readAvatarFile(made).value();
  const auto audit = tools::auditAvatar(robot, restPose(robot.skeleton()));
  EXPECT_GT(audit.extent.maxCoeff(), 0.4);
  EXPECT_LT(audit.extent.maxCoeff(), 0.5);  // a person would not be
  const Ended check = runForetouch({"avatar", "check", made});
  EXPECT_EQ(check.exitCode, 0) << check.err;
  // In millimetres, it is no robot.
  const Ended large = runForetouch(
      {"avatar", "urdf", folder / "small.urdf", "--scale", "1000", "-o", folder / "large.json"});
  EXPECT_EQ(large.exitCode, 0);
  EXPECT_TRUE(holds(large.err, "expected 0.05 to 50 m")) << large.err;
  EXPECT_EQ(runForetouch({"avatar", "check", folder / "large.json"}).exitCode, 1);
}

TEST(ReplayJointPositions, FindsWhatTheRobotMeets) {
  const SmallWorld world;
  const std::string robot = world.folder.write("arm.urdf", kRobot);
  const std::string log =
      world.folder.write("log.csv", "time,shoulder\n0,2.5\n0.1,2\n0.2,0.5\n0.3,0\n");
  const Ended make = runForetouch({"avatar", "urdf", robot, "-o", world.folder / "arm.json"});
  ASSERT_EQ(make.exitCode, 0) << make.err;
  EXPECT_FALSE(holds(make.out, "excess")) << make.out;  // no triangles
  std::vector<std::string> arguments = world.replay(
      {"--robot", robot, "--place", "-0.5,0,0", "--output", world.folder / "out.jsonl"}, "wall.obj",
      "arm.json", "log.csv");
  const Ended replayed = runForetouch(arguments);
  EXPECT_EQ(replayed.exitCode, 0) << replayed.err;
  // The arm's far end, 0.95 m out, comes within 0.5 m of the base's plane where cos(q) 0.9 + 0.05
  // is that: at q = 1.0472, between the second row and the third.
  const std::string results = contentOf(world.folder / "out.jsonl");
  const std::size_t step = results.find("{\"step\":1,");
  ASSERT_NE(step, std::string::npos);
  const std::string line = results.substr(step, results.find('\n', step) - step);
  EXPECT_TRUE(holds(line, "\"link\":\"arm\",\"verdict\":\"contact\",\"toi\":0.63")) << line;
  EXPECT_TRUE(holds(line, "\"object\":\"wall\"")) << line;
  EXPECT_TRUE(holds(results, "\"unmatched_joints\":[]")) << results;
}

TEST(ReplayMotions, RefusesOptionsThatDoNotGoWithTheMotion) {
  const SmallWorld world;
  world.folder.write("log.csv", "time,shoulder\n0,0\n1,0\n");
  world.folder.write("arm.urdf", kRobot);
  world.folder.write("bad.csv", "time,shoulder\n0,0\n1,zero\n");
  const auto out = world.folder / "out.jsonl";
  const auto error = [&](const std::vector<std::string>& more, const std::string& motion) {
    std::vector<std::string> options = {"--output", out};
    options.insert(options.end(), more.begin(), more.end());
    const Ended ended = runForetouch(world.replay(options, "wall.obj", "man.json", motion));
    EXPECT_EQ(ended.exitCode, 2);
    return ended.err;
  };
  EXPECT_TRUE(holds(error({"--animation", "Walk"}, "clip.bvh"), "--animation: expected a model"));
  EXPECT_TRUE(holds(error({"--robot", "a.urdf"}, "clip.bvh"), "--robot: expected a table"));
  EXPECT_TRUE(holds(error({}, "log.csv"), "log.csv: joint positions are about a robot"));
  const std::string arm = world.folder / "arm.urdf";
  EXPECT_TRUE(holds(error({"--robot", arm}, "bad.csv"), "bad.csv:3: expected a number"));
  EXPECT_TRUE(holds(error({"--robot", arm}, "log.csv"), "log.csv: no joint of the avatar"));
  EXPECT_TRUE(holds(error({}, "absent.glb"), "absent.glb: "));
}

/// A box slides into a wall face first: 0.25 m before it at step 0, half way it touches. Its LSS,
/// half a diagonal thick, touches from the start.
TEST(ReplayFidelity, TellsTheBoxFromTheLssAroundIt) {
  const SmallWorld world;
  const std::string boxes = world.folder.write("boxes.obj", twoBoxes());
  ASSERT_EQ(runForetouch({"avatar", "mesh", boxes, "-o", world.folder / "boxes.json"}).exitCode, 0);
  std::string clip = clipAlongX({-0.75, -0.25});
  for (std::size_t at = clip.find("Hips"); at != std::string::npos; at = clip.find("Hips")) {
    clip.replace(at, 4, "box0");
  }
  world.folder.write("slide.bvh", clip);
  const auto run = [&](const std::vector<std::string>& more) {
    std::vector<std::string> options = {"--output", world.folder / "out.jsonl", "--ignore", "box1"};
    options.insert(options.end(), more.begin(), more.end());
    const Ended ended = runForetouch(world.replay(options, "wall.obj", "boxes.json", "slide.bvh"));
    EXPECT_EQ(ended.exitCode, 0) << ended.err;
    return contentOf(world.folder / "out.jsonl");
  };
  const std::string link = run({});
  EXPECT_TRUE(holds(link, "\"fidelity\":\"link\"")) << link;
  EXPECT_FALSE(holds(link, "\"toi\":0.49")) << link;
  for (const std::vector<std::string>& exact : {std::vector<std::string>{"--fidelity", "exact"},
                                                {"--fidelity", "skinned", "--skin", boxes}}) {
    const std::string results = run(exact);
    EXPECT_TRUE(holds(results, "\"fidelity\":\"" + exact[1] + "\"")) << results;
    EXPECT_TRUE(holds(results, "\"link\":\"box0\",\"verdict\":\"contact\",\"toi\":0.49"))
        << results;
    EXPECT_TRUE(holds(results, "\"link_triangle\":")) << results;
  }
}

/// The same slide, with the box that moves asked for by a policy: box0 by its mesh, box1 not at
/// all.
TEST(ReplayPolicy, AsksOneLinkByItsMeshAndReadsNoOther) {
  const SmallWorld world;
  const std::string boxes = world.folder.write("boxes.obj", twoBoxes());
  ASSERT_EQ(runForetouch({"avatar", "mesh", boxes, "-o", world.folder / "boxes.json"}).exitCode, 0);
  std::string clip = clipAlongX({-0.75, -0.25});
  for (std::size_t at = clip.find("Hips"); at != std::string::npos; at = clip.find("Hips")) {
    clip.replace(at, 4, "box0");
  }
  world.folder.write("slide.bvh", clip);
  const auto run = [&](const std::string& policy) {
    const std::vector<std::string> options = {"--output", world.folder / "out.jsonl", "--policy",
                                              world.folder.write("policy.toml", policy)};
    return runForetouch(world.replay(options, "wall.obj", "boxes.json", "slide.bvh"));
  };
  const std::string exact =
      "[[policy]]\nlinks = [\"box0\"]\nfidelity = \"exact\"\ntolerance = 1e-4\n"
      "[[policy]]\nlinks = [\"box1\"]\nobjects = [\"wall\"]\nignore = true\n";
  const Ended replayed = run(exact);
  ASSERT_EQ(replayed.exitCode, 0) << replayed.err;
  const std::string results = contentOf(world.folder / "out.jsonl");
  EXPECT_TRUE(holds(results, R"("tolerance":0.001,"fidelity":"link")")) << results;
  EXPECT_TRUE(holds(results,
                    R"("policy":[{"links":["box0"],"tolerance":0.0001,"fidelity":"exact"},)"
                    R"({"links":["box1"],"objects":["wall"],"ignore":true}])"))
      << results;
  EXPECT_TRUE(holds(results, "\"link\":\"box0\",\"verdict\":\"contact\",\"toi\":0.49")) << results;
  EXPECT_FALSE(holds(results, "\"link\":\"box1\",")) << results;

  EXPECT_TRUE(holds(run("[[policy]]\nlinks = [\"bxo0\"]\nignore = true\n").err,
                    "policy.toml:1: [[policy]] links: 'bxo0' is no link of the avatar; did you"));
  // Who asks for no link's mesh does not miss the file.
  std::filesystem::remove(world.folder / "boxes.mesh.glb");
  EXPECT_EQ(run("[[policy]]\nlinks = [\"box0\"]\ntolerance = 1e-4\n").exitCode, 0);
  EXPECT_EQ(run(exact).exitCode, 2);
}

TEST(ReplayFidelity, RefusesWhatItHasNoSurfaceFor) {
  const SmallWorld world;
  const auto error = [&](const std::vector<std::string>& more) {
    std::vector<std::string> options = {"--output", world.folder / "out.jsonl"};
    options.insert(options.end(), more.begin(), more.end());
    const Ended ended = runForetouch(world.replay(options));
    EXPECT_EQ(ended.exitCode, 2);
    return ended.err;
  };
  EXPECT_TRUE(holds(error({"--fidelity", "skinned"}), "--skin: expected the model"));
  const std::string boxes = world.folder.write("boxes.obj", twoBoxes());
  EXPECT_TRUE(holds(error({"--fidelity", "skinned", "--skin", boxes}),
                    "boxes.obj: expected the avatar's 2 links"));
}

TEST(ReplayModels, MovesAnAvatarByTheAnimationOfItsOwnFile) {
  FORETOUCH_REQUIRE_SHARED(man, "avatars/cesium_man.gltf");
  const SmallWorld world;
  const std::string made = world.folder / "cesium.json";
  ASSERT_EQ(runForetouch({"avatar", "mesh", *man, "-o", made}).exitCode, 0);
  const Ended check = runForetouch({"avatar", "check", made, "--motion", *man});
  EXPECT_EQ(check.exitCode, 0) << check.err;
  EXPECT_FALSE(holds(check.out, "keep their rest")) << check.out;
  const Ended replayed =
      runForetouch({"replay", "--scene", world.folder / "wall.obj", "--avatar", made, "--motion",
                    *man, "--rate", "10", "--output", world.folder / "out.jsonl"});
  EXPECT_EQ(replayed.exitCode, 0) << replayed.err;
  EXPECT_TRUE(holds(replayed.out, "steps                         20")) << replayed.out;
}

/// The body's file holds no motion, the motion's file no body; the rig's root turns Z-up to Y-up.
TEST(ReplayModels, ADancerFromTwoFilesStandsUpright) {
  FORETOUCH_REQUIRE_SHARED(body, "avatars/kaykit_manny/manny_med_mod.gltf");
  FORETOUCH_REQUIRE_SHARED(moves, "avatars/kaykit_manny/Med_CombatMelee.glb");
  const auto avatar = avatarFromModel(importModel(*body).value()).value().avatar;
  const auto clip = clipFromModel(importModel(*moves).value()).value();
  const auto match = matchJoints(avatar.skeleton(), clip.skeleton).value();
  EXPECT_TRUE(match.unmatchedAvatar.empty());
  const Pose pose =
      validatedPose(avatar.skeleton(), poseOfAvatar(avatar.skeleton(), clip, match, 0)).value();
  const auto audit = tools::auditAvatar(avatar, pose);
  EXPECT_GT(audit.extent.y(), 2.0);
  EXPECT_LT(audit.extent.z(), 1.5);
}

/// The makers' files, whatever they hold: no triangle is lost unsaid, none is outside its LSS.
TEST(AvatarMesh, AccountsForEveryTriangleOfRealModels) {
  FORETOUCH_REQUIRE_SHARED(folder, "avatars");
  int models = 0;
  for (const char* name : {"cesium_man.gltf", "robot_expressive.glb", "greenman.glb", "Fox.glb",
                           "kaykit_manny/manny_med_mod.gltf", "makehuman/base.obj"}) {
    SCOPED_TRACE(name);
    const auto model = importModel(*folder + "/" + name);
    if (!model.ok()) continue;  // a partial copy of the data
    ++models;
    std::size_t read = 0;
    for (const ModelMesh& mesh : model.value().meshes) read += mesh.triangles.size();
    const auto made = avatarFromModel(model.value()).value();
    EXPECT_GT(read, 300u);
    EXPECT_EQ(made.report.triangles + made.report.droppedNonFinite, read);
    EXPECT_EQ(made.report.badWeights, 0u);
    for (LinkId link = 0; link < made.avatar.numLinks(); ++link) {
      const auto& triangles = made.surface[static_cast<std::size_t>(link)];
      if (!triangles.empty()) {
        EXPECT_EQ(measureCover(made.avatar.lss(link), triangles).outside, 0u);
      }
    }
  }
  EXPECT_GT(models, 0);
}

}  // namespace
}  // namespace foretouch::test
