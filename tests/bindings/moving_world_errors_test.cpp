// Every way in which ft_world_* can be refused.
#include <cstring>
#include <limits>

#include "tests/bindings/moving_world.h"

namespace foretouch {
namespace {

using test::expectRefused;
using test::refuse;

constexpr double kWorldNaN = std::numeric_limits<double>::quiet_NaN();

struct MakingWorld {
  test::SmallWorld small;
  ft_world_options options = test::initialised(ft_world_options_init);
  [[nodiscard]] ft_status make() const {
    auto* world = reinterpret_cast<ft_world*>(1);
    const ft_status status = ft_world_create(small.scene.get(), &options, &world);
    EXPECT_EQ(world == nullptr, status != FT_OK);
    ft_world_destroy(world);
    return status;
  }
};

TEST(CMovingWorldErrors, OfWorlds) {
  EXPECT_EQ(MakingWorld().make(), FT_OK);
  for (const double tolerance : {0.0, -1.0, 1e-9, 1e8, kWorldNaN}) {
    refuse<MakingWorld>([&](MakingWorld& m) { m.options.tolerance = tolerance; },
                        FT_ERROR_OUT_OF_RANGE, {"ft_world_create: tolerance", "expected"});
  }
  refuse<MakingWorld>([](MakingWorld& m) { m.options.asks_meshes = 2; }, FT_ERROR_OUT_OF_RANGE,
                      {"asks_meshes", "0 or 1"});
  refuse<MakingWorld>([](MakingWorld& m) { m.options.size = 3; }, FT_ERROR_STRUCT_SIZE,
                      {"ft_world_options"});
  const test::SmallWorld small;
  expectRefused(ft_world_create(nullptr, nullptr, nullptr), FT_ERROR_NULL_ARGUMENT, {"world"});
  ft_world* world = nullptr;
  const auto* wrong = reinterpret_cast<const ft_scene*>(small.avatar.get());
  expectRefused(ft_world_create(wrong, nullptr, &world), FT_ERROR_WRONG_HANDLE, {"scene"});
  EXPECT_EQ(world, nullptr);
  ft_world_destroy(nullptr);
}

struct AddingBody {
  test::SmallWorld small;
  test::WorldHandle world = test::makeWorld();
  ft_body_options options = test::initialised(ft_body_options_init);
  bool isMesh = false;
  [[nodiscard]] ft_status make() const {
    std::int32_t body = -5;
    const ft_status status =
        isMesh ? ft_world_add_mesh(world.get(), small.scene.get(), &options, &body)
               : ft_world_add_avatar(world.get(), small.avatar.get(), &options, &body);
    EXPECT_EQ(body, status == FT_OK ? 0 : -5);
    std::size_t count = 0;
    EXPECT_EQ(ft_world_body_count(world.get(), &count), FT_OK);
    EXPECT_EQ(count, status == FT_OK ? 1u : 0u);
    return status;
  }
};

TEST(CMovingWorldErrors, OfBodies) {
  EXPECT_EQ(AddingBody().make(), FT_OK);
  for (const bool isMesh : {false, true}) {
    for (const std::int32_t group : {-1, 32, std::numeric_limits<std::int32_t>::min()}) {
      refuse<AddingBody>([&](AddingBody& a) { a.options.group = group, a.isMesh = isMesh; },
                         FT_ERROR_OUT_OF_RANGE, {"group", "0 to 31"});
    }
  }
  for (const std::int32_t silent : {-1, 3}) {
    refuse<AddingBody>([&](AddingBody& a) { a.options.when_silent = silent; },
                       FT_ERROR_OUT_OF_RANGE, {"when_silent"});
  }
  for (const std::int32_t fidelity : {-1, 1, 3, 9}) {
    refuse<AddingBody>([&](AddingBody& a) { a.options.fidelity = fidelity; }, FT_ERROR_OUT_OF_RANGE,
                       {"fidelity", "LINK or _EXACT"});
  }
  refuse<AddingBody>([](AddingBody& a) { a.options.fidelity = FT_FIDELITY_EXACT; },
                     FT_ERROR_MISMATCH, {"fidelity", "triangles of the avatar"});
  refuse<AddingBody>([](AddingBody& a) { a.options.size = 3 * sizeof(void*) / 2; },
                     FT_ERROR_STRUCT_SIZE, {"ft_body_options"});
  refuse<AddingBody>(
      [](AddingBody& a) {
        a.options.self = reinterpret_cast<const ft_pair_rules*>(a.small.scene.get());
      },
      FT_ERROR_WRONG_HANDLE, {"rules"});
}

TEST(CMovingWorldErrors, OfRulesOfAnotherAvatar) {
  Avatar twoLinks = [] {
    RawSkeleton raw;
    raw.joints = {{"a", kNoParent, {0, 0, 0}, Quaternion::Identity()},
                  {"b", 0, {1, 0, 0}, Quaternion::Identity()},
                  {"c", 1, {1, 0, 0}, Quaternion::Identity()}};
    const Lss ball{{0, 0, 0}, {0, 0, 0}, 0.1};
    return Avatar::build(Skeleton::build(raw).value(), {{ball}, {ball}, {ball}}).value();
  }();
  const auto one = test::makeAvatar(twoLinks), other = test::makeAvatar(twoLinks);
  ft_pair_rules* rules = nullptr;
  ASSERT_EQ(ft_pair_rules_create(other.get(), nullptr, &rules), FT_OK) << ft_last_error();
  const test::RulesHandle owner(rules);
  auto options = test::initialised(ft_body_options_init);
  options.self = rules;
  const auto world = test::makeWorld();
  const test::SmallWorld small;
  std::int32_t body = 0;
  expectRefused(ft_world_add_avatar(world.get(), one.get(), &options, &body), FT_ERROR_MISMATCH,
                {"self"});
  expectRefused(ft_world_add_mesh(world.get(), small.scene.get(), &options, &body),
                FT_ERROR_MISMATCH, {"self"});
  EXPECT_EQ(ft_world_add_avatar(world.get(), other.get(), &options, &body), FT_OK);
}

TEST(CMovingWorldErrors, OfHandles) {
  const test::SmallWorld small;
  const auto world = test::makeWorld();
  std::int32_t body = 0;
  expectRefused(ft_world_add_avatar(nullptr, small.avatar.get(), nullptr, &body),
                FT_ERROR_NULL_ARGUMENT, {"world"});
  expectRefused(ft_world_add_avatar(world.get(), nullptr, nullptr, &body), FT_ERROR_NULL_ARGUMENT,
                {"avatar"});
  expectRefused(ft_world_add_mesh(world.get(), nullptr, nullptr, &body), FT_ERROR_NULL_ARGUMENT,
                {"mesh"});
  expectRefused(ft_world_add_mesh(world.get(), small.scene.get(), nullptr, nullptr),
                FT_ERROR_NULL_ARGUMENT, {"body"});
  auto* const wrong = reinterpret_cast<ft_world*>(small.avatar.get());
  expectRefused(ft_world_answer(wrong, 0, 1), FT_ERROR_WRONG_HANDLE, {"ft_world_answer", "world"});
  expectRefused(ft_world_forget_before(nullptr, 0), FT_ERROR_NULL_ARGUMENT, {"world"});
  expectRefused(ft_world_known_until(wrong, nullptr, nullptr), FT_ERROR_WRONG_HANDLE, {"world"});
  expectRefused(ft_world_body_count(world.get(), nullptr), FT_ERROR_NULL_ARGUMENT, {"count"});
  expectRefused(ft_query_step(reinterpret_cast<ft_query*>(world.get()), nullptr, nullptr),
                FT_ERROR_WRONG_HANDLE, {"query"});
}

TEST(CMovingWorldErrors, OfGroups) {
  const auto world = test::makeWorld();
  expectRefused(ft_world_ask(world.get(), -1, 0, 1), FT_ERROR_OUT_OF_RANGE, {"group"});
  expectRefused(ft_world_ask(world.get(), 0, 32, 1), FT_ERROR_OUT_OF_RANGE, {"group"});
  expectRefused(ft_world_ask(world.get(), 0, 0, 2), FT_ERROR_OUT_OF_RANGE, {"is_asked"});
  expectRefused(ft_world_ask_still(world.get(), 32, 1), FT_ERROR_OUT_OF_RANGE, {"group"});
  expectRefused(ft_world_ask_still(world.get(), 0, -1), FT_ERROR_OUT_OF_RANGE, {"is_asked"});
}

/// A body with a pose at 1000 us, and its next one.
struct PushingPose {
  test::SmallWorld small;
  test::WorldHandle world = test::makeWorld();
  std::int32_t body = 0;
  std::int64_t utime = 2000;
  ft_pose pose = test::SmallWorld::poseOf(test::SmallWorld::kIdentity, test::SmallWorld::kUp);
  PushingPose() {
    std::int32_t added = 0;
    EXPECT_EQ(ft_world_add_avatar(world.get(), small.avatar.get(), nullptr, &added), FT_OK);
    EXPECT_EQ(ft_world_push(world.get(), 0, 1000, &pose), FT_OK);
  }
  [[nodiscard]] ft_status make() const { return ft_world_push(world.get(), body, utime, &pose); }
};

TEST(CMovingWorldErrors, OfPoses) {
  EXPECT_EQ(PushingPose().make(), FT_OK);
  for (const std::int32_t body : {-1, 1, std::numeric_limits<std::int32_t>::max()}) {
    refuse<PushingPose>([&](PushingPose& p) { p.body = body; }, FT_ERROR_UNKNOWN_NAME,
                        {"ft_world_push: body", "1 that were added"});
    EXPECT_EQ(ft_last_error_index(), body);
  }
  for (const std::int64_t utime :
       {std::int64_t{1000}, std::int64_t{0}, std::numeric_limits<std::int64_t>::min(),
        std::numeric_limits<std::int64_t>::max(), (std::int64_t{1} << 53) + 1}) {
    refuse<PushingPose>([&](PushingPose& p) { p.utime = utime; }, FT_ERROR_OUT_OF_RANGE,
                        {"ft_world_push: utime_us"});
  }
  refuse<PushingPose>([](PushingPose& p) { p.utime = std::int64_t{1} << 50; },
                      FT_ERROR_LIMIT_EXCEEDED, {"utime_us"});
  refuse<PushingPose>([](PushingPose& p) { p.pose.joint_count = 2; }, FT_ERROR_MISMATCH,
                      {"pose", "expected 1 joints, found 2"});
  refuse<PushingPose>([](PushingPose& p) { p.pose.rotations = nullptr; }, FT_ERROR_NULL_ARGUMENT,
                      {"rotations"});
  refuse<PushingPose>([](PushingPose& p) { p.pose.size = 9; }, FT_ERROR_STRUCT_SIZE, {"pose"});
  static const double notUnit[4] = {0, 0, 0, 0}, notNumber[4] = {kWorldNaN, 0, 0, 1};
  refuse<PushingPose>([](PushingPose& p) { p.pose.rotations = notUnit; }, FT_ERROR_OUT_OF_RANGE,
                      {"ft_world_push: pose"});
  refuse<PushingPose>([](PushingPose& p) { p.pose.rotations = notNumber; }, FT_ERROR_NON_FINITE,
                      {"ft_world_push: pose"});
  const PushingPose p;
  expectRefused(ft_world_push(p.world.get(), 0, 2000, nullptr), FT_ERROR_NULL_ARGUMENT, {"pose"});
}

/// Three bodies at 0 and 1000 us; the second is to be carried by the first.
struct AttachingBody {
  test::SmallWorld small;
  test::WorldHandle world = test::makeWorld();
  std::int32_t body = 1;
  ft_carrier carrier{sizeof(ft_carrier), 0, 0, 0};
  std::int64_t utime = 500;
  ft_pose pose = test::SmallWorld::poseOf(test::SmallWorld::kIdentity, test::SmallWorld::kUp);
  AttachingBody() {
    for (std::int32_t b = 0; b < 3; ++b) {
      std::int32_t added = 0;
      EXPECT_EQ(ft_world_add_avatar(world.get(), small.avatar.get(), nullptr, &added), FT_OK);
      for (const std::int64_t us : {0, 1000}) {
        EXPECT_EQ(ft_world_push(world.get(), b, us, &pose), FT_OK);
      }
    }
  }
  [[nodiscard]] ft_status make() const {
    return ft_world_attach(world.get(), body, &carrier, utime, &pose);
  }
};

TEST(CMovingWorldErrors, OfCarriers) {
  EXPECT_EQ(AttachingBody().make(), FT_OK);
  refuse<AttachingBody>([](AttachingBody& a) { a.carrier.body = 1; }, FT_ERROR_BAD_HIERARCHY,
                        {"ft_world_attach: body"});
  refuse<AttachingBody>([](AttachingBody& a) { a.carrier.body = 3; }, FT_ERROR_UNKNOWN_NAME,
                        {"body 3"});
  for (const std::int32_t link : {-1, 1}) {
    refuse<AttachingBody>([&](AttachingBody& a) { a.carrier.link = link; }, FT_ERROR_UNKNOWN_NAME,
                          {"links 0 to 0"});
  }
  refuse<AttachingBody>([](AttachingBody& a) { a.carrier.moves_in_frame = 2; },
                        FT_ERROR_OUT_OF_RANGE, {"moves_in_frame"});
  refuse<AttachingBody>([](AttachingBody& a) { a.carrier.size = sizeof(void*) / 2; },
                        FT_ERROR_STRUCT_SIZE, {"ft_carrier"});
  refuse<AttachingBody>([](AttachingBody& a) { a.body = 7; }, FT_ERROR_UNKNOWN_NAME, {"body"});
  for (const std::int64_t us : {std::int64_t{0}, std::int64_t{1001}, std::int64_t{-5}}) {
    refuse<AttachingBody>([&](AttachingBody& a) { a.utime = us; }, FT_ERROR_OUT_OF_RANGE,
                          {"body 1"});
  }
  const AttachingBody a;
  expectRefused(ft_world_attach(a.world.get(), 1, nullptr, 500, &a.pose), FT_ERROR_NULL_ARGUMENT,
                {"ft_carrier"});
  expectRefused(ft_world_detach(a.world.get(), 1, 500, &a.pose), FT_ERROR_MISMATCH,
                {"ft_world_detach: body", "not carried"});
  ASSERT_EQ(a.make(), FT_OK);
  expectRefused(ft_world_push(a.world.get(), 1, 2000, &a.pose), FT_ERROR_MISMATCH,
                {"held fast by body 0"});
  const ft_carrier back{sizeof(ft_carrier), 1, 0, 0};
  expectRefused(ft_world_attach(a.world.get(), 0, &back, 700, &a.pose), FT_ERROR_BAD_HIERARCHY,
                {"carries body 1"});
  expectRefused(ft_world_detach(a.world.get(), 1, 400, &a.pose), FT_ERROR_OUT_OF_RANGE, {"later"});
  EXPECT_EQ(ft_world_detach(a.world.get(), 1, 600, &a.pose), FT_OK) << ft_last_error();
}

TEST(CMovingWorldErrors, OfWindows) {
  const AttachingBody a;
  ft_world_contact contact{};
  contact.size = sizeof contact;
  ft_silent_body silent{};
  silent.size = sizeof silent;
  ft_world_counters counters{};
  counters.size = sizeof counters;
  std::size_t required = 0;
  expectRefused(ft_world_contacts(a.world.get(), nullptr, 0, nullptr), FT_ERROR_NO_STEP,
                {"ft_world_contacts", "ft_world_answer"});
  expectRefused(ft_world_silent(a.world.get(), nullptr, 0, nullptr), FT_ERROR_NO_STEP, {});
  expectRefused(ft_world_get_counters(a.world.get(), &counters), FT_ERROR_NO_STEP, {});
  constexpr std::int64_t kFirst = std::numeric_limits<std::int64_t>::min(),
                         kLast = std::numeric_limits<std::int64_t>::max();
  for (const auto& [from, to] : {std::pair<std::int64_t, std::int64_t>{0, 0},
                                 {1, 0},
                                 {0, 1001},
                                 {kFirst, 1000},
                                 {0, kLast},
                                 {kLast, kFirst}}) {
    expectRefused(ft_world_answer(a.world.get(), from, to), FT_ERROR_OUT_OF_RANGE,
                  {"ft_world_answer: window"});
  }
  const auto empty = test::makeWorld();
  expectRefused(ft_world_answer(empty.get(), 0, 1), FT_ERROR_EMPTY, {"window"});
  ASSERT_EQ(ft_world_answer(a.world.get(), 0, 1000), FT_OK) << ft_last_error();
  expectRefused(ft_world_contacts(a.world.get(), &contact, 0, &required), FT_ERROR_BUFFER_TOO_SMALL,
                {"contacts"});
  EXPECT_EQ(required, 3u);
  ft_world_contact three[3] = {};
  expectRefused(ft_world_contacts(a.world.get(), three, 3, nullptr), FT_ERROR_STRUCT_SIZE,
                {"ft_world_contact"});
  EXPECT_EQ(ft_world_silent(a.world.get(), nullptr, 0, &required), FT_OK);
  EXPECT_EQ(required, 0u);
  counters.size = 7;
  expectRefused(ft_world_get_counters(a.world.get(), &counters), FT_ERROR_STRUCT_SIZE,
                {"ft_world_counters"});
  expectRefused(ft_world_get_counters(a.world.get(), nullptr), FT_ERROR_NULL_ARGUMENT,
                {"ft_world_counters"});
}

/// A contact as an older and as a newer program has it.
TEST(CMovingWorldErrors, ContactsLieAsTheProgramHasThem) {
  const AttachingBody a;
  ASSERT_EQ(ft_world_answer(a.world.get(), 0, 1000), FT_OK);
  constexpr std::size_t kOldSize = 32, kNewSize = sizeof(ft_world_contact) + 16;
  for (const std::size_t size : {kOldSize, sizeof(ft_world_contact), kNewSize}) {
    std::vector<unsigned char> bytes(4 * kNewSize, 0x5a);
    const auto said = static_cast<std::uint32_t>(size);
    std::memcpy(bytes.data(), &said, sizeof said);
    auto* const contacts = reinterpret_cast<ft_world_contact*>(bytes.data());
    ASSERT_EQ(ft_world_contacts(a.world.get(), contacts, 3, nullptr), FT_OK);
    EXPECT_EQ(contacts->verdict, FT_VERDICT_STARTS_IN_CONTACT);
    EXPECT_EQ(contacts->time_us, 0);
    EXPECT_EQ(bytes[3 * size], 0x5a) << "written past the end";
    if (size == kNewSize) {
      EXPECT_EQ(bytes[size - 1], 0) << "unknown fields are zero";
    }
  }
}

}  // namespace
}  // namespace foretouch
