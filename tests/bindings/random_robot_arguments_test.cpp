// Robots and edges by arguments drawn from what callers get wrong (random_caller.h). Whatever
// comes, the answer is a status of the list, and a handle where and only where it is FT_OK.
#include <algorithm>
#include <foretouch/robots.h>
#include <memory>
#include <string>

#include "tests/bindings/c_world.h"
#include "tests/bindings/random_caller.h"

namespace foretouch {
namespace {

struct ReleaseRobots {
  void operator()(ft_robot* robot) const { ft_robot_destroy(robot); }
  void operator()(ft_edges* edges) const { ft_edges_destroy(edges); }
};

class RobotCaller : public test::RandomCaller {
 public:
  RobotCaller(std::uint64_t seed, test::SmallWorld& world) : RandomCaller(seed), world_(world) {
    fillNumbers();
    makeGoodOnes();
  }

  void callSomething() {
    switch (random_.below(6)) {
      case 0: makeRobot(); break;
      case 1: makeTool(); break;
      case 2: readRobot(); break;
      case 3: makeEdges(); break;
      case 4: readFile(); break;
      default: askEdges(); break;
    }
  }

 private:
  /// A stick that turns about z, and its edges in the scene.
  void makeGoodOnes() {
    ft_robot_joint joint{};
    joint.kind = FT_JOINT_REVOLUTE;
    joint.mimic_of = -1;
    joint.axis[2] = 1.0;
    joint.lower = -10.0;
    joint.upper = 10.0;
    ft_robot* robot = nullptr;
    ASSERT_EQ(ft_robot_create(world_.avatar.get(), &joint, 1, nullptr, &robot), FT_OK);
    robot_.reset(robot);
    ft_edges* edges = nullptr;
    ASSERT_EQ(ft_edges_create(robot, world_.scene.get(), nullptr, &edges), FT_OK);
    edges_.reset(edges);
  }
  /// In one case of ten a handle of another kind.
  const ft_robot* robot() {
    if (random_.chance(0.1)) return reinterpret_cast<const ft_robot*>(world_.scene.get());
    return maybe(robot_.get());
  }

  void makeRobot() {
    fillNumbers();
    std::array<ft_robot_joint, kRoom> joints{};
    for (ft_robot_joint& joint : joints) {
      joint.kind = random_.chance(0.8) ? random_.below(5) : index();
      joint.mimic_of = random_.chance(0.7) ? -1 : index();
      joint.axis[random_.below(3)] = random_.chance(0.8) ? 1.0 : number();
      joint.lower = random_.chance(0.7) ? -1.0 : number();
      joint.upper = random_.chance(0.7) ? 1.0 : number();
      joint.mimic_factor = number();
      joint.mimic_offset = number();
    }
    const ft_avatar* avatar = maybe(world_.avatar.get());
    if (random_.chance(0.1)) avatar = reinterpret_cast<const ft_avatar*>(world_.scene.get());
    ft_robot* made = nullptr;
    takeHandle(ft_robot_create(avatar, maybe(joints.data()), random_.chance(0.8) ? 1 : count(),
                               random_.chance(0.5) ? nullptr : names_.data(), &made),
               made, ft_robot_destroy);
  }

  void makeTool() {
    std::array<ft_lss, kRoom> lss{};
    for (ft_lss& l : lss) l = {{0, 0, 0}, {number(), 0, 0}, number()};
    ft_robot* made = nullptr;
    takeHandle(
        ft_robot_create_with_tool(robot(), random_.chance(0.7) ? 0 : index(),
                                  names_[static_cast<std::size_t>(random_.below(5))],
                                  maybe(lss.data()), random_.chance(0.7) ? 1 : count(), &made),
        made, ft_robot_destroy);
    ft_avatar* avatar = nullptr;
    takeHandle(ft_robot_avatar(robot(), &avatar), avatar, ft_avatar_destroy);
  }

  void readRobot() {
    fillNumbers();
    std::size_t required = 0;
    take(ft_robot_coordinate_count(robot(), maybe(&required)));
    std::array<ft_robot_coordinate, 2> coordinates{};
    coordinates[0].size = sizeOr(sizeof(ft_robot_coordinate));
    const auto capacity = static_cast<std::size_t>(random_.below(3));
    take(ft_robot_coordinates(robot(), maybe(coordinates.data()), capacity, maybe(&required)));
    take(ft_robot_pose(robot(), maybe(numbers_.data()), random_.chance(0.8) ? 1 : count(),
                       maybe(numbers_.data() + 8), maybe(numbers_.data() + 16),
                       std::min<std::size_t>(capacity, 1), maybe(&required)));
  }

