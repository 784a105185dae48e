// Every way in which scenes and avatars can be refused, and that the message says where and what
// was expected.
#include <cmath>
#include <limits>

#include "tests/bindings/c_world.h"

namespace foretouch {
namespace {

using test::expectRefused;
using test::refuse;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr auto kMinusOne = static_cast<std::size_t>(-1);

/// A legal scene of two triangles that share an edge; every test breaks one thing.
struct Square {
  double positions[12] = {0, 0, 0, 1, 0, 0, 1, 0, 1, 0, 0, 1};
  std::uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
  std::int32_t objects[2] = {0, 1};
  const char* names[2] = {"left", "right"};
  ft_scene_arrays arrays = test::initialised(ft_scene_arrays_init);
  Square() {
    arrays.positions = positions;
    arrays.vertex_count = 4;
    arrays.indices = indices;
    arrays.triangle_count = 2;
    arrays.objects = objects;
    arrays.object_names = names;
    arrays.object_count = 2;
  }
  [[nodiscard]] ft_status make() const {
    ft_scene* scene = reinterpret_cast<ft_scene*>(1);
    const ft_status status = ft_scene_create(&arrays, &scene);
    EXPECT_EQ(scene == nullptr, status != FT_OK);
    ft_scene_destroy(scene);
    return status;
  }
};

TEST(CErrors, OfSceneArrays) {
  EXPECT_EQ(Square().make(), FT_OK);
  refuse<Square>([](Square& s) { s.arrays.reserved = 1; }, FT_ERROR_STRUCT_SIZE, {"reserved"});
  refuse<Square>([](Square& s) { s.arrays.positions = nullptr; }, FT_ERROR_NULL_ARGUMENT,
                 {"positions"});
  refuse<Square>([](Square& s) { s.arrays.triangle_count = kMinusOne; }, FT_ERROR_LIMIT_EXCEEDED,
                 {"50000000", "triangles"});
  refuse<Square>([](Square& s) { s.arrays.triangle_count = 0; }, FT_ERROR_EMPTY, {"triangle"});
  refuse<Square>([](Square& s) { s.arrays.object_count = kMinusOne; }, FT_ERROR_LIMIT_EXCEEDED,
                 {"objects"});
  refuse<Square>([](Square& s) { s.arrays.indices = nullptr; }, FT_ERROR_MISMATCH,
                 {"vertex_count", "6", "4"});
  refuse<Square>([](Square& s) { s.indices[5] = 4; }, FT_ERROR_OUT_OF_RANGE,
                 {"indices", "triangle 1", "vertex 4", "below 4"});
  EXPECT_EQ(ft_last_error_index(), 1);
  refuse<Square>([](Square& s) { s.objects[1] = 2; }, FT_ERROR_OUT_OF_RANGE,
                 {"object index below 2"});
  refuse<Square>([](Square& s) { s.objects[0] = -1; }, FT_ERROR_OUT_OF_RANGE, {"triangle 0"});
  refuse<Square>([](Square& s) { s.names[1] = nullptr; }, FT_ERROR_NULL_ARGUMENT,
                 {"object_names", "object 1"});
  refuse<Square>([](Square& s) { s.positions[3] = 1e8; }, FT_ERROR_OUT_OF_RANGE, {"1e7"});
  refuse<Square>([](Square& s) { s.positions[0] = kNaN; }, FT_ERROR_EMPTY, {"finite"});
  const Square square;
  ft_scene* scene = nullptr;
  expectRefused(ft_scene_create(nullptr, &scene), FT_ERROR_NULL_ARGUMENT, {"ft_scene_arrays"});
  expectRefused(ft_scene_create(&square.arrays, nullptr), FT_ERROR_NULL_ARGUMENT, {"scene"});
}

TEST(CErrors, LeaveOutWhatMayBeLeftOut) {
  Square s;
  s.positions[9] = kNaN;  // of the second triangle alone
  s.arrays.objects = nullptr;
  s.arrays.object_names = nullptr;
  s.arrays.object_count = 0;
  ft_scene* made = nullptr;
  ASSERT_EQ(ft_scene_create(&s.arrays, &made), FT_OK) << ft_last_error();
  const test::SceneHandle scene(made);
  ft_scene_info info{};
  info.size = sizeof info;
  ASSERT_EQ(ft_scene_get_info(made, &info), FT_OK);
  EXPECT_EQ(info.triangles, 1u);
  EXPECT_EQ(info.dropped_non_finite, 1u);
  EXPECT_EQ(info.object_count, 1);
  EXPECT_EQ(info.box_max[2], 1.0);
  const char* name = nullptr;
  ASSERT_EQ(ft_scene_object_name(made, 0, &name), FT_OK);
  EXPECT_STREQ(name, "object 0");
  expectRefused(ft_scene_object_name(made, 1, &name), FT_ERROR_OUT_OF_RANGE,
                {"object", "0 to 0", "1"});
  EXPECT_EQ(name, nullptr);
  expectRefused(ft_scene_object_name(made, -1, &name), FT_ERROR_OUT_OF_RANGE, {"-1"});
  expectRefused(ft_scene_object_name(made, 0, nullptr), FT_ERROR_NULL_ARGUMENT, {"name"});
  expectRefused(ft_scene_get_info(made, nullptr), FT_ERROR_NULL_ARGUMENT, {"ft_scene_info"});
}

/// A legal avatar of two joints with a triangle; every test breaks one thing.
struct Arm {
  const char* names[2] = {"upper", "lower"};
  std::int32_t parents[2] = {-1, 0};
  double offsets[6] = {0, 1, 0, 0.3, 0, 0};
  double rotations[8] = {1, 0, 0, 0, 1, 0, 0, 0};
  ft_lss lss[2] = {{{0, 0, 0}, {0.3, 0, 0}, 0.05}, {{0, 0, 0}, {0.25, 0, 0}, 0.04}};
  std::int32_t lssLinks[2] = {0, 1};
  ft_triangle triangle = {{0, 0, 0, 0.1, 0, 0, 0.1, 0.01, 0}};
  std::int32_t triangleLink = 1;
  ft_avatar_arrays arrays = test::initialised(ft_avatar_arrays_init);
  Arm() {
    arrays.joint_count = 2;
    arrays.names = names;
    arrays.parents = parents;
    arrays.offsets = offsets;
    arrays.rotations = rotations;
    arrays.lss = lss;
    arrays.lss_links = lssLinks;
    arrays.lss_count = 2;
    arrays.triangles = &triangle;
    arrays.triangle_links = &triangleLink;
    arrays.triangle_count = 1;
  }
  [[nodiscard]] ft_status make() const {
    ft_avatar* avatar = reinterpret_cast<ft_avatar*>(1);
    const ft_status status = ft_avatar_create(&arrays, &avatar);
    EXPECT_EQ(avatar == nullptr, status != FT_OK);
    ft_avatar_destroy(avatar);
    return status;
  }
};

TEST(CErrors, OfAvatarArrays) {
  EXPECT_EQ(Arm().make(), FT_OK);
  {
    Arm a;
    a.arrays.rotations = nullptr;
    EXPECT_EQ(a.make(), FT_OK);
  }
  refuse<Arm>([](Arm& a) { a.arrays.reserved = 1; }, FT_ERROR_STRUCT_SIZE, {"reserved"});
  refuse<Arm>([](Arm& a) { a.arrays.joint_count = 0; }, FT_ERROR_EMPTY, {"joint"});
  refuse<Arm>([](Arm& a) { a.arrays.joint_count = kMinusOne; }, FT_ERROR_LIMIT_EXCEEDED, {"4096"});
  refuse<Arm>([](Arm& a) { a.arrays.names = nullptr; }, FT_ERROR_NULL_ARGUMENT, {"names"});
  refuse<Arm>([](Arm& a) { a.arrays.parents = nullptr; }, FT_ERROR_NULL_ARGUMENT, {"parents"});
  refuse<Arm>([](Arm& a) { a.arrays.offsets = nullptr; }, FT_ERROR_NULL_ARGUMENT, {"offsets"});
  refuse<Arm>([](Arm& a) { a.arrays.lss = nullptr; }, FT_ERROR_NULL_ARGUMENT, {"lss"});
  refuse<Arm>([](Arm& a) { a.arrays.lss_links = nullptr; }, FT_ERROR_NULL_ARGUMENT, {"lss_links"});
  refuse<Arm>([](Arm& a) { a.arrays.lss_count = kMinusOne; }, FT_ERROR_LIMIT_EXCEEDED, {"lss"});
  refuse<Arm>([](Arm& a) { a.arrays.lss_count = 0; }, FT_ERROR_EMPTY, {"LSS"});
  refuse<Arm>([](Arm& a) { a.names[1] = nullptr; }, FT_ERROR_NULL_ARGUMENT, {"names", "joint 1"});
  refuse<Arm>([](Arm& a) { a.names[1] = "upper"; }, FT_ERROR_DUPLICATE_NAME, {"upper"});
  refuse<Arm>([](Arm& a) { a.names[0] = "\xff\xfe"; }, FT_ERROR_SYNTAX, {"UTF-8"});
  refuse<Arm>([](Arm& a) { a.parents[0] = 1; }, FT_ERROR_BAD_HIERARCHY, {"joint 0"});
  EXPECT_EQ(ft_last_error_index(), 0);
  refuse<Arm>([](Arm& a) { a.parents[1] = -7; }, FT_ERROR_BAD_HIERARCHY, {"joint 1"});
  refuse<Arm>([](Arm& a) { a.offsets[4] = kNaN; }, FT_ERROR_NON_FINITE, {"joint 1"});
  refuse<Arm>([](Arm& a) { a.offsets[4] = 1e9; }, FT_ERROR_OUT_OF_RANGE, {"joint 1"});
  refuse<Arm>([](Arm& a) { a.rotations[0] = 0.5; }, FT_ERROR_OUT_OF_RANGE, {"norm"});
  refuse<Arm>([](Arm& a) { a.lss[1].radius = -1; }, FT_ERROR_NON_FINITE, {"link 1"});
  refuse<Arm>([](Arm& a) { a.lss[0].a[2] = 1e9; }, FT_ERROR_OUT_OF_RANGE, {"link 0"});
  refuse<Arm>([](Arm& a) { a.lssLinks[1] = 2; }, FT_ERROR_OUT_OF_RANGE,
              {"lss_links", "link 2", "0 to 1"});
  refuse<Arm>([](Arm& a) { a.triangleLink = -1; }, FT_ERROR_OUT_OF_RANGE, {"triangle_links"});
  {
    Arm a;
    a.triangle.vertices[0] = kNaN;
    EXPECT_NE(a.make(), FT_OK);
  }
  {
    Arm a;
    a.triangle.vertices[0] = 9;
    EXPECT_NE(a.make(), FT_OK);
  }  // outside its link's LSS
  refuse<Arm>([](Arm& a) { a.arrays.triangles = nullptr; }, FT_ERROR_NULL_ARGUMENT, {"triangles"});
  refuse<Arm>([](Arm& a) { a.arrays.triangle_links = nullptr; }, FT_ERROR_NULL_ARGUMENT,
              {"triangle_links"});
  refuse<Arm>([](Arm& a) { a.arrays.triangle_count = kMinusOne; }, FT_ERROR_LIMIT_EXCEEDED,
              {"triangles"});
}

TEST(CErrors, OfAskingAnAvatar) {
  Arm arm;
  ft_avatar* made = nullptr;
  ASSERT_EQ(ft_avatar_create(&arm.arrays, &made), FT_OK);
  const test::AvatarHandle avatar(made);
  std::size_t count = 0;
  std::int32_t number = -5;
  const char* name = nullptr;
  EXPECT_EQ(ft_avatar_joint_count(made, &count), FT_OK);
  EXPECT_EQ(count, 2u);
  EXPECT_EQ(ft_avatar_find_joint(made, "lower", &number), FT_OK);
  EXPECT_EQ(number, 1);
  EXPECT_EQ(ft_avatar_joint_parent(made, 1, &number), FT_OK);
  EXPECT_EQ(number, 0);
  EXPECT_EQ(ft_avatar_joint_name(made, 1, &name), FT_OK);
  EXPECT_STREQ(name, "lower");
  expectRefused(ft_avatar_joint_count(made, nullptr), FT_ERROR_NULL_ARGUMENT, {"count"});
  expectRefused(ft_avatar_find_joint(made, "hand", &number), FT_ERROR_UNKNOWN_NAME, {"hand"});
  expectRefused(ft_avatar_find_joint(made, nullptr, &number), FT_ERROR_NULL_ARGUMENT, {"name"});
  expectRefused(ft_avatar_joint_parent(made, 2, &number), FT_ERROR_OUT_OF_RANGE, {"joint", "2"});
  expectRefused(ft_avatar_joint_name(made, -1, &name), FT_ERROR_OUT_OF_RANGE, {"joint", "-1"});
  double rotations[8], translations[6];
  expectRefused(ft_avatar_rest_pose(made, rotations, translations, 1, &count),
                FT_ERROR_BUFFER_TOO_SMALL, {"room for 2", "1"});
  EXPECT_EQ(count, 2u);
  EXPECT_EQ(ft_avatar_rest_pose(made, nullptr, nullptr, 0, &count), FT_OK);
  EXPECT_EQ(ft_avatar_rest_pose(made, nullptr, translations, 2, nullptr), FT_OK);
  EXPECT_EQ(translations[3], 0.3);
  expectRefused(ft_avatar_rest_pose(made, nullptr, nullptr, 2, nullptr), FT_ERROR_NULL_ARGUMENT,
                {});
}

TEST(CErrors, OfAvatarTexts) {
  ft_avatar* avatar = nullptr;
  const std::string bad = "{\"format\": \"foretouch-avatar\", \"version\": 1, \"links\": [}";
  expectRefused(ft_avatar_create_from_text(bad.data(), bad.size(), "body.json", &avatar),
                FT_ERROR_SYNTAX, {"body.json:1"});
  expectRefused(ft_avatar_create_from_text(nullptr, 1, "x", &avatar), FT_ERROR_NULL_ARGUMENT,
                {"text"});
  expectRefused(ft_avatar_create_from_text("{}", 2, nullptr, &avatar), FT_ERROR_NULL_ARGUMENT,
                {"name"});
  expectRefused(ft_avatar_create_from_text("{}", kMinusOne, "x", &avatar), FT_ERROR_LIMIT_EXCEEDED,
                {"bytes"});
  const std::string good =
      "{\"format\": \"foretouch-avatar\", \"version\": 1, \"links\": [{\"name\": \"a\", "
      "\"parent\": "
      "null, \"offset\": [0,0,0], \"lss\": [{\"a\": [0,0,0], \"b\": [0,1,0], \"radius\": 0.1}]}]}";
  ASSERT_EQ(ft_avatar_create_from_text(good.data(), good.size(), "x", &avatar), FT_OK)
      << ft_last_error();
  ft_avatar_destroy(avatar);
}

TEST(CErrors, OfHandlesOfAnotherKind) {
  const test::SmallWorld world;
  const auto query = test::makeQuery(world.scene, world.avatar);
  auto* const asScene = reinterpret_cast<ft_scene*>(world.avatar.get());
  auto* const asAvatar = reinterpret_cast<ft_avatar*>(query.get());
  auto* const asQuery = reinterpret_cast<ft_query*>(world.scene.get());
  const ft_pose up = world.up();
  ft_query* made = nullptr;
  std::size_t count = 0;
  expectRefused(ft_query_create(asScene, world.avatar.get(), nullptr, &made), FT_ERROR_WRONG_HANDLE,
                {"scene"});
  expectRefused(ft_query_create(world.scene.get(), asAvatar, nullptr, &made), FT_ERROR_WRONG_HANDLE,
                {"avatar"});
  expectRefused(ft_query_step(asQuery, &up, &up), FT_ERROR_WRONG_HANDLE, {"query"});
  expectRefused(ft_avatar_joint_count(asAvatar, &count), FT_ERROR_WRONG_HANDLE, {"avatar"});
  ft_scene_destroy(asScene);  // nothing happens
  ft_scene_destroy(nullptr);
  ft_avatar_destroy(nullptr);
  ft_clip_destroy(nullptr);
  ft_query_destroy(nullptr);
  EXPECT_EQ(ft_avatar_joint_count(world.avatar.get(), &count), FT_OK);
}

TEST(CErrors, AreCutBetweenCharacters) {
  std::string path = "/nowhere/";
  for (int i = 0; i < 1000; ++i) path += "\xc3\xa9";
  for (int shift = 0; shift < 3; ++shift) {
    path.insert(0, "/");
    ft_avatar* avatar = nullptr;
    EXPECT_EQ(ft_avatar_create_from_file(path.c_str(), nullptr, &avatar), FT_ERROR_FILE_NOT_FOUND);
    const std::string message = ft_last_error();
    EXPECT_LT(message.size(), 1024u);
    EXPECT_GT(message.size(), 1000u);
    EXPECT_EQ(static_cast<unsigned char>(message.back()), 0xa9) << message.size();
  }
}

}  // namespace
}  // namespace foretouch
