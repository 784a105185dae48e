// A robot's joint positions as a clip.
#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "assets/model/edge_table.h"
#include "assets/model/model_avatar.h"
#include "tests/assets/model_samples.h"
#include "tests/support/holds.h"

namespace foretouch {
namespace {

using test::addMesh;
using test::addNode;
using test::at;
using test::holds;
using test::Vector3d;

/// Upper arm and forearm of 1 m each turn about z, a finger slides along the forearm.
Model robot() {
  Model model;
  const auto base = addNode(model, "base", -1);
  const auto upper = addNode(model, "upper", base, {0, 1, 0});
  const auto fore = addNode(model, "fore", upper, {1, 0, 0});
  const auto finger = addNode(model, "finger", fore, {1, 0, 0});
  const auto plate = addNode(model, "plate", finger);
  const auto joint = [&](std::int32_t node, const std::string& name, ModelJointType type,
                         const Vector3d& axis, double lower, double upperLimit) {
    ModelNode& n = model.nodes[at(node)];
    n.jointName = name;
    n.joint = type;
    n.axis = axis;
    n.lowerLimit = lower;
    n.upperLimit = upperLimit;
    n.lss = {{{0, 0, 0}, {0.5, 0, 0}, 0.1}};
  };
  joint(upper, "shoulder", ModelJointType::Revolute, {0, 0, 1}, -2, 2);
  joint(fore, "elbow", ModelJointType::Continuous, {0, 0, 1}, -0.1, 0.1);
  joint(finger, "slide", ModelJointType::Prismatic, {1, 0, 0}, 0, 0.3);
  joint(plate, "weld", ModelJointType::Fixed, {0, 0, 1}, 0, 0);
  return model;
}

bool tableIsNoted(const Clip& clip, const std::string& part) {
  for (const std::string& note : clip.notes) {
    if (note.find(part) != std::string::npos) return true;
  }
  return false;
}

TEST(ClipFromJointPositions, PutsTheFingerWhereTrigonometryDoes) {
  std::string csv = "time,shoulder,slide,elbow\n";
  for (int i = 0; i <= 20; ++i) {
    const double t = 0.05 * i;
    csv += std::to_string(t) + "," + std::to_string(t) + "," + std::to_string(0.2 * t) + "," +
           std::to_string(-3 * t) + "\n";
  }
  const auto clip = clipFromJointPositions(robot(), csv, "log.csv");
  ASSERT_TRUE(clip.ok()) << describe(clip.error());
  ASSERT_EQ(clip.value().frames.size(), 21u);
  EXPECT_NEAR(clip.value().frameTimeS, 0.05, 1e-12);
  const auto finger = *clip.value().skeleton.find("finger");
  for (int i = 0; i <= 20; ++i) {
    const double t = 0.05 * i, reach = 1 + 0.2 * t;
    const auto states = test::statesIn(clip.value().skeleton, clip.value().frames[at(i)]);
    const Vector3d expected(std::cos(t) + reach * std::cos(t - 3 * t),
                            1 + std::sin(t) + reach * std::sin(t - 3 * t), 0);
    EXPECT_LT((states[at(finger)].p_WL - expected).norm(), 3e-6);  // six digits in the text
    const Vector3d ahead(std::cos(-2 * t), std::sin(-2 * t), 0);
    EXPECT_LT((states[at(finger)].R_WL.col(0) - ahead).norm(), 3e-6);
  }
  EXPECT_TRUE(clip.value().notes.empty());
}

TEST(ClipFromJointPositions, HasTheAvatarsJointsAndMovesThoseThatAreNamed) {
  const Model model = robot();
  const Clip clip = clipFromJointPositions(model, "time,elbow\n0,0\n1,0.5\n", "a.csv").value();
  const Skeleton avatar = avatarFromModel(model).value().avatar.skeleton();
  ASSERT_EQ(avatar.numJoints(), clip.skeleton.numJoints());
  for (JointId j = 0; j < avatar.numJoints(); ++j) {
    EXPECT_EQ(avatar.name(j), clip.skeleton.name(j));
    EXPECT_EQ(clip.hasRotation[at(j)], avatar.name(j) == "fore");
    EXPECT_FALSE(clip.hasTranslation[at(j)]);
  }
  EXPECT_EQ(clip.frames[1].rotations[0].coeffs(), Quaternion::Identity().coeffs());
  const Clip slid = clipFromJointPositions(model, "time,slide\n0,0\n1,0.25\n", "a.csv").value();
  EXPECT_TRUE(slid.hasTranslation[at(*slid.skeleton.find("finger"))]);
}

/// How far apart two rotations are, as an angle (rad); `turn` is one about z.
double offFrom(const Quaternion& turn, double angle) {
  const double w = std::cos(angle / 2), z = std::sin(angle / 2);
  return 2.0 * std::acos(std::min(1.0, std::abs(turn.w() * w + turn.z() * z)));
}

TEST(ClipFromJointPositions, TurnsTheWayThatTheNumbersSayFromRowToRow) {
  const Clip clip =
      clipFromJointPositions(robot(), "time,elbow,slide\n5,-2,0\n6,2,0.2\n7,-8,0.2\n", "a.csv")
          .value();
  ASSERT_EQ(clip.framesPerRow, 4);  // 10 rad in parts of at most 3
  ASSERT_EQ(clip.frames.size(), 9u);
  EXPECT_EQ(clip.frameTimeS, 0.25);
  EXPECT_NEAR(clip.mostTurn, 2.5, 1e-12);
  EXPECT_TRUE(tableIsNoted(clip, "10.000000 rad from one row to the next"));
  EXPECT_TRUE(tableIsNoted(clip, "4 steps make up a row"));
  const auto fore = at(*clip.skeleton.find("fore")), finger = at(*clip.skeleton.find("finger"));
  for (std::size_t i = 0; i + 1 < clip.frames.size(); ++i) {
    // Halfway along the shorter arc from frame to frame.
    const double s = 0.25 * (static_cast<double>(i) + 0.5);
    const double angle = s < 1.0 ? -2.0 + 4.0 * s : 2.0 - 10.0 * (s - 1.0);
    const Quaternion &from = clip.frames[i].rotations[fore],
                     &to = clip.frames[i + 1].rotations[fore];
    const double sign = from.dot(to) < 0.0 ? -1.0 : 1.0;
    const Quaternion half((from.coeffs() + sign * to.coeffs()).normalized());
    EXPECT_LT(offFrom(half, angle), 1e-7) << i;
    const double slid = clip.frames[i].translations[finger].x() - 1.0;
    EXPECT_NEAR(slid, i < 4 ? 0.05 * static_cast<double>(i) : 0.2, 1e-12) << i;
  }
}

TEST(ClipFromJointPositions, LetsJointsFollowTheOneThatTheyMimic) {
  Model model = robot();
  const auto node = [&](const char* name) {
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
      if (model.nodes[i].name == name) return static_cast<std::int32_t>(i);
    }
    return -1;
  };
  model.mimics.push_back({node("fore"), node("upper"), -3.0, 0.5});
  const Clip clip = clipFromJointPositions(model, "time,shoulder\n0,0\n1,1.5\n", "a").value();
  EXPECT_EQ(clip.framesPerRow, 2) << "the follower turns by 4.5 rad";
  const auto fore = at(*clip.skeleton.find("fore"));
  EXPECT_LT(offFrom(clip.frames[0].rotations[fore], 0.5), 1e-7);
  EXPECT_LT(offFrom(clip.frames[1].rotations[fore], -1.75), 1e-7);
  EXPECT_LT(offFrom(clip.frames[2].rotations[fore], -4.0), 1e-7);
  EXPECT_TRUE(clip.hasRotation[fore]);
  // A table that names it says where it is.
  const Clip named =
      clipFromJointPositions(model, "time,shoulder,elbow\n0,0,1\n1,1.5,1\n", "a").value();
  EXPECT_LT(offFrom(named.frames[1].rotations[fore], 1.0), 1e-7);
}

TEST(ClipFromJointPositions, MovesAPlanarBaseByItsThreeNumbers) {
  Model model = robot();
  for (ModelNode& node : model.nodes) {
    if (node.name == "upper") node.joint = ModelJointType::Planar;  // about z
  }
  const Clip clip = clipFromJointPositions(
                        model, "time,shoulder/x,shoulder/y,shoulder/angle\n0,1,2,0\n1,3,2,4\n", "a")
                        .value();
  const auto upper = at(*clip.skeleton.find("upper"));
  ASSERT_EQ(clip.framesPerRow, 2);
  EXPECT_LT((clip.frames[1].translations[upper] - Vector3d(2, 3, 0)).norm(),
            1e-12);  // y = 1 at rest
  EXPECT_LT(offFrom(clip.frames[1].rotations[upper], 2.0), 1e-7);
  const auto whole = clipFromJointPositions(model, "time,shoulder\n0,0\n1,0\n", "a");
  ASSERT_FALSE(whole.ok());
  EXPECT_NE(whole.error().message.find("'shoulder/angle'"), std::string::npos);
}

TEST(ClipFromJointPositions, RefusesAWayThatTakesTooManyPoses) {
  const auto clip = clipFromJointPositions(robot(), "time,elbow\n0,0\n1,0\n2,1e6\n", "log.csv");
  ASSERT_FALSE(clip.ok());
  EXPECT_EQ(clip.error().line, 4);
  EXPECT_EQ(clip.error().code, ErrorCode::LimitExceeded);
}

TEST(ClipFromSampledJoints, MovesEveryJointWithinItsLimits) {
  const Clip clip = clipFromSampledJoints(robot(), 500, 3).value();
  ASSERT_EQ(clip.frames.size(), 500u);
  const auto upper = at(*clip.skeleton.find("upper"));
  double most = 0.0;
  for (const Pose& pose : clip.frames) {
    most = std::max(most, offFrom(pose.rotations[upper], 0.0));
  }
  EXPECT_LE(most, 2.0 + 1e-7);
  EXPECT_GT(most, 1.9);
  EXPECT_TRUE(clip.hasRotation[upper]);
  EXPECT_TRUE(clip.hasTranslation[at(*clip.skeleton.find("finger"))]);
}

TEST(ClipFromJointPositions, NotesLimitsAndJointsThatDoNotMove) {
  const Clip clip =
      clipFromJointPositions(robot(),
                             "time,shoulder,elbow,slide,weld\n0,-2.5,99,-0.125,1\n1,0,0,0,1\n", "a")
          .value();
  EXPECT_TRUE(tableIsNoted(clip, "by up to 0.5"));
  EXPECT_TRUE(tableIsNoted(clip, "'shoulder', 'slide'"));  // continuous joints have no limits
  EXPECT_TRUE(tableIsNoted(clip, "do not move are left out: 'weld'"));
}

TEST(ClipFromJointPositions, BearsWhatSpreadsheetsWrite) {
  const Clip clip =
      clipFromJointPositions(robot(),
                             "\xef\xbb\xbf# a log\r\n\"Time\" , \"elbow\"\r\n\r\n 0.000 , +0.5 \r\n"
                             "0.0334,1e-3\r\n# more\r\n0.0667,-.5",
                             "a")
          .value();
  EXPECT_EQ(clip.frames.size(), 3u);
  EXPECT_NEAR(clip.frameTimeS, 0.03335, 1e-12);
}

struct Refusal {
  std::string csv;
  ErrorCode code;
  std::int64_t line;
};

TEST(ClipFromJointPositions, RefusesWhatItWouldHaveToGuessAndNamesTheLine) {
  std::string wide = "time";
  for (int i = 0; i < 5000; ++i) wide += ",j" + std::to_string(i);
  const std::string head = "time,elbow\n";
  for (const Refusal& refusal : std::vector<Refusal>{
           {"", ErrorCode::Empty, -1},
           {"\n\n# nothing\n", ErrorCode::Empty, -1},
           {"elbow,time\n0,0\n1,0\n", ErrorCode::Syntax, 1},
           {"time\n0\n1\n", ErrorCode::OutOfRange, 1},
           {wide + "\n", ErrorCode::OutOfRange, 1},
           {"time,elbow,elbow\n0,0,0\n1,0,0\n", ErrorCode::DuplicateName, 1},
           {"time,elbow,fore\n0,0,0\n1,0,0\n", ErrorCode::DuplicateName, -1},
           {"time,knee\n0,0\n1,0\n", ErrorCode::UnknownName, -1},
           {head, ErrorCode::Empty, -1},
           {head + "0,1\n", ErrorCode::Empty, -1},
           {head + "0,1\n1\n", ErrorCode::Syntax, 3},
           {head + "0,1\n1,2,3\n", ErrorCode::Syntax, 3},
           {head + "0,1\n1,two\n", ErrorCode::Syntax, 3},
           {head + "0,1\n1,\n", ErrorCode::Syntax, 3},
           {head + "0,1\n\n1,nan\n", ErrorCode::NonFinite, 4},
           {head + "0,1\n1,1e999\n", ErrorCode::NonFinite, 3},
           {head + "0,1\n1,2\n2.03,3\n3,4\n", ErrorCode::OutOfRange, 4},
           {head + "0,1\n0,2\n", ErrorCode::OutOfRange, 3},
           {head + "1,1\n0,2\n", ErrorCode::OutOfRange, 3},
           {head + "0,1\n5000,2\n", ErrorCode::OutOfRange, 3},
           {"time,slide\n0,0\n1,1e9\n", ErrorCode::OutOfRange, 3},
           {std::string("time,el\0bow\n0,0\n1,0\n", 20), ErrorCode::UnknownName, -1}}) {
    SCOPED_TRACE(refusal.csv.substr(0, 60));
    const auto clip = clipFromJointPositions(robot(), refusal.csv, "log.csv");
    ASSERT_FALSE(clip.ok());
    EXPECT_EQ(clip.error().code, refusal.code) << describe(clip.error());
    EXPECT_EQ(clip.error().line, refusal.line) << describe(clip.error());
    EXPECT_EQ(clip.error().file, "log.csv");
  }
}

TEST(ClipFromJointPositions, SpacingMayBeOffByAHundredthAndNoMore) {
  const std::string head = "time,elbow\n0,0\n1,0\n2,0\n";
  EXPECT_TRUE(clipFromJointPositions(robot(), head + "3.009,0\n4,0\n", "a").ok());
  EXPECT_FALSE(clipFromJointPositions(robot(), head + "3.011,0\n4,0\n", "a").ok());
}

TEST(ReadEdgeTable, TakesTwoRowsOfEachEdgeInTheRobotsOrder) {
  const Robot made = robotFromModel(robot()).value().robot;
  const std::string head = "edge,slide,shoulder,elbow\n";
  const auto edges =
      readEdgeTable(made, head + "0,0.1,1,2\n0,0.2,3,4\n# far\n1,0,-1,9\n1,0,-1,-9\n", "edges.csv");
  ASSERT_TRUE(edges.ok()) << describe(edges.error());
  EXPECT_EQ(edges.value().count, 2u);
  EXPECT_EQ(edges.value().q0, (std::vector<double>{1, 2, 0.1, -1, 9, 0}));
  EXPECT_EQ(edges.value().q1, (std::vector<double>{3, 4, 0.2, -1, -9, 0}));
  const std::string row = "0,0,0,0\n";
  for (const Refusal& refusal : std::vector<Refusal>{
           {"", ErrorCode::Empty, -1},
           {head, ErrorCode::Empty, -1},
           {head + row, ErrorCode::Empty, -1},
           {"time,slide,shoulder,elbow\n" + row + row, ErrorCode::Syntax, 1},
           {"edge,slide,shoulder\n0,0,0\n0,0,0\n", ErrorCode::UnknownName, -1},
           {"edge,slide,shoulder,elbow,knee\n0,0,0,0,0\n0,0,0,0,0\n", ErrorCode::UnknownName, -1},
           {head + row + "1,0,0,0\n", ErrorCode::OutOfRange, 3},
           {head + row + row + row, ErrorCode::OutOfRange, 4},
           {head + row + row + "2,0,0,0\n2,0,0,0\n", ErrorCode::OutOfRange, 4},
           {head + row + "0,0,0,1001\n", ErrorCode::OutOfRange, 3},
           {head + row + "0,0,0,nan\n", ErrorCode::NonFinite, 3}}) {
    SCOPED_TRACE(refusal.csv);
    const auto refused = readEdgeTable(made, refusal.csv, "edges.csv");
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().code, refusal.code) << describe(refused.error());
    EXPECT_EQ(refused.error().line, refusal.line) << describe(refused.error());
    EXPECT_TRUE(holds(describe(refused.error()), "edges.csv")) << describe(refused.error());
  }
}

}  // namespace
}  // namespace foretouch
