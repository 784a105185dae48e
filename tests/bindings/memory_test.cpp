// The C library under a shortage of memory, and in steady state. This program's operator new is the
// library's too: it can be told to fail once, at its n-th call.
#include <atomic>
#include <cstdlib>
#include <dlfcn.h>
#include <foretouch/solid_world.h>
#include <new>
#include <string_view>

#include "tests/bindings/moving_world.h"
#include "tests/bindings/solid_world.h"
#include "tests/middleware/random_scene.h"

namespace {

std::atomic<std::uint64_t> allocations{0};
thread_local std::int64_t callsUntilFailure = -1;  // -1: never; of this thread alone

/// Embree 3.13 does not stand it: once its own allocator has failed, a later build may crash. It
/// brings TBB.
bool isEmbrees(const void* caller) {
  Dl_info found{};
  if (dladdr(caller, &found) == 0 || found.dli_fname == nullptr) return false;
  const std::string_view library = found.dli_fname;
  return library.find("libembree") != library.npos || library.find("libtbb") != library.npos;
}

void* allocate(std::size_t size, std::size_t alignment, const void* caller) {
  ++allocations;
  if (callsUntilFailure >= 0 && !isEmbrees(caller) && callsUntilFailure-- == 0) return nullptr;
  const std::size_t rounded = (size + alignment - 1) / alignment * alignment;
  return std::aligned_alloc(alignment, rounded == 0 ? alignment : rounded);
}

void* allocateOrThrow(std::size_t size, std::size_t alignment, const void* caller) {
  void* const memory = allocate(size, alignment, caller);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

constexpr std::size_t kAlignment = alignof(std::max_align_t);

}  // namespace

void* operator new(std::size_t size) {
  return allocateOrThrow(size, kAlignment, __builtin_return_address(0));
}
void* operator new[](std::size_t size) {
  return allocateOrThrow(size, kAlignment, __builtin_return_address(0));
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  return allocateOrThrow(size, static_cast<std::size_t>(alignment), __builtin_return_address(0));
}
void* operator new[](std::size_t size, std::align_val_t alignment) {
  return allocateOrThrow(size, static_cast<std::size_t>(alignment), __builtin_return_address(0));
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return allocate(size, kAlignment, __builtin_return_address(0));
}
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept {
  return allocate(size, kAlignment, __builtin_return_address(0));
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete[](void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}

namespace foretouch {
namespace {

/// Calls `ask` with the first, the second, ... allocation failing, until none is left to fail.
/// Gives how many failed. `other`: what a library below makes of a shortage.
template <typename Ask>
int failingOneByOne(const Ask& ask, ft_status other = FT_ERROR_OUT_OF_MEMORY) {
  constexpr int kMost = 100000;
  for (int n = 0; n < kMost; ++n) {
    callsUntilFailure = n;
    const ft_status status = ask();
    const bool didFail = callsUntilFailure == -1;
    callsUntilFailure = -1;
    if (!didFail) {
      EXPECT_EQ(status, FT_OK) << ft_last_error();
      return n;
    }
    // What is only a convenience may be gone without.
    if (status != FT_OK && status != other) {
      EXPECT_EQ(status, FT_ERROR_OUT_OF_MEMORY) << n << ": " << ft_last_error();
    }
  }
  ADD_FAILURE() << "no end";
  return 0;
}

struct Surroundings {
  Surroundings()
      : random(11),
        raw(test::clutter(random, 800, 2, Eigen::Vector3d::Zero())),
        body(test::bodyInClutter(random, 5, Eigen::Vector3d::Zero())) {}
  test::Random random;
  RawScene raw;
  test::RandomBody body;
};

TEST(CMemory, RunningOutWhileAnAvatarIsMadeIsAnError) {
  const Surroundings world;
  const test::AvatarArrays arrays(world.body.avatar);
  const ft_avatar_arrays view = arrays.view();
  const int failed = failingOneByOne([&] {
    ft_avatar* avatar = nullptr;
    const ft_status status = ft_avatar_create(&view, &avatar);
    EXPECT_EQ(avatar != nullptr, status == FT_OK);
    ft_avatar_destroy(avatar);
    return status;
  });
  EXPECT_GT(failed, 10);
}

TEST(CMemory, RunningOutWhileASceneIsMadeIsAnError) {
  const Surroundings world;
  const test::SceneArrays arrays(world.raw);
  const ft_scene_arrays view = arrays.view();
  const int failed = failingOneByOne(
      [&] {
        ft_scene* scene = nullptr;
        const ft_status status = ft_scene_create(&view, &scene);
        EXPECT_EQ(scene != nullptr, status == FT_OK);
        ft_scene_destroy(scene);
        return status;
      },
      FT_ERROR_DEVICE_FAILED);
  EXPECT_GT(failed, 5);
}

TEST(CMemory, RunningOutWhileAnAvatarOrItsRulesAreReadIsAnError) {
  constexpr std::string_view kText =
      R"({"format":"foretouch-avatar","version":1,"links":[
{"name":"a","parent":null,"offset":[0,0,0],"lss":[{"a":[0,0,0],"b":[0,0,0],"radius":0.1}]},
{"name":"b","parent":"a","offset":[1,0,0],"lss":[{"a":[0,0,0],"b":[1,0,0],"radius":0.1}]},
{"name":"c","parent":"b","offset":[1,0,0],"lss":[{"a":[0,0,0],"b":[0,0,0],"radius":0.1}]}]})";
  const int read = failingOneByOne(
      [&] {
        ft_avatar* avatar = nullptr;
        const ft_status status =
            ft_avatar_create_from_text(kText.data(), kText.size(), "text", &avatar);
        EXPECT_EQ(avatar != nullptr, status == FT_OK);
        ft_avatar_destroy(avatar);
        return status;
      },
      FT_ERROR_LIMIT_EXCEEDED);
  EXPECT_GT(read, 20);
  ft_avatar* made = nullptr;
  ASSERT_EQ(ft_avatar_create_from_text(kText.data(), kText.size(), "text", &made), FT_OK);
  const test::AvatarHandle avatar(made);
  const int ruled = failingOneByOne([&] {
    ft_pair_rules* rules = nullptr;
    const ft_status status = ft_pair_rules_create(avatar.get(), nullptr, &rules);
    EXPECT_EQ(rules != nullptr, status == FT_OK);
    ft_pair_rules_destroy(rules);
    return status;
  });
  EXPECT_GT(ruled, 5);
}

TEST(CMemory, RunningOutInAQueryIsAnErrorAndLeavesItUsable) {
  const Surroundings world;
  const auto scene = test::makeScene(world.raw);
  const auto avatar = test::makeAvatar(world.body.avatar);
  const test::PoseArrays from(world.body.from), to(world.body.to);
  const ft_pose first = from.view(), second = to.view();
  std::vector<ft_contact> expected(5), links(5);
  expected[0].size = links[0].size = sizeof(ft_contact);
  const auto undisturbed = test::makeQuery(scene, avatar);
  ASSERT_EQ(ft_query_step(undisturbed.get(), &first, &second), FT_OK);
  ASSERT_EQ(ft_query_links(undisturbed.get(), expected.data(), 5, nullptr), FT_OK);

  const int made = failingOneByOne([&] {
    ft_query* query = nullptr;
    const ft_status status = ft_query_create(scene.get(), avatar.get(), nullptr, &query);
    EXPECT_EQ(query != nullptr, status == FT_OK);
    ft_query_destroy(query);
    return status;
  });
  EXPECT_GT(made, 10);

  test::QueryHandle query;
  const int asked = failingOneByOne([&] {
    const std::int64_t until = std::exchange(callsUntilFailure, -1);
    query = test::makeQuery(scene, avatar);  // a fresh one, which has to grow
    callsUntilFailure = until;
    const ft_status status = ft_query_step(query.get(), &first, &second);
    if (status == FT_OK) return status;
    const std::int64_t after = std::exchange(callsUntilFailure, -1);
    EXPECT_EQ(ft_query_links(query.get(), nullptr, 0, nullptr), FT_ERROR_NO_STEP);
    EXPECT_EQ(ft_query_step(query.get(), &first, &second), FT_OK) << ft_last_error();
    EXPECT_EQ(ft_query_links(query.get(), links.data(), 5, nullptr), FT_OK);
    EXPECT_EQ(std::memcmp(links.data(), expected.data(), 5 * sizeof(ft_contact)), 0);
    callsUntilFailure = after;
    return static_cast<ft_status>(FT_ERROR_OUT_OF_MEMORY);
  });
  EXPECT_GT(asked, 3);
}

TEST(CMemory, IsNotAskedForOnceItHasGrown) {
  const Surroundings world;
  const auto query =
      test::makeQuery(test::makeScene(world.raw), test::makeAvatar(world.body.avatar));
  const test::PoseArrays from(world.body.from), to(world.body.to);
  const ft_pose first = from.view(), second = to.view();
  std::vector<ft_contact> contacts(5);
  std::vector<ft_transform> transforms(5);
  std::vector<double> rotations(20);
  std::uint64_t before = 0;
  for (int round = 0; round < 6; ++round) {
    before = allocations;
    EXPECT_EQ(ft_query_step(query.get(), &first, &second), FT_OK);
    EXPECT_EQ(ft_query_step(query.get(), nullptr, &first), FT_OK);
    contacts[0].size = sizeof(ft_contact);
    std::size_t count = 0;
    EXPECT_EQ(ft_query_contacts(query.get(), contacts.data(), 5, &count), FT_OK);
    EXPECT_GT(count, 0u);
    EXPECT_EQ(ft_motion_transforms(query.get(), 0.5, transforms.data(), 5, nullptr), FT_OK);
    EXPECT_EQ(ft_motion_pose(query.get(), 0.5, rotations.data(), nullptr, 5, nullptr), FT_OK);
  }
  EXPECT_EQ(allocations - before, 0u);
}

/// Ticks of one round: the arm presses, sweeps along, lifts, and goes back.
void playRound(ft_solid* solid, const std::vector<test::PoseArrays>& poses,
               std::vector<double>& numbers, std::vector<ft_solid_contact>& contacts) {
  for (const test::PoseArrays& arrays : poses) {
    const ft_pose pose = arrays.view();
    ft_solid_tick tick{};
    tick.size = sizeof tick;
    EXPECT_EQ(ft_solid_follow(solid, &pose, nullptr, 1.0 / 90.0, &tick), FT_OK);
    EXPECT_EQ(ft_solid_shown(solid, numbers.data(), nullptr, 3, nullptr), FT_OK);
    contacts[0].size = sizeof(ft_solid_contact);
    EXPECT_EQ(ft_solid_contacts(solid, contacts.data(), contacts.size(), nullptr), FT_OK);
  }
}

std::vector<test::PoseArrays> roundOf(const Avatar& avatar, int step) {
  std::vector<test::PoseArrays> poses;
  for (int frame = 0; frame <= 300; frame += step) {
    poses.emplace_back(test::armPose(avatar, frame / 90.0));
  }
  return poses;
}

TEST(CMemory, IsNotAskedForByASolidAvatarOnceItHasGrown) {
  const test::SolidWorld world;
  const auto solid = test::makeSolid(world.scene, world.avatar);
  const auto poses = roundOf(world.avatarOfCxx, 1);
  std::vector<double> numbers(12);
  std::vector<ft_solid_contact> contacts(100);
  std::uint64_t before = 0;
  for (int round = 0; round < 4; ++round) {
    before = allocations;
    playRound(solid.get(), poses, numbers, contacts);
  }
  EXPECT_EQ(allocations - before, 0u);
}

/// Whatever runs out, the next tick goes on from what was shown: nothing appears elsewhere.
TEST(CMemory, RunningOutInASolidAvatarIsAnErrorAndLeavesItWhereItWas) {
  const test::SolidWorld world;
  const auto poses = roundOf(world.avatarOfCxx, 30);
  Pose below = test::armPose(world.avatarOfCxx, 0.0);
  below.translations[0].y() = -0.5;
  const test::PoseArrays beyond(below);
  const ft_pose target = beyond.view();
  std::vector<double> shown(12);
  auto options = test::initialised(ft_solid_options_init);
  options.placing_reach = 0.2;  // the places to look at are soon listed
  test::SolidHandle solid;
  const int failed = failingOneByOne([&] {
    const std::int64_t until = std::exchange(callsUntilFailure, -1);
    solid = test::makeSolid(world.scene, world.avatar, &options);  // it has to grow
    ft_solid_tick tick{};
    tick.size = sizeof tick;
    const ft_pose above = poses[0].view();
    EXPECT_EQ(ft_solid_follow(solid.get(), &above, nullptr, 1.0 / 90.0, &tick), FT_OK);
    callsUntilFailure = until;
    const ft_status status = ft_solid_follow(solid.get(), &target, nullptr, 1.0 / 90.0, &tick);
    if (status == FT_OK) return status;
    const std::int64_t after = std::exchange(callsUntilFailure, -1);
    EXPECT_EQ(ft_solid_shown(solid.get(), nullptr, shown.data(), 3, nullptr), FT_OK);
    EXPECT_EQ(shown[1], poses[0].translations[1]);
    EXPECT_EQ(ft_solid_follow(solid.get(), &target, nullptr, 1.0 / 90.0, &tick), FT_OK);
    EXPECT_NE(tick.state, FT_SOLID_EQUAL) << "it is behind the table";
    EXPECT_EQ(tick.is_certified, 1);
    callsUntilFailure = after;
    return static_cast<ft_status>(FT_ERROR_OUT_OF_MEMORY);
  });
  EXPECT_GT(failed, 1);
  const int made = failingOneByOne([&] {
    ft_solid* another = nullptr;
    const ft_status status =
        ft_solid_create(world.scene.get(), world.avatar.get(), &options, &another);
    EXPECT_EQ(another != nullptr, status == FT_OK);
    ft_solid_destroy(another);
    return status;
  });
  EXPECT_GT(made, 10);
}

/// Whatever runs out in a tick, it is said, and nothing is shown that is not proven.
TEST(CMemory, RunningOutInASolidWorldIsAnErrorAndIsSaidFromThenOn) {
  const test::SolidWorld arm;
  const test::PoseArrays above(test::armPose(arm.avatarOfCxx, 0.0));
  const test::PoseArrays below(test::armPose(arm.avatarOfCxx, 1.0));
  const ft_pose first = above.view(), next = below.view();
  const ft_solid_target begin{0, 0, &first, nullptr}, target{0, 0, &next, nullptr};
  std::vector<double> shown(12);
  const int failed = failingOneByOne([&]() -> ft_status {
    const std::int64_t until = std::exchange(callsUntilFailure, -1);
    ft_world* made = nullptr;
    EXPECT_EQ(ft_solid_world_create(arm.scene.get(), 0, 0, nullptr, &made), FT_OK);
    const test::WorldHandle world(made);
    std::int32_t body = -1;
    EXPECT_EQ(ft_solid_world_add(made, arm.avatar.get(), nullptr, nullptr, &body), FT_OK);
    EXPECT_EQ(ft_solid_world_tick(made, 1000, &begin, 1), FT_OK) << ft_last_error();
    callsUntilFailure = until;
    const ft_status status = ft_solid_world_tick(made, 12000, &target, 1);
    if (status == FT_OK) return status;
    const std::int64_t after = std::exchange(callsUntilFailure, -1);
    EXPECT_EQ(ft_solid_world_shown(made, 0, shown.data(), nullptr, 3, nullptr), FT_OK);
    EXPECT_EQ(shown, above.rotations);
    EXPECT_NE(ft_solid_world_tick(made, 23000, &target, 1), FT_ERROR_OUT_OF_RANGE);
    callsUntilFailure = after;
    return status;
  });
  EXPECT_GT(failed, 1);
  const int added = failingOneByOne([&]() -> ft_status {
    const std::int64_t until = std::exchange(callsUntilFailure, -1);
    ft_world* made = nullptr;
    EXPECT_EQ(ft_solid_world_create(arm.scene.get(), 0, 0, nullptr, &made), FT_OK);
    const test::WorldHandle world(made);
    callsUntilFailure = until;
    std::int32_t body = -1;
    const ft_status status = ft_solid_world_add(made, arm.avatar.get(), nullptr, nullptr, &body);
    const std::int64_t after = std::exchange(callsUntilFailure, -1);
    if (status != FT_OK) {  // and the world does not have it
      EXPECT_EQ(ft_solid_world_add(made, arm.avatar.get(), nullptr, nullptr, &body), FT_OK);
    }
    EXPECT_EQ(body, 0);
    callsUntilFailure = after;
    return status;
  });
  EXPECT_GT(added, 10);
}

/// Two bodies that pass through each other and through a door that swings, one of them carrying a
/// third.
class PassingBodies {
 public:
  PassingBodies()
      : avatar_(test::makeAvatar(source_.body.avatar)),
        door_(test::makeScene(test::doorScene())),
        first_(source_.body.from),
        second_(source_.body.to),
        hinge_({{Quaternion::Identity()}, {Eigen::Vector3d(-0.45, -1.0, 0.0)}}) {}

