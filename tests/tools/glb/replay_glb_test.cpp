// tests/tools/glb/replay_glb_test.cpp: replays as GLB, read by a reader that shares no code with
// what writes them, and by the importer, which shares none either.
#include "tools/glb/replay_glb.h"

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "assets/avatar/avatar_file.h"
#include "assets/bvh/bvh_reader.h"
#include "assets/import/model_import.h"
#include "tests/tools/glb/glb_reader.h"
#include "tests/tools/program_run.h"
#include "tests/tools/small_inputs.h"
#include "tools/glb/avatar_animation.h"

namespace foretouch::test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using nlohmann::json;

/// What a channel moves a node's part by at some time; its part of the node where none does.
class Channels {
 public:
  explicit Channels(const GlbReader& glb) : glb_(glb) {}

  [[nodiscard]] double scaleAt(std::size_t node, double timeS) const {
    for (const json& channel : glb_.root()["animations"][0]["channels"]) {
      if (channel["target"]["node"] != node || channel["target"]["path"] != "scale") continue;
      const json& sampler =
          glb_.root()["animations"][0]["samplers"][channel["sampler"].get<std::size_t>()];
      EXPECT_EQ(sampler["interpolation"], "STEP");
      const auto times = glb_.floats(sampler["input"]), scales = glb_.floats(sampler["output"]);
      std::size_t key = 0;
      while (key + 1 < times.size() && static_cast<double>(times[key + 1]) <= timeS) ++key;
      return static_cast<double>(scales[3 * key]);
    }
    ADD_FAILURE() << "node " << node << " has no scale";
    return -1.0;
  }

 private:
  const GlbReader& glb_;
};

TEST(ReplayGlbProgram, ShowsContactsWhenTheyAreAndSaysOfThemWhatTheResultsSay) {
  const SmallWorld world;
  const std::string path = world.folder / "out.glb";
  const Ended ended =
      runForetouch(world.replay({"--output", world.folder / "out.jsonl", "--glb", path}));
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_EQ(ended.err, "");
  const GlbReader glb(contentOf(path));
  glb.check();
  const json& nodes = glb.root()["nodes"];
  for (const char* object : {"wall", "floor"}) {
    EXPECT_EQ(nodes[static_cast<std::size_t>(glb.parents()[glb.node(object)])]["name"], "scene");
  }
  EXPECT_EQ(nodes[static_cast<std::size_t>(glb.parents()[glb.node("Arm")])]["name"], "Hips");

  const std::string results = contentOf(world.folder / "out.jsonl");
  std::istringstream lines(results);
  std::string line;
  int contacts = 0;
  const Channels channels(glb);
  while (std::getline(lines, line)) {
    const json step = json::parse(line);
    for (const json& contact : step.value("contacts", json::array())) {
      ++contacts;
      json expected = contact;
      expected["step"] = step["step"];
      expected["missed_by_poses"] = true;
      char title[100];
      const double timeS = contact["time"];
      std::snprintf(title, sizeof title, "%s at wall, %.3f s",
                    contact["link"].get<std::string>().c_str(), timeS);
      const std::size_t node = glb.node(title);
      json extras = nodes[node]["extras"];
      EXPECT_EQ(extras["touch"]["begin"], contact["time"]);
      EXPECT_EQ(extras["touch"]["steps"], json({step["step"], step["step"]}));
      EXPECT_EQ(extras["touch"]["missed"], true);
      extras.erase("touch");
      EXPECT_EQ(extras, expected);
      for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(nodes[node]["translation"][i], contact["point"][i]);
      }
      EXPECT_EQ(channels.scaleAt(node, timeS - 1e-3), 0.0);
      EXPECT_EQ(channels.scaleAt(node, timeS + 1e-6), 1.0);
      std::snprintf(title, sizeof title, "sweep of %s, 0.100 to 0.200 s",
                    contact["link"].get<std::string>().c_str());
      const std::size_t sweep = glb.node(title);
      EXPECT_EQ(channels.scaleAt(sweep, 0.099), 0.0);
      EXPECT_EQ(channels.scaleAt(sweep, 0.101), 1.0);
      EXPECT_GT(nodes[sweep]["extras"]["certified_error"], 0.0);
    }
  }
  EXPECT_EQ(contacts, 2);
}