  void makeEdges() {
    ft_edge_options made = test::initialised(ft_edge_options_init);
    made.size = sizeOr(sizeof made);
    if (random_.chance(0.2)) made.threads = random_.chance(0.5) ? 1 + random_.below(3) : -1;
    if (random_.chance(0.2)) made.tolerance = number();
    if (random_.chance(0.2)) made.clearance = number();
    if (random_.chance(0.1)) {
      made.self = reinterpret_cast<const ft_pair_rules*>(world_.avatar.get());
    }
    for (ft_ignored_pair& pair : ignored_) pair = {index(), index()};
    if (random_.chance(0.2)) made.ignored = maybe(ignored_.data()), made.ignored_count = count();
    const ft_scene* scene = maybe(world_.scene.get());
    if (random_.chance(0.1)) scene = reinterpret_cast<const ft_scene*>(world_.avatar.get());
    ft_edges* edges = nullptr;
    takeHandle(ft_edges_create(robot(), scene, maybe(&made), &edges), edges, ft_edges_destroy);
  }

  void readFile() {
    ft_urdf_options made = test::initialised(ft_urdf_options_init);
    made.size = sizeOr(sizeof made);
    if (random_.chance(0.3)) made.max_lss_per_link = index();
    if (random_.chance(0.3)) made.use_visual = index();
    if (random_.chance(0.3)) made.reserved = index();
    if (random_.chance(0.3))
      made.package_paths = maybe(names_.data()), made.package_count = count();
    constexpr std::array<const char*, 5> kPaths = {"/absent/arm.urdf", "", "\xff", "/", nullptr};
    ft_robot* read = nullptr;
    takeHandle(ft_robot_create_from_urdf(kPaths[static_cast<std::size_t>(random_.below(5))],
                                         maybe(&made), &read),
               read, ft_robot_destroy);
  }

  void askEdges() {
    fillNumbers();
    ft_edges* edges = maybe(edges_.get());
    if (random_.chance(0.05)) edges = reinterpret_cast<ft_edges*>(world_.avatar.get());
    std::array<ft_edge, kRoom> answers{};
    answers[0].size = sizeOr(sizeof(ft_edge));
    const std::size_t width = random_.chance(0.9) ? 1 : count();
    take(ft_edges_answer(edges, maybe(numbers_.data()), maybe(numbers_.data() + kRoom), count(),
                         width, maybe(answers.data())));
    ft_contact contact{};
    contact.size = sizeOr(sizeof contact);
    ft_other_link other{};
    take(
        ft_edges_contact(edges, static_cast<std::size_t>(index()), maybe(&contact), maybe(&other)));
    std::array<ft_clearance, kRoom> clearances{};
    clearances[0].size = sizeOr(sizeof(ft_clearance));
    take(ft_edges_clearance(edges, maybe(numbers_.data()), maybe(numbers_.data() + kRoom), count(),
                            width, maybe(clearances.data()), nullptr, nullptr));
    ft_path path{};
    path.size = sizeOr(sizeof path);
    take(ft_edges_answer_path(edges, maybe(numbers_.data()), count(), width, maybe(&path)));
    take(ft_edges_contact(edges, static_cast<std::size_t>(random_.below(2)), maybe(&contact),
                          random_.chance(0.5) ? &other : nullptr));
  }

  test::SmallWorld& world_;
  std::unique_ptr<ft_robot, ReleaseRobots> robot_;
  std::unique_ptr<ft_edges, ReleaseRobots> edges_;
};

TEST(CRobotArguments, WhateverTheyAreGetAStatus) {
  constexpr int kCases = 3000, kCalls = 6;
  test::SmallWorld world;
  int accepted = 0, refused = 0;
  for (int i = 0; i < kCases; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    RobotCaller caller(static_cast<std::uint64_t>(i), world);
    for (int call = 0; call < kCalls; ++call) caller.callSomething();
    accepted += caller.accepted();
    refused += caller.refused();
    if (testing::Test::HasFailure()) break;
  }
  EXPECT_GT(accepted, kCases);
  EXPECT_GT(refused, kCases);
}

}  // namespace
}  // namespace foretouch
