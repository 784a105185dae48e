// Robots and edges in C: what C++ answers, and bad input is refused.
#include <cmath>
#include <foretouch/robots.h>
#include <string>
#include <vector>

#include "middleware/edges/edge_query.h"
#include "tests/bindings/c_world.h"
#include "tests/bindings/importer.h"
#include "tests/middleware/edges/arm_among_wires.h"
#include "tests/support/temp_folder.h"
#include "tests/support/threads.h"

namespace foretouch {
namespace {

struct Release {
  void operator()(ft_robot* robot) const { ft_robot_destroy(robot); }
  void operator()(ft_edges* edges) const { ft_edges_destroy(edges); }
};
using RobotHandle = std::unique_ptr<ft_robot, Release>;
using EdgesHandle = std::unique_ptr<ft_edges, Release>;

std::vector<ft_robot_joint> jointsOf(const Robot& robot) {
  std::vector<ft_robot_joint> joints;
  for (const RobotJoint& joint : robot.joints()) {
    ft_robot_joint c{};
    c.kind = static_cast<std::int32_t>(joint.kind);
    c.mimic_of = joint.mimicOf;
    for (int i = 0; i < 3; ++i) c.axis[i] = joint.axis[i];
    c.lower = joint.lower;
    c.upper = joint.upper;
    c.mimic_factor = joint.mimicFactor;
    c.mimic_offset = joint.mimicOffset;
    joints.push_back(c);
  }
  return joints;
}

RobotHandle makeRobot(const Robot& robot) {
  const auto avatar = test::makeAvatar(robot.avatar());
  const auto joints = jointsOf(robot);
  ft_robot* made = nullptr;
  EXPECT_EQ(ft_robot_create(avatar.get(), joints.data(), joints.size(), nullptr, &made), FT_OK)
      << ft_last_error();
  return RobotHandle(made);
}

class CRobots : public testing::Test {
 protected:
  CRobots() {
    for (const auto& [x, y] : {std::pair(0.7, 0.5), std::pair(-0.6, 0.7), std::pair(0.1, -0.9)}) {
      std::vector<oracle::Triangle> judged;
      test::addWire(x, y, raw_, judged);
    }
    raw_.objectNames = {"wires"};
    scene_ = test::makeScene(raw_);
  }
  EdgesHandle edges(const ft_edge_options* options = nullptr) {
    ft_edges* made = nullptr;
    EXPECT_EQ(ft_edges_create(robot_.get(), scene_.get(), options, &made), FT_OK)
        << ft_last_error();
    return EdgesHandle(made);
  }
  Robot known_ = test::arm(-2.9, 2.9);
  RobotHandle robot_ = makeRobot(known_);
  RawScene raw_;
  test::SceneHandle scene_;
};

TEST_F(CRobots, TellTheirCoordinates) {
  size_t count = 0;
  ASSERT_EQ(ft_robot_coordinate_count(robot_.get(), &count), FT_OK);
  ASSERT_EQ(count, 3U);
  std::vector<ft_robot_coordinate> all(3);
  all[0].size = sizeof all[0];
  ASSERT_EQ(ft_robot_coordinates(robot_.get(), all.data(), 3, &count), FT_OK);
  EXPECT_STREQ(all[2].name, "j2");
  EXPECT_EQ(all[1].lower, -2.9);
  EXPECT_EQ(all[1].is_angle, 1);
  EXPECT_EQ(all[1].is_periodic, 0);
  const double q[3] = {test::kPi / 2, 0, 0};
  double rotations[12], translations[9];
  ASSERT_EQ(ft_robot_pose(robot_.get(), q, 3, rotations, translations, 3, &count), FT_OK);
  EXPECT_NEAR(rotations[0], std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(rotations[3], std::sqrt(0.5), 1e-15);
}

TEST_F(CRobots, GoTheWayThatTheirNumbersSay) {
  const double q[6] = {-2, 0, 0, 2, 0, 0};
  size_t count = 0;
  ASSERT_EQ(ft_robot_path(robot_.get(), q, 2, 3, nullptr, nullptr, nullptr, 0, &count), FT_OK);
  ASSERT_EQ(count, 3U);
  double rotations[36], translations[27], at[3];
  ASSERT_EQ(ft_robot_path(robot_.get(), q, 2, 3, rotations, translations, at, 3, &count), FT_OK);
  EXPECT_EQ(at[1], 0.5);
  EXPECT_EQ(at[2], 1.0);
  EXPECT_NEAR(rotations[12], 1.0, 1e-15);  // by way of zero, not of the half turn
  EXPECT_NEAR(rotations[24], std::cos(1.0), 1e-15);
  EXPECT_EQ(ft_robot_path(robot_.get(), q, 2, 3, rotations, translations, at, 2, &count),
            FT_ERROR_BUFFER_TOO_SMALL);
  EXPECT_EQ(ft_robot_path(robot_.get(), q, 2, 2, rotations, translations, at, 3, &count),
            FT_ERROR_MISMATCH);
  EXPECT_EQ(ft_robot_path(robot_.get(), q, 0, 3, rotations, translations, at, 3, &count),
            FT_ERROR_EMPTY);
}

TEST_F(CRobots, HavePairRulesOfDrawnConfigurationsAsInCpp) {
  ft_robot_pair_options options;
  ASSERT_EQ(ft_robot_pair_options_init(&options, sizeof options), FT_OK);
  EXPECT_EQ(options.samples, RobotPairOptions().samples);
  EXPECT_EQ(options.seed, RobotPairOptions().seed);
  EXPECT_EQ(options.always_share, RobotPairOptions().alwaysShare);
  options.samples = 300;
  options.seed = 5;
  ft_pair_rules* made = nullptr;
  ASSERT_EQ(ft_pair_rules_create_of_robot(robot_.get(), &options, &made), FT_OK) << ft_last_error();
  const test::RulesHandle rules(made);
  RobotPairOptions same;
  same.samples = 300;
  same.seed = 5;
  const PairRules cpp = PairRules::derive(known_, same).value();
  std::size_t required = 0;
  std::vector<ft_pair_touches> touches(cpp.touches().size());
  ASSERT_EQ(ft_pair_rules_touches(made, touches.data(), touches.size(), &required), FT_OK);
  ASSERT_EQ(required, touches.size());
  for (std::size_t i = 0; i < touches.size(); ++i) {
    EXPECT_EQ(touches[i].a, cpp.touches()[i].a);
    EXPECT_EQ(touches[i].b, cpp.touches()[i].b);
    EXPECT_EQ(touches[i].touches, cpp.touches()[i].touches);
  }
  ft_edge_options asked;
  ASSERT_EQ(ft_edge_options_init(&asked, sizeof asked), FT_OK);
  asked.self = made;
  edges(&asked);  // they are rules of the robot's avatar
  options.samples = 0;
  EXPECT_EQ(ft_pair_rules_create_of_robot(robot_.get(), &options, &made), FT_ERROR_OUT_OF_RANGE);
}

TEST_F(CRobots, AnswerEdgesAsCppDoes) {
  constexpr std::size_t kEdges = 300;
  const auto q0 = test::randomConfigurations(1, kEdges), q1 = test::randomConfigurations(2, kEdges);
  ft_avatar* links = nullptr;
  ASSERT_EQ(ft_robot_avatar(robot_.get(), &links), FT_OK);
  const test::AvatarHandle avatar(links);
  ft_pair_rules* rules = nullptr;
  ASSERT_EQ(ft_pair_rules_create(links, nullptr, &rules), FT_OK) << ft_last_error();
  const test::RulesHandle self(rules);
  ft_edge_options options;
  ASSERT_EQ(ft_edge_options_init(&options, sizeof options), FT_OK);
  options.self = rules;
  options.clearance = 0.01;
  options.threads = test::kHasThreads ? 3 : 1;
  const auto asked = edges(&options);
  std::vector<ft_edge> answers(kEdges);
  answers[0].size = sizeof answers[0];
  ASSERT_EQ(ft_edges_answer(asked.get(), q0.data(), q1.data(), kEdges, 3, answers.data()), FT_OK)
      << ft_last_error();

  EdgeOptions same;
  same.self = PairRules::derive(known_.avatar()).value();
  same.clearance = 0.01;
  const auto cpp = EdgeQuery::build(known_, Scene::build(raw_).value(), same).value();
  Scratch scratch;
  int clear = 0;
  for (std::size_t i = 0; i < kEdges; ++i) {
    const auto expected = cpp.answer(&q0[3 * i], &q1[3 * i], 3, scratch).value();
    ASSERT_EQ(answers[i].verdict, static_cast<std::int32_t>(expected.verdict)) << i;
    ASSERT_EQ(answers[i].free_until, expected.freeUntil) << i;
    ASSERT_EQ(answers[i].is_usable, expected.isUsable() ? 1 : 0) << i;
    ASSERT_EQ(answers[i].breach_at_0, expected.breachAt0.joint) << i;
    ASSERT_EQ(answers[i].breach_at_1, expected.breachAt1.joint) << i;
    ft_contact contact{};
    contact.size = sizeof contact;
    ft_other_link other{};
    const auto status = ft_edges_contact(asked.get(), i, &contact, &other);
    if (expected.verdict == Verdict::Clear) {
      ++clear;
      ASSERT_EQ(status, FT_ERROR_MISMATCH);
      continue;
    }
    ASSERT_EQ(status, FT_OK) << ft_last_error();
    ASSERT_EQ(contact.link, expected.contact.link);
    ASSERT_EQ(contact.toi, expected.contact.toi);
    ASSERT_EQ(contact.triangle, expected.contact.triangle);
    ASSERT_EQ(other.link, expected.contact.other);
    ASSERT_EQ(contact.object, expected.contact.other < 0 ? 0 : -1);
  }
  EXPECT_GT(clear, 20);
  EXPECT_LT(clear, 280);
}

TEST_F(CRobots, SayHowNearEdgesCome) {
  const auto asked = edges();
  constexpr std::size_t kEdges = 100;
  const auto q0 = test::randomConfigurations(11, kEdges),
             q1 = test::randomConfigurations(12, kEdges);
  std::vector<ft_clearance> answers(kEdges);
  answers[0].size = sizeof answers[0];
  std::vector<double> slopes0(3 * kEdges), slopes1(3 * kEdges);
  ASSERT_EQ(ft_edges_clearance(asked.get(), q0.data(), q1.data(), kEdges, 3, answers.data(),
                               slopes0.data(), slopes1.data()),
            FT_OK)
      << ft_last_error();
  const auto cpp = EdgeQuery::build(known_, Scene::build(raw_).value()).value();
  Scratch scratch;
  double own0[3], own1[3];
  for (std::size_t i = 0; i < kEdges; ++i) {
    const auto expected = cpp.clearance(&q0[3 * i], &q1[3 * i], 3, scratch, own0, own1).value();
    ASSERT_EQ(answers[i].lower, expected.lower) << i;
    ASSERT_EQ(answers[i].upper, expected.upper) << i;
    ASSERT_EQ(answers[i].t, expected.t) << i;
    ASSERT_EQ(answers[i].link, expected.link) << i;
    ASSERT_EQ(answers[i].triangle, expected.triangle) << i;
    ASSERT_EQ(answers[i].is_alone, expected.isAlone ? 1 : 0) << i;
    ASSERT_EQ(answers[i].normal[1], expected.nhat_SL_W.y()) << i;
    for (std::size_t k = 0; k < 3; ++k) {
      ASSERT_EQ(slopes0[3 * i + k], own0[k]) << i;
      ASSERT_EQ(slopes1[3 * i + k], own1[k]) << i;
    }
  }
  EXPECT_EQ(
      ft_edges_clearance(asked.get(), q0.data(), q1.data(), 1, 2, answers.data(), nullptr, nullptr),
      FT_ERROR_MISMATCH);
  EXPECT_EQ(
      ft_edges_clearance(asked.get(), q0.data(), nullptr, 1, 3, answers.data(), nullptr, nullptr),
      FT_ERROR_NULL_ARGUMENT);
}

TEST_F(CRobots, SayHowFarAPathIsFree) {
  const auto asked = edges();
  const double q[12] = {-2.0, 0, 0, -1.7, 0, 0, -1.6, 0, 0, -1.0, 0, 0};
  ft_path path{};
  path.size = sizeof path;
  ASSERT_EQ(ft_edges_answer_path(asked.get(), q, 4, 3, &path), FT_OK) << ft_last_error();
  EXPECT_EQ(path.verdict, FT_VERDICT_CONTACT);  // the wire below, at an angle of -1.46
  EXPECT_EQ(path.edge, 2U);
  EXPECT_GT(path.free_until, 2.0);
  EXPECT_LT(path.free_until, 3.0);
  ASSERT_EQ(ft_edges_answer_path(asked.get(), q, 3, 3, &path), FT_OK);
  EXPECT_EQ(path.verdict, FT_VERDICT_CLEAR);
  EXPECT_EQ(path.edge, 2U);
  EXPECT_EQ(path.free_until, 2.0);
}

TEST_F(CRobots, RefuseBadInput) {
  const auto asked = edges();
  double q0[6] = {0, 0, 0, 0, 0, 0};
  double q1[6] = {0, 0, 0, 0, std::nan(""), 0};
  ft_edge answers[2] = {};
  answers[0].size = sizeof answers[0];
  EXPECT_EQ(ft_edges_contact(asked.get(), 0, nullptr, nullptr), FT_ERROR_NO_STEP);
  EXPECT_EQ(ft_edges_answer(asked.get(), q0, q1, 2, 3, answers), FT_ERROR_NON_FINITE);
  EXPECT_EQ(ft_last_error_index(), 1);
  EXPECT_EQ(ft_edges_answer(asked.get(), q0, q1, 3, 2, answers), FT_ERROR_MISMATCH);
  EXPECT_EQ(ft_edges_answer(asked.get(), nullptr, q1, 1, 3, answers), FT_ERROR_NULL_ARGUMENT);
  EXPECT_EQ(ft_edges_answer(asked.get(), q0, q1, 1, 3, nullptr), FT_ERROR_NULL_ARGUMENT);
  EXPECT_EQ(ft_edges_answer(asked.get(), q0, q1, SIZE_MAX, 3, answers), FT_ERROR_LIMIT_EXCEEDED);
  EXPECT_EQ(ft_edges_answer(asked.get(), q0, q1, 1, 3, answers), FT_OK);  // of no length
  EXPECT_EQ(answers[0].verdict, FT_VERDICT_CLEAR);
  ft_path path{};
  path.size = sizeof path;
  EXPECT_EQ(ft_edges_answer_path(asked.get(), q0, 1, 3, &path), FT_ERROR_EMPTY);

  ft_edge_options options;
  ft_edge_options_init(&options, sizeof options);
  ft_edges* none = nullptr;
  options.threads = 0;
  EXPECT_EQ(ft_edges_create(robot_.get(), scene_.get(), &options, &none), FT_ERROR_OUT_OF_RANGE);
  ft_edge_options_init(&options, sizeof options);
  options.clearance = -1.0;
  EXPECT_EQ(ft_edges_create(robot_.get(), scene_.get(), &options, &none), FT_ERROR_OUT_OF_RANGE);
  // Rules of another avatar, and handles of another kind.
  const test::SmallWorld other;
  EXPECT_EQ(
      ft_edges_create(reinterpret_cast<ft_robot*>(scene_.get()), scene_.get(), nullptr, &none),
      FT_ERROR_WRONG_HANDLE);
  EXPECT_EQ(none, nullptr);

  const auto avatar = test::makeAvatar(known_.avatar());
  auto joints = jointsOf(known_);
  ft_robot* made = nullptr;
  EXPECT_EQ(ft_robot_create(avatar.get(), joints.data(), 2, nullptr, &made), FT_ERROR_MISMATCH);
  joints[1].lower = 5.0;
  EXPECT_EQ(ft_robot_create(avatar.get(), joints.data(), 3, nullptr, &made), FT_ERROR_OUT_OF_RANGE);
  EXPECT_EQ(ft_last_error_index(), 1);
  joints[1].kind = 5;
  EXPECT_EQ(ft_robot_create(avatar.get(), joints.data(), 3, nullptr, &made), FT_ERROR_OUT_OF_RANGE);
  joints = jointsOf(known_);
  joints[2].mimic_of = 2;
  EXPECT_EQ(ft_robot_create(avatar.get(), joints.data(), 3, nullptr, &made),
            FT_ERROR_BAD_HIERARCHY);
  const ft_lss rod = {{0.4, 0, 0}, {0.8, 0, 0}, 0.01};
  EXPECT_EQ(ft_robot_create_with_tool(robot_.get(), 7, "rod", &rod, 1, &made),
            FT_ERROR_OUT_OF_RANGE);
  EXPECT_EQ(made, nullptr);
  ASSERT_EQ(ft_robot_create_with_tool(robot_.get(), 2, "rod", &rod, 1, &made), FT_OK);
  ft_robot_destroy(made);
}

TEST_F(CRobots, AreReadFromUrdf) {
  FORETOUCH_REQUIRE_IMPORTER();
  const test::TempFolder folder;
  const std::string path = folder.write(
      "arm.urdf",
      "<robot name=\"r\"><link name=\"a\"><collision><geometry><sphere radius=\"0.1\"/></geometry>"
      "</collision></link><link name=\"b\"/><joint name=\"turn\" type=\"continuous\">"
      "<parent link=\"a\"/><child link=\"b\"/></joint></robot>");
  ft_import_options import;
  ft_import_options_init(&import, sizeof import);
  import.importer = FORETOUCH_TEST_IMPORTER;
  ft_urdf_options options;
  ASSERT_EQ(ft_urdf_options_init(&options, sizeof options), FT_OK);
  options.import = &import;
  ft_robot* made = nullptr;
  ASSERT_EQ(ft_robot_create_from_urdf(path.c_str(), &options, &made), FT_OK) << ft_last_error();
  const RobotHandle robot(made);
  size_t count = 0;
  ft_robot_coordinate coordinate{};
  coordinate.size = sizeof coordinate;
  ASSERT_EQ(ft_robot_coordinates(made, &coordinate, 1, &count), FT_OK);
  EXPECT_STREQ(coordinate.name, "turn");
  EXPECT_EQ(coordinate.is_periodic, 1);
  options.use_visual = 2;
  EXPECT_EQ(ft_robot_create_from_urdf(path.c_str(), &options, &made), FT_ERROR_OUT_OF_RANGE);
  EXPECT_EQ(ft_robot_create_from_urdf("absent.urdf", nullptr, &made), FT_ERROR_FILE_NOT_FOUND);
}

TEST_F(CRobots, MeetPropsWhereTheyArePlaced) {
  RawScene wire;
  wire.objectNames = {"wire"};
  std::vector<oracle::Triangle> judged;
  test::addWire(0.0, 0.0, wire, judged);
  const auto scene = test::makeScene(wire);
  ft_edge_prop prop{};
  prop.scene = scene.get();
  prop.rotation[0] = 1.0;
  prop.translation[0] = 1.0;
  ft_edge_options options;
  ASSERT_EQ(ft_edge_options_init(&options, sizeof options), FT_OK);
  options.props = &prop;
  options.prop_count = 1;
  const auto asked = edges(&options);
  const double q0[3] = {-0.3, 0, 0}, q1[3] = {0.3, 0, 0};
  ft_edge answer{};
  answer.size = sizeof answer;
  const auto verdict = [&] {
    EXPECT_EQ(ft_edges_answer(asked.get(), q0, q1, 1, 3, &answer), FT_OK) << ft_last_error();
    return answer.verdict;
  };
  ASSERT_EQ(verdict(), FT_VERDICT_CONTACT);
  std::int32_t met = -2;
  ASSERT_EQ(ft_edges_contact_prop(asked.get(), 0, &met), FT_OK) << ft_last_error();
  EXPECT_EQ(met, 0);
  ft_contact contact{};
  contact.size = sizeof contact;
  ASSERT_EQ(ft_edges_contact(asked.get(), 0, &contact, nullptr), FT_OK) << ft_last_error();
  EXPECT_EQ(contact.triangle, 0);
  EXPECT_EQ(contact.object, 0);
  EXPECT_NEAR(contact.point_scene[0], 1.0, 0.01);
  // As C++ does.
  EdgeOptions same;
  same.props = {{Scene::build(wire).value(), RigidPose{Quaternion::Identity(), {1, 0, 0}}, {}}};
  const auto cpp = EdgeQuery::build(known_, Scene::build(raw_).value(), same).value();
  Scratch scratch;
  EXPECT_EQ(answer.free_until, cpp.answer(q0, q1, 3, scratch).value().freeUntil);
  // It is moved away, back, and taken away.
  const double straight[4] = {1, 0, 0, 0}, away[3] = {3, 0, 0}, back[3] = {1, 0, 0};
  ASSERT_EQ(ft_edges_place(asked.get(), 0, straight, away), FT_OK) << ft_last_error();
  EXPECT_EQ(verdict(), FT_VERDICT_CLEAR);
  EXPECT_EQ(ft_edges_contact_prop(asked.get(), 0, &met), FT_ERROR_MISMATCH);
  ASSERT_EQ(ft_edges_place(asked.get(), 0, straight, back), FT_OK);
  EXPECT_EQ(verdict(), FT_VERDICT_CONTACT);
  ASSERT_EQ(ft_edges_place(asked.get(), 0, nullptr, nullptr), FT_OK);
  EXPECT_EQ(verdict(), FT_VERDICT_CLEAR);
  // Refused.
  const double skewed[4] = {2, 0, 0, 0}, far[3] = {2e4, 0, 0};
  EXPECT_EQ(ft_edges_place(asked.get(), 1, straight, back), FT_ERROR_OUT_OF_RANGE);
  EXPECT_EQ(ft_edges_place(asked.get(), 0, skewed, back), FT_ERROR_OUT_OF_RANGE);
  EXPECT_EQ(ft_edges_place(asked.get(), 0, straight, far), FT_ERROR_OUT_OF_RANGE);
  EXPECT_EQ(ft_edges_place(asked.get(), 0, straight, nullptr), FT_ERROR_NULL_ARGUMENT);
  prop.is_absent = 1;
  prop.rotation[0] = 0.0;
  const auto absent = edges(&options);
  ASSERT_EQ(ft_edges_answer(absent.get(), q0, q1, 1, 3, &answer), FT_OK) << ft_last_error();
  EXPECT_EQ(answer.verdict, FT_VERDICT_CLEAR);
  prop.scene = nullptr;
  ft_edges* none = nullptr;
  EXPECT_NE(ft_edges_create(robot_.get(), scene_.get(), &options, &none), FT_OK);
}

}  // namespace
}  // namespace foretouch