TEST(ReplayGlbProgram, SaysWhatATightBudgetLeavesOut) {
  const SmallWorld world;
  const std::string path = world.folder / "out.glb";
  const Ended ended = runForetouch(world.replay(
      {"--output", world.folder / "out.jsonl", "--glb", path, "--glb-triangles", "300"}));
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_NE(ended.err.find("1 LSS and the meshes of 0 links are left out"), std::string::npos)
      << ended.err;
  EXPECT_NE(ended.err.find("the swept volumes of 2 touches are left out"), std::string::npos);
  GlbReader(contentOf(path)).check();
}

TEST(ReplayGlbProgram, RefusesBadUse) {
  const SmallWorld world;
  const std::string out = world.folder / "out.jsonl";
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
      {{"--glb", out}, "is to hold the results as well; expected another file"},
      {{"--glb", world.folder / "clip.bvh"}, "is an input as well"},
      {{"--glb", world.folder / "nowhere/out.glb"}, "nowhere"},
      {{"--glb", world.folder / "out.glb", "--glb-triangles", "0"}, "--glb-triangles"},
      {{"--glb", world.folder / "out.glb", "--glb-triangles", "many"}, "--glb-triangles"},
  };
  for (const auto& [more, expected] : cases) {
    std::vector<std::string> arguments{"--output", out};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Ended ended = runForetouch(world.replay(arguments));
    EXPECT_EQ(ended.exitCode, 2) << expected;
    EXPECT_NE(ended.err.find(expected), std::string::npos) << ended.err;
    EXPECT_EQ(world.folder.names().count("out.glb"), 0u);
  }
}

// Times of 1 us, 100 s into a clip, are the same float.
TEST(ReplayGlb, RefusesTimesThatFloatsDoNotTellApart) {
  EXPECT_TRUE(tools::checkTimes({0.0, 0.1, 0.2}).ok());
  const auto refused = tools::checkTimes({0.0, 100.0, 100.000001});
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().message.find("100 s"), std::string::npos);
}

/// A chain of joints that all turn about all axes.
std::string turningClip(int joints, int frames, std::mt19937_64& random) {
  std::uniform_real_distribution<double> angle(-180.0, 180.0), place(-1.0, 1.0);
  std::string text =
      "HIERARCHY\nROOT J0\n{\nOFFSET 0 0 0\nCHANNELS 6 Xposition Yposition Zposition "
      "Zrotation Xrotation Yrotation\n";
  for (int joint = 1; joint < joints; ++joint) {
    text += "JOINT J" + std::to_string(joint) +
            "\n{\nOFFSET 0.1 0.2 0.05\nCHANNELS 3 Zrotation Xrotation Yrotation\n";
  }
  text += "End Site\n{\nOFFSET 0 0.1 0\n}\n";
  for (int joint = 0; joint < joints; ++joint) text += "}\n";
  text += "MOTION\nFrames: " + std::to_string(frames) + "\nFrame Time: 0.04\n";
  for (int frame = 0; frame < frames; ++frame) {
    for (int i = 0; i < 3; ++i) text += std::to_string(place(random)) + " ";
    for (int joint = 0; joint < joints; ++joint) {
      for (int i = 0; i < 3; ++i) text += std::to_string(angle(random)) + " ";
    }
    text += "\n";
  }
  return text;
}

std::string chainAvatar(int joints) {
  json links = json::array();
  for (int joint = 0; joint < joints; ++joint) {
    json link = {{"name", "J" + std::to_string(joint)},
                 {"parent", nullptr},
                 {"offset", {0.1, 0.2, 0.05}},
                 {"lss", json::array({{{"a", {0, 0, 0}}, {"b", {0, 0.1, 0}}, {"radius", 0.02}}})}};
    if (joint > 0) link["parent"] = "J" + std::to_string(joint - 1);
    links.push_back(link);
  }
  return json{{"format", "foretouch-avatar"}, {"version", 1}, {"links", links}}.dump();
}

