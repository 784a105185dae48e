// A solid world in C: its ticks and what they tell of moving bodies are those of the C++ library,
// bit for bit; so are its events, from enter to leave; and bad input is refused by name.
#include "middleware/solid_world/solid_world.h"

#include <foretouch/solid_world.h>
#include <string>
#include <vector>

#include "lss/index.h"
#include "tests/bindings/moving_world.h"
#include "tests/bindings/same_answers.h"
#include "tests/bindings/solid_world.h"

namespace foretouch {
namespace {

constexpr std::int64_t kTickUs = 11'111;

RawScene pressScene() {
  RawScene press;  // a plate that comes down on the arm
  press.triangles.push_back({{{{-0.2, 0, -1}, {1.2, 0, -1}, {1.2, 0, 1}}}});
  press.triangles.push_back({{{{-0.2, 0, -1}, {1.2, 0, 1}, {-0.2, 0, 1}}}});
  press.objectOf = {0, 1};
  press.objectNames = {"near", "far"};
  return press;
}

Avatar ballAvatar() {
  RawSkeleton bones;
  bones.joints.push_back({"Ball", kNoParent, {0, 0, 0}, Quaternion::Identity()});
  return Avatar::build(Skeleton::build(bones).value(), {{Lss{{0, 0, 0}, {0, 0, 0}, 0.02}}}).value();
}

/// A solid arm over a table, a press above it, a ball in its hand from half a second on.
class Workshop {
 public:
  explicit Workshop(SolidReach reach = SolidReach::Skin)
      : cxx(foretouch::SolidWorld::build(arm_.sceneOfCxx, 0, {}, reach).value()) {
    ft_world* made = nullptr;
    EXPECT_EQ(ft_solid_world_create(arm_.scene.get(), 0, static_cast<int>(reach), nullptr, &made),
              FT_OK)
        << ft_last_error();
    c.reset(made);
    const auto press = test::makeScene(pressScene());
    const auto ball = test::makeAvatar(ballAvatar());
    std::int32_t ofC[3] = {};
    EXPECT_EQ(ft_solid_world_add(c.get(), arm_.avatar.get(), nullptr, nullptr, &ofC[0]), FT_OK);
    EXPECT_EQ(ft_world_add_mesh(c.get(), press.get(), nullptr, &ofC[1]), FT_OK);
    EXPECT_EQ(ft_world_add_avatar(c.get(), ball.get(), nullptr, &ofC[2]), FT_OK);
    EXPECT_EQ(cxx.add(arm_.avatarOfCxx).value(), ofC[0]);
    EXPECT_EQ(cxx.world().add(Scene::build(pressScene()).value()).value(), ofC[1]);
    EXPECT_EQ(cxx.world().add(ballAvatar()).value(), ofC[2]);
    push(kPress, 0, {0, 0.8, 0});
    push(kBall, 0, {0, 3, 0});
  }

  void push(BodyId body, std::int64_t us, const Eigen::Vector3d& at) {
    const double rotation[4] = {1, 0, 0, 0}, translation[3] = {at.x(), at.y(), at.z()};
    const ft_pose pose = test::SmallWorld::poseOf(rotation, translation);
    ASSERT_EQ(ft_world_push(c.get(), body, us, &pose), FT_OK) << ft_last_error();
    ASSERT_TRUE(cxx.world().push(body, us, RigidPose{Quaternion::Identity(), at}).ok());
  }
  void take(std::int64_t us) {
    const double rotation[4] = {1, 0, 0, 0}, translation[3] = {0.1, 0.08, 0};
    const ft_pose pose = test::SmallWorld::poseOf(rotation, translation);
    const ft_carrier hand{sizeof hand, kArm, 2, 0};
    ASSERT_EQ(ft_world_attach(c.get(), kBall, &hand, us, &pose), FT_OK) << ft_last_error();
    const RigidPose at{Quaternion::Identity(), {0.1, 0.08, 0}};
    ASSERT_TRUE(cxx.world().attach(kBall, {kArm, 2, false}, us, at).ok());
  }