  [[nodiscard]] const test::AvatarHandle& avatar() const { return avatar_; }
  [[nodiscard]] const test::SceneHandle& door() const { return door_; }

  [[nodiscard]] test::WorldHandle world() const {
    auto world = test::makeWorld();
    std::int32_t body = 0;
    for (int i = 0; i < 3; ++i) {
      EXPECT_EQ(ft_world_add_avatar(world.get(), avatar_.get(), nullptr, &body), FT_OK);
    }
    EXPECT_EQ(ft_world_add_mesh(world.get(), door_.get(), nullptr, &body), FT_OK);
    EXPECT_EQ(push(world.get(), 0), FT_OK);
    const ft_pose pose = first_.view();
    const ft_carrier hand{sizeof(ft_carrier), 0, 1, 0};
    EXPECT_EQ(ft_world_attach(world.get(), 2, &hand, 0, &pose), FT_OK) << ft_last_error();
    return world;
  }
  /// Everybody's pose at an instant; the first failure.
  ft_status push(ft_world* world, std::int64_t tick) const {
    const ft_pose one = (tick % 2 == 0 ? first_ : second_).view();
    const ft_pose other = (tick % 2 == 0 ? second_ : first_).view();
    const ft_pose door = hinge_.view();
    const std::int64_t us = 1000 * tick;
    if (const auto s = ft_world_push(world, 0, us, &one); s != FT_OK) return s;
    if (const auto s = ft_world_push(world, 1, us, &other); s != FT_OK) return s;
    return ft_world_push(world, 3, us, &door);
  }