/// Lets a joint turn by half a turn, to rounding, in every step: the last bits of doubles tell
/// which way.
void turnByHalves(Clip& clip, JointId joint) {
  std::mt19937_64 random(8);
  std::normal_distribution<double> normal;
  Quaternion turn(normal(random), normal(random), normal(random), normal(random));
  for (Pose& pose : clip.frames) {
    turn = Quaternion(turn *
                      Quaternion(0, normal(random), normal(random), normal(random)).normalized())
               .normalized();
    pose.rotations[static_cast<std::size_t>(joint)] = turn;
  }
}

tools::ReplayInputs chainInputs(int joints, int frames, const Vector3d& origin) {
  std::mt19937_64 random(7);
  Avatar avatar = parseAvatar(chainAvatar(joints), "chain.json").value();
  Clip clip = parseBvh(turningClip(joints, frames, random), "chain.bvh").value();
  turnByHalves(clip, 1);
  JointMatch match = matchJoints(avatar.skeleton(), clip.skeleton).value();
  tools::ReplayRequest request;
  request.placement.origin = origin;
  const auto steps = tools::selectSteps(clip, std::nullopt).value();
  return {request,           Scene::build(wallAt(0.0, "wall")).value(),
          std::move(avatar), std::move(clip),
          std::move(match),  steps,
          QueryOptions{}};
}

/// The key at or before a time, and how far on to the next it is.
template <typename Key>
std::pair<std::size_t, double> between(const std::vector<Key>& keys, double timeS) {
  std::size_t key = 0;
  while (key + 2 < keys.size() && keys[key + 1].timeS <= timeS) ++key;
  const double length = keys[key + 1].timeS - keys[key].timeS;
  return {key, (timeS - keys[key].timeS) / length};
}

/// glTF 2.0, appendix C, "Spherical Linear Interpolation", in long double.
Matrix3d slerped(const Quaternion& p, const Quaternion& q, double t) {
  using Wide = Eigen::Matrix<long double, 4, 1>;
  const Wide from = p.coeffs().cast<long double>(), to = q.coeffs().cast<long double>();
  const long double dot = from.dot(to);
  const long double angle = std::acos(std::min(1.0L, std::abs(dot)));
  Wide at = from;
  if (std::sin(angle) > 1e-12L) {
    at = std::sin(angle * (1.0L - t)) / std::sin(angle) * from +
         (dot < 0 ? -1.0L : 1.0L) * std::sin(angle * t) / std::sin(angle) * to;
  }
  return Quaternion(at.normalized().cast<double>()).toRotationMatrix();
}

/// The model's nodes in the world at a time, as its animation says.
std::vector<Affine> framesAt(const Model& model, double timeS) {
  std::vector<Affine> toParent;
  for (const ModelNode& node : model.nodes) toParent.push_back(node.toParent);
  for (const ModelTrack& track : model.animations.at(0).tracks) {
    Affine& frame = toParent.at(static_cast<std::size_t>(track.node));
    if (track.rotations.size() > 1) {
      const auto [key, t] = between(track.rotations, timeS);
      frame.linear = slerped(track.rotations[key].value, track.rotations[key + 1].value, t);
    }
    if (track.positions.size() > 1) {
      const auto [key, t] = between(track.positions, timeS);
      frame.translation =
          (1.0 - t) * track.positions[key].value + t * track.positions[key + 1].value;
    }
  }
  std::vector<Affine> world;
  for (std::size_t i = 0; i < toParent.size(); ++i) {
    const std::int32_t parent = model.nodes[i].parent;
    world.push_back(parent < 0 ? toParent[i]
                               : world[static_cast<std::size_t>(parent)] * toParent[i]);
  }
  return world;
}

std::size_t nodeNamed(const Model& model, const std::string& name) {
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    if (model.nodes[i].name == name) return i;
  }
  ADD_FAILURE() << "no node " << name;
  return 0;
}