  /// One tick of both, and everything that both tell of it.
  void tick(std::int64_t us, const Pose& target, const std::vector<std::uint8_t>* tracked) {
    const test::PoseArrays arrays(target);
    const ft_pose pose = arrays.view();
    const ft_solid_target ofC{kArm, 0, &pose, tracked == nullptr ? nullptr : tracked->data()};
    ASSERT_EQ(ft_solid_world_tick(c.get(), us, &ofC, 1), FT_OK) << ft_last_error();
    const auto done = cxx.tick(us, {{kArm, &target, tracked}}, ticks_);
    ASSERT_TRUE(done.ok()) << describe(done.error());
    std::int64_t at = 0;
    EXPECT_EQ(ft_solid_world_at(c.get(), &at), FT_OK);
    EXPECT_EQ(at, us);
    ASSERT_EQ(ticks_.size(), 1u);
    test::expectSame(test::wholeTick(c.get(), kArm), ticks_[0].tick, arm_.sceneOfCxx);
    expectSameAround();
    expectSameEvents(us);
  }
  [[nodiscard]] Pose pose(double t) const { return test::armPose(arm_.avatarOfCxx, t); }

  static constexpr BodyId kArm = 0, kPress = 1, kBall = 2;
  test::WorldHandle c;
  std::size_t pushes = 0, slips = 0, crushes = 0, held = 0, enters = 0, leaves = 0;

 private:
  void expectSameAround() {
    ft_solid_tick tick{};
    tick.size = sizeof tick;
    std::int32_t isAssumed = -1;
    EXPECT_EQ(ft_solid_world_get_tick(c.get(), kArm, &tick, &isAssumed), FT_OK);
    EXPECT_EQ(isAssumed, ticks_[0].isAssumed ? 1 : 0);
    const auto contacts =
        test::listed<ft_solid_body_contact>([&](auto* list, std::size_t room, std::size_t* n) {
          return ft_solid_world_body_contacts(c.get(), kArm, list, room, n);
        });
    ASSERT_EQ(contacts.size(), ticks_[0].contacts.size());
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      expectSameContact(contacts[i], ticks_[0].contacts[i]);
      slips += contacts[i].slip_speed > 0.0 ? 1 : 0;
    }
    const auto crushed =
        test::listed<ft_solid_crush>([&](auto* list, std::size_t room, std::size_t* n) {
          return ft_solid_world_crushes(c.get(), kArm, list, room, n);
        });
    ASSERT_EQ(crushed.size(), ticks_[0].crushes.size());
    for (std::size_t i = 0; i < crushed.size(); ++i) {
      const SolidCrush& one = ticks_[0].crushes[i];
      EXPECT_EQ(crushed[i].body, one.body);
      EXPECT_EQ(crushed[i].link, one.link);
      EXPECT_EQ(crushed[i].is_over, one.isOver ? 1 : 0);
      EXPECT_EQ(crushed[i].since_us, one.sinceUs);
      EXPECT_EQ(crushed[i].depth, one.depth);
    }
    pushes += contacts.size();
    crushes += crushed.size();
    expectSameHeld();
  }

  void expectSameHeld() {
    const auto all = test::listed<ft_solid_held>([&](auto* list, std::size_t room, std::size_t* n) {
      return ft_solid_world_held(c.get(), kArm, list, room, n);
    });
    std::vector<std::pair<BodyId, int>> expected, found;
    for (const BodyId body : ticks_[0].tools) expected.emplace_back(body, FT_SOLID_HOLDS_TOOL);
    for (const BodyId body : ticks_[0].looseTools) {
      expected.emplace_back(body, FT_SOLID_HOLDS_LOOSE);
    }
    for (const BodyId body : ticks_[0].letGo) expected.emplace_back(body, FT_SOLID_HOLDS_LET_GO);
    for (const ft_solid_held& one : all) found.emplace_back(one.body, one.state);
    EXPECT_EQ(found, expected);
    held += all.size();
  }