 private:
  Surroundings source_;
  test::AvatarHandle avatar_;
  test::SceneHandle door_;
  test::PoseArrays first_, second_, hinge_;
};

TEST(CMemory, IsNotAskedForByAMovingWorldOnceItHasGrown) {
  const PassingBodies bodies;
  const auto world = bodies.world();
  std::vector<ft_world_contact> contacts(1000);
  std::uint64_t before = 0;
  std::size_t count = 0;
  for (std::int64_t tick = 1; tick < 20; ++tick) {
    if (tick == 14) before = allocations;
    ASSERT_EQ(bodies.push(world.get(), tick), FT_OK) << ft_last_error();
    ASSERT_EQ(ft_world_answer(world.get(), 1000 * (tick - 1), 1000 * tick), FT_OK);
    contacts[0].size = sizeof(ft_world_contact);
    ASSERT_EQ(ft_world_contacts(world.get(), contacts.data(), contacts.size(), &count), FT_OK);
    EXPECT_GT(count, 0u);
    ASSERT_EQ(ft_world_forget_before(world.get(), 1000 * tick), FT_OK);
  }
  EXPECT_EQ(allocations - before, 0u);
}

/// Whatever runs out, the next call answers as if nothing had been.
TEST(CMemory, RunningOutInAMovingWorldIsAnErrorAndLeavesItUsable) {
  const PassingBodies bodies;
  const auto undisturbed = bodies.world();
  ASSERT_EQ(bodies.push(undisturbed.get(), 1), FT_OK);
  ASSERT_EQ(ft_world_answer(undisturbed.get(), 0, 1000), FT_OK) << ft_last_error();
  const auto expected = test::contactsOf(undisturbed.get());
  ASSERT_GT(expected.size(), 0u);
  test::WorldHandle world;
  const int asked = failingOneByOne([&] {
    const std::int64_t until = std::exchange(callsUntilFailure, -1);
    world = bodies.world();  // a fresh one, which has to grow
    EXPECT_EQ(bodies.push(world.get(), 1), FT_OK);
    callsUntilFailure = until;
    const ft_status status = ft_world_answer(world.get(), 0, 1000);
    if (status == FT_OK) return status;
    const std::int64_t after = std::exchange(callsUntilFailure, -1);
    EXPECT_EQ(ft_world_contacts(world.get(), nullptr, 0, nullptr), FT_ERROR_NO_STEP);
    EXPECT_EQ(ft_world_answer(world.get(), 0, 1000), FT_OK) << ft_last_error();
    const auto contacts = test::contactsOf(world.get());
    EXPECT_EQ(contacts.size(), expected.size());
    EXPECT_EQ(std::memcmp(contacts.data(), expected.data(),
                          std::min(contacts.size(), expected.size()) * sizeof(ft_world_contact)),
              0);
    callsUntilFailure = after;
    return static_cast<ft_status>(FT_ERROR_OUT_OF_MEMORY);
  });
  EXPECT_GT(asked, 10);
}

TEST(CMemory, RunningOutWhileAMovingWorldIsMadeOrToldIsAnError) {
  const PassingBodies bodies;
  const test::PoseArrays arrays({{Quaternion::Identity()}, {Eigen::Vector3d::Zero()}});
  const ft_pose pose = arrays.view();
  const ft_carrier lift{sizeof(ft_carrier), 0, 0, 0};
  const int failed = failingOneByOne([&]() -> ft_status {
    ft_world* made = nullptr;
    const ft_status status = ft_world_create(bodies.door().get(), nullptr, &made);
    EXPECT_EQ(made != nullptr, status == FT_OK);
    const test::WorldHandle world(made);
    if (status != FT_OK) return status;
    std::int32_t body = -1;
    for (std::int32_t i = 0; i < 3; ++i) {
      const auto added = ft_world_add_mesh(made, bodies.door().get(), nullptr, &body);
      if (added != FT_OK) return added;
      EXPECT_EQ(body, i);
      if (const auto s = ft_world_push(made, body, 0, &pose); s != FT_OK) return s;
    }
    const auto added = ft_world_add_avatar(made, bodies.avatar().get(), nullptr, &body);
    if (added != FT_OK) return added;
    if (const auto s = ft_world_attach(made, 1, &lift, 0, &pose); s != FT_ERROR_OUT_OF_RANGE) {
      return s;  // it appears there
    }
    if (const auto s = ft_world_push(made, 0, 10, &pose); s != FT_OK) return s;
    if (const auto s = ft_world_push(made, 1, 10, &pose); s != FT_OK) return s;
    if (const auto s = ft_world_attach(made, 1, &lift, 5, &pose); s != FT_OK) return s;
    return ft_world_detach(made, 1, 7, &pose);
  });
  EXPECT_GT(failed, 20);
}

}  // namespace
}  // namespace foretouch