/// Largest distance between what the importer reads back and the in-between motion, at poses and
/// between them, and the largest difference of rotations. Keys have their times as floats: a few
/// millionths of a step from where they belong.
void expectTheMotion(const tools::ReplayInputs& inputs, const Model& model) {
  double worstPlace = 0.0, worstTurn = 0.0;
  const double step = inputs.clip.frameTimeS;
  for (std::int64_t k = 0; k < inputs.steps.count; ++k) {
    const Pose from = tools::poseAtFrame(inputs, k).value();
    const Pose to = tools::poseAtFrame(inputs, k + 1).value();
    const ChainMotion motion(inputs.avatar.skeleton(), from, to);
    for (const double t : {0.0, 0.1, 0.25, 0.5, 0.61, 0.99, 1.0}) {
      const auto frames = framesAt(model, (static_cast<double>(k) + t) * step);
      for (LinkId link = 0; link < inputs.avatar.numLinks(); ++link) {
        const LinkState state = motion.stateAt(link, t);
        const Affine& read = frames[nodeNamed(model, inputs.avatar.skeleton().name(link))];
        worstPlace = std::max(worstPlace, (read.translation - state.p_WL).norm());
        worstTurn = std::max(worstTurn, (read.linear - state.R_WL).norm());
      }
    }
  }
  EXPECT_LT(worstPlace, 1e-5);
  EXPECT_LT(worstTurn, 3e-5);
}

TEST(ReplayGlb, AnotherReaderFindsTheInBetweenMotionAtAndBetweenPoses) {
  for (const Vector3d& origin : {Vector3d(0, 0, 0), Vector3d(4321.5, 10.0, -9876.25)}) {
    const TempFolder folder;
    const tools::ReplayInputs inputs = chainInputs(6, 40, origin);
    tools::ReplayGlb glb(inputs, {folder / "out.glb", 100'000});
    const auto written = glb.write({});
    ASSERT_TRUE(written.ok()) << describe(written.error());
    EXPECT_TRUE(written.value().empty());
    GlbReader(contentOf(folder / "out.glb")).check();
    const auto model = importModel(folder / "out.glb");
    ASSERT_TRUE(model.ok()) << describe(model.error());
    ASSERT_EQ(model.value().animations.size(), 1u);
    expectTheMotion(inputs, model.value());
  }
}

// The sign of a dot product of zero counts as positive: also after keys that were negated.
TEST(RotationKeys, GoTheWayOfThePosesThroughHalfTurnsAndSigns) {
  const auto aboutZ = [](double degrees, double sign) {
    const double half = 0.5 * degrees * 3.14159265358979323846 / 180.0;
    return Quaternion(sign * std::cos(half), 0, 0, sign * std::sin(half));
  };
  std::vector<Pose> poses;
  for (const Quaternion& q : {aboutZ(0, 1), aboutZ(20, -1), Quaternion(0, 1, 0, 0),
                              Quaternion(1, 0, 0, 0), Quaternion(0, 0, 0, 1)}) {
    poses.push_back({{q}, {Vector3d::Zero()}});
  }
  const auto keys = tools::rotationKeys(poses, 0);
  ASSERT_EQ(keys.values.size(), poses.size());
  EXPECT_TRUE(keys.haveMiddles);
  EXPECT_FALSE(keys.areConstant);
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const double given = poses[i - 1].rotations[0].dot(poses[i].rotations[0]);
    const double kept = keys.values[i - 1].dot(keys.values[i]);
    EXPECT_NEAR(kept, std::abs(given), 1e-15);
    // The same arc: both ends as given, or both negated, up to the sign that shortens it.
    const double first = keys.values[i - 1].dot(poses[i - 1].rotations[0]);
    const double second = keys.values[i].dot(poses[i].rotations[0]);
    EXPECT_NEAR(first * second, given < 0.0 ? -1.0 : 1.0, 1e-12);
  }
}

}  // namespace
}  // namespace foretouch::test