  static void expectSameContact(const ft_solid_body_contact& ofC, const SolidBodyContact& one) {
    EXPECT_EQ(ofC.size, sizeof ofC);
    EXPECT_EQ(ofC.body, one.body);
    EXPECT_EQ(ofC.link, one.link);
    EXPECT_EQ(ofC.lss, one.lss);
    EXPECT_EQ(ofC.triangle, one.triangle);
    EXPECT_EQ(ofC.object, one.triangle) << "each triangle of the press is an object";
    test::expectSameVector(ofC.point, one.p_W);
    test::expectSameVector(ofC.normal, one.nhat_W);
    EXPECT_EQ(ofC.gap, one.gap);
    EXPECT_EQ(ofC.push, one.push);
    EXPECT_EQ(ofC.slip_speed, one.slipSpeed);
  }

  void expectSameEvents(std::int64_t us) {
    WorldEvents told;
    ASSERT_TRUE(cxx.follow(told).ok());
    ASSERT_EQ(ft_world_follow(c.get(), us), FT_OK) << ft_last_error();
    const auto events = test::listed<ft_event>([&](auto* list, std::size_t room, std::size_t* n) {
      return ft_world_events(c.get(), list, room, n);
    });
    ASSERT_EQ(events.size(), told.events.size());
    for (std::size_t i = 0; i < events.size(); ++i) {
      const WorldEvent& one = told.events[i];
      EXPECT_EQ(events[i].kind, static_cast<int>(one.kind));
      EXPECT_EQ(events[i].time_us, one.time.us);
      EXPECT_EQ(events[i].time_fraction, one.time.fraction);
      EXPECT_EQ(events[i].a.body, one.a.body);
      EXPECT_EQ(events[i].b.body, one.b.body);
      EXPECT_EQ(events[i].separation, one.separation);
      enters += events[i].kind == FT_EVENT_ENTER;
      leaves += events[i].kind == FT_EVENT_LEAVE;
    }
  }

  test::SolidWorld arm_;
  foretouch::SolidWorld cxx;
  std::vector<SolidBodyTick> ticks_;
};

/// The arm presses the table, a press comes down on it, crushes it and goes; it holds a ball.
void playBeside(Workshop& shop) {
  const std::vector<std::uint8_t> lost = {1, 1, 0};
  for (int frame = 1; frame <= 200; ++frame) {
    SCOPED_TRACE("frame " + std::to_string(frame));
    const std::int64_t us = kTickUs * frame;
    const double down = frame < 60 ? 0.0 : frame < 130 ? (frame - 60) / 70.0 : (200 - frame) / 70.0;
    shop.push(Workshop::kPress, us, {0, 0.8 - 0.9 * std::min(down, 1.0), 0});
    if (frame < 45) shop.push(Workshop::kBall, us, {0, 3, 0});
    if (frame == 45) shop.take(kTickUs * 44);
    shop.tick(us, shop.pose(frame / 90.0), frame > 30 && frame < 40 ? &lost : nullptr);
    if (testing::Test::HasFailure()) break;
  }
}

TEST(CSolidWorld, TellsWhatTheLibraryTells) {
  Workshop shop;
  playBeside(shop);
  EXPECT_GT(shop.pushes, 10u);
  EXPECT_GT(shop.slips, 5u);
  EXPECT_GT(shop.crushes, 5u);
  EXPECT_GT(shop.held, 100u);
  EXPECT_GT(shop.enters, 2u);
  EXPECT_GT(shop.leaves, 1u);
}

TEST(CSolidWorld, MayReachToTheSurface) {
  Workshop skin, surface(SolidReach::Surface);
  playBeside(skin);
  playBeside(surface);
  EXPECT_LT(surface.enters, skin.enters);
}

TEST(CSolidWorld, RefusesWhatItCannotDoAndChangesNothing) {
  Workshop shop;
  shop.push(Workshop::kPress, kTickUs, {0, 0.8, 0});
  shop.push(Workshop::kBall, kTickUs, {0, 3, 0});
  shop.tick(kTickUs, shop.pose(0.0), nullptr);
  const auto shown = test::wholeTick(shop.c.get(), Workshop::kArm).rotations;
  const test::PoseArrays arrays(shop.pose(0.1));
  const ft_pose pose = arrays.view(), none = [&] {
    ft_pose wrong = arrays.view();
    wrong.joint_count = 2;
    return wrong;
  }();
  const auto refused = [&](const ft_solid_target& target, std::int64_t us, ft_status status,
                           const std::vector<std::string>& words) {
    test::expectRefused(ft_solid_world_tick(shop.c.get(), us, &target, 1), status, words);
  };
  const ft_solid_target good{Workshop::kArm, 0, &pose, nullptr};
  refused({Workshop::kArm, 0, nullptr, nullptr}, 2 * kTickUs, FT_ERROR_NULL_ARGUMENT, {"pose"});
  refused({Workshop::kArm, 1, &pose, nullptr}, 2 * kTickUs, FT_ERROR_STRUCT_SIZE, {"reserved"});
  refused({Workshop::kArm, 0, &none, nullptr}, 2 * kTickUs, FT_ERROR_MISMATCH, {"pose"});
  refused({7, 0, &pose, nullptr}, 2 * kTickUs, FT_ERROR_UNKNOWN_NAME, {"body", "7"});
  refused(good, kTickUs, FT_ERROR_OUT_OF_RANGE, {"utime_us"});
  test::expectRefused(ft_solid_world_tick(shop.c.get(), 2 * kTickUs, nullptr, 1),
                      FT_ERROR_NULL_ARGUMENT, {"targets"});
  const ft_solid_target two[2] = {good, good};
  test::expectRefused(ft_solid_world_tick(shop.c.get(), 2 * kTickUs, two, 2),
                      FT_ERROR_DUPLICATE_NAME, {"body 0", "two targets"});
  refused(good, 2 * kTickUs, FT_ERROR_OUT_OF_RANGE, {"body 1", "known until"});  // the press waits
  test::expectRefused(
      ft_solid_world_shown(shop.c.get(), Workshop::kPress, nullptr, nullptr, 0, nullptr),
      FT_ERROR_NO_STEP, {"ft_solid_world_shown", "solid avatar"});
  EXPECT_EQ(test::wholeTick(shop.c.get(), Workshop::kArm).rotations, shown);
}

TEST(CSolidWorld, RefusesWorldsThatAreNone) {
  const test::SolidWorld arm;
  ft_world* made = nullptr;
  test::expectRefused(ft_solid_world_create(nullptr, 0, 0, nullptr, &made), FT_ERROR_NULL_ARGUMENT,
                      {"ft_solid_world_create", "scene"});
  test::expectRefused(ft_solid_world_create(arm.scene.get(), 0, 2, nullptr, &made),
                      FT_ERROR_OUT_OF_RANGE, {"reach", "2"});
  test::expectRefused(ft_solid_world_create(arm.scene.get(), INT64_MAX, 0, nullptr, &made),
                      FT_ERROR_OUT_OF_RANGE, {"begin"});
  EXPECT_EQ(made, nullptr);
  const auto plain = test::makeWorld();
  std::int32_t body = 0;
  std::int64_t at = 0;
  for (const ft_status status :
       {ft_solid_world_add(plain.get(), arm.avatar.get(), nullptr, nullptr, &body),
        ft_solid_world_tick(plain.get(), 1, nullptr, 0), ft_solid_world_at(plain.get(), &at),
        ft_solid_world_shown(plain.get(), 0, nullptr, nullptr, 0, nullptr)}) {
    EXPECT_EQ(status, FT_ERROR_MISMATCH);
  }
  ASSERT_EQ(ft_solid_world_create(arm.scene.get(), 0, 0, nullptr, &made), FT_OK);
  const test::WorldHandle world(made);
  auto options = test::initialised(ft_solid_options_init);
  options.may_snap = 1;
  test::expectRefused(ft_solid_world_add(world.get(), arm.avatar.get(), &options, nullptr, &body),
                      FT_ERROR_MISMATCH, {"ft_solid_world_add", "may_snap"});
}

}  // namespace
}  // namespace foretouch
