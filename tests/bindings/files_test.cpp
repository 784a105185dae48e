// What is read from files: scenes and meshes by the importer, avatars, clips.
#include <cstdlib>
#include <string>

#include "assets/avatar/avatar_file.h"
#include "assets/avatar/joint_match.h"
#include "assets/bvh/bvh_reader.h"
#include "assets/mesh/link_mesh.h"
#include "tests/bindings/c_world.h"
#include "tests/bindings/importer.h"
#include "tests/support/environment.h"
#include "tests/support/temp_folder.h"

namespace foretouch {
namespace {

using test::expectRefused;

const char* const kTable = "o table\nv 0 0 1\nv 1 0 1\nv 0 100 1\nf 1 2 3\n";

ft_import_options withImporter() {
  auto options = test::initialised(ft_import_options_init);
  options.importer = FORETOUCH_TEST_IMPORTER;
  return options;
}

TEST(CFiles, ScenesAreImported) {
  FORETOUCH_REQUIRE_IMPORTER();
  const test::TempFolder folder;
  const std::string path = folder.write("table.obj", kTable);
  ft_import_options options = withImporter();
  options.scale = 0.01;
  options.up = FT_UP_Z;
  ft_scene* made = nullptr;
  ASSERT_EQ(ft_scene_create_from_file(path.c_str(), &options, &made), FT_OK) << ft_last_error();
  const test::SceneHandle scene(made);
  ft_scene_info info{};
  info.size = sizeof info;
  ASSERT_EQ(ft_scene_get_info(made, &info), FT_OK);
  EXPECT_EQ(info.triangles, 1u);
  // (x, y, z) cm becomes (x, z, -y) m.
  EXPECT_NEAR(info.box_min[1], 0.01, 1e-9);
  EXPECT_NEAR(info.box_min[2], -1.0, 1e-6);
  const char* name = nullptr;
  ASSERT_EQ(ft_scene_object_name(made, 0, &name), FT_OK);
  EXPECT_STREQ(name, "table");
}

TEST(CFiles, TheImporterIsFoundWhereItIsSaidToBe) {
  FORETOUCH_REQUIRE_IMPORTER();
  const test::TempFolder folder;
  const std::string path = folder.write("table.obj", kTable);
  ft_scene* scene = nullptr;
  // Beside the running program, with options or without.
  ASSERT_EQ(ft_scene_create_from_file(path.c_str(), nullptr, &scene), FT_OK) << ft_last_error();
  ft_scene_destroy(scene);
  ft_import_options options = withImporter();
  const std::string absent = folder / "foretouch-import";
  options.importer = absent.c_str();
  expectRefused(ft_scene_create_from_file(path.c_str(), &options, &scene), FT_ERROR_FILE_NOT_FOUND,
                {absent, "FORETOUCH_IMPORTER"});
  test::setVariable("FORETOUCH_IMPORTER", absent);
  expectRefused(ft_scene_create_from_file(path.c_str(), nullptr, &scene), FT_ERROR_FILE_NOT_FOUND,
                {absent});
  test::unsetVariable("FORETOUCH_IMPORTER");
}

TEST(CFiles, BadScenesAreRefused) {
  FORETOUCH_REQUIRE_IMPORTER();
  const test::TempFolder folder;
  const std::string path = folder.write("bad.obj", "f 1 2 3\n");
  ft_scene* scene = nullptr;
  ft_import_options options = withImporter();
  EXPECT_NE(ft_scene_create_from_file(path.c_str(), &options, &scene), FT_OK);
  EXPECT_NE(std::string(ft_last_error()).find(path), std::string::npos);
  expectRefused(ft_scene_create_from_file("/absent.obj", &options, &scene), FT_ERROR_FILE_NOT_FOUND,
                {"/absent.obj"});
  expectRefused(ft_scene_create_from_file(nullptr, &options, &scene), FT_ERROR_NULL_ARGUMENT,
                {"path"});
  expectRefused(ft_scene_create_from_file(path.c_str(), &options, nullptr), FT_ERROR_NULL_ARGUMENT,
                {"scene"});
  options.up = 2;
  expectRefused(ft_scene_create_from_file(path.c_str(), &options, &scene), FT_ERROR_OUT_OF_RANGE,
                {"up"});
  options = withImporter();
  options.scale = -1;
  expectRefused(ft_scene_create_from_file(path.c_str(), &options, &scene), FT_ERROR_OUT_OF_RANGE,
                {"scale"});
  options = withImporter();
  options.memory_limit_bytes = 1;
  expectRefused(ft_scene_create_from_file(path.c_str(), &options, &scene), FT_ERROR_OUT_OF_RANGE,
                {"memory"});
  options = withImporter();
  options.time_limit_s = 0;
  expectRefused(ft_scene_create_from_file(path.c_str(), &options, &scene), FT_ERROR_OUT_OF_RANGE,
                {"time"});
  EXPECT_EQ(scene, nullptr);
}

/// A stick whose mesh is in stick.glb beside the avatar file.
std::string writeStick(const test::TempFolder& folder) {
  RawSkeleton bones;
  bones.joints.push_back({"stick", kNoParent, {0, 1, 0}, Quaternion::Identity()});
  const Skeleton skeleton = Skeleton::build(bones).value();
  const Triangle thin{{{{0, 0, 0}, {0.25, 0, 0}, {0.25, 0.015625, 0}}}};
  EXPECT_TRUE(writeLinkMeshes(skeleton, {{thin}}, folder / "stick.glb").ok());
  const Lss lss{{0, 0, 0}, {0.3, 0, 0}, 0.04};
  const Avatar avatar = Avatar::build(skeleton, {{lss}}, {{"stick.glb", "stick"}}).value();
  EXPECT_TRUE(writeAvatarFile(avatar, folder / "stick.avatar.json").ok());
  return folder / "stick.avatar.json";
}

TEST(CFiles, AvatarsBringTheirMeshesWhereTheyAreAskedFor) {
  FORETOUCH_REQUIRE_IMPORTER();
  const test::TempFolder folder;
  const std::string path = writeStick(folder);
  const ft_import_options meshes = withImporter();
  ft_avatar *bare = nullptr, *full = nullptr;
  ASSERT_EQ(ft_avatar_create_from_file(path.c_str(), nullptr, &bare), FT_OK) << ft_last_error();
  ASSERT_EQ(ft_avatar_create_from_file(path.c_str(), &meshes, &full), FT_OK) << ft_last_error();
  const test::AvatarHandle bareAvatar(bare), fullAvatar(full);
  const test::SmallWorld world;
  ft_query_options options = test::initialised(ft_query_options_init);
  options.fidelity = FT_FIDELITY_EXACT;
  ft_query* query = nullptr;
  expectRefused(ft_query_create(world.scene.get(), bare, &options, &query), FT_ERROR_MISMATCH,
                {"FT_FIDELITY_EXACT"});
  const auto exact = test::makeQuery(world.scene, fullAvatar, &options);
  const ft_pose up = world.up(), lowered = world.lowered();
  ASSERT_EQ(ft_query_step(exact.get(), &up, &lowered), FT_OK);
  ft_contact contact{};
  contact.size = sizeof contact;
  ASSERT_EQ(ft_query_links(exact.get(), &contact, 1, nullptr), FT_OK);
  EXPECT_EQ(contact.link_triangle, 0);
  EXPECT_NEAR(contact.toi, 1.0 / 1.5, 1e-3);  // the mesh reaches the floor 4 cm after the LSS

  std::filesystem::remove(folder / "stick.glb");
  expectRefused(ft_avatar_create_from_file(path.c_str(), &meshes, &full), FT_ERROR_FILE_NOT_FOUND,
                {"stick.glb"});
  EXPECT_EQ(full, nullptr);
}

TEST(CFiles, ClipsOfModelsAreReadByTheImporter) {
  FORETOUCH_REQUIRE_IMPORTER();
  const test::TempFolder folder;
  ft_avatar* made = nullptr;
  ASSERT_EQ(ft_avatar_create_from_file(writeStick(folder).c_str(), nullptr, &made), FT_OK);
  const test::AvatarHandle avatar(made);
  ft_clip* clip = nullptr;
  expectRefused(ft_clip_create_from_file((folder / "stick.glb").c_str(), made, nullptr, &clip),
                FT_ERROR_EMPTY, {"stick.glb", "animation"});
  EXPECT_EQ(clip, nullptr);
}

TEST(CFiles, WithoutAnImporterWhatItWouldReadIsRefused) {
  if (FORETOUCH_TEST_IMPORTER[0] != '\0') GTEST_SKIP() << "built with the importer";
  const test::TempFolder folder;
  const std::string table = folder.write("table.obj", kTable);
  const std::string stick = writeStick(folder), mesh = folder / "stick.glb";
  ft_scene* scene = nullptr;
  expectRefused(ft_scene_create_from_file(table.c_str(), nullptr, &scene), FT_ERROR_IMPORT_FAILED,
                {table, "without the importer"});
  const ft_import_options meshes = test::initialised(ft_import_options_init);
  ft_avatar *full = nullptr, *bare = nullptr;
  expectRefused(ft_avatar_create_from_file(stick.c_str(), &meshes, &full), FT_ERROR_IMPORT_FAILED,
                {"stick.glb", "without the importer"});
  ASSERT_EQ(ft_avatar_create_from_file(stick.c_str(), nullptr, &bare), FT_OK) << ft_last_error();
  const test::AvatarHandle avatar(bare);
  ft_clip* clip = nullptr;
  expectRefused(ft_clip_create_from_file(mesh.c_str(), bare, nullptr, &clip),
                FT_ERROR_IMPORT_FAILED, {mesh, "without the importer"});
  EXPECT_EQ(scene, nullptr);
  EXPECT_EQ(full, nullptr);
  EXPECT_EQ(clip, nullptr);
}

const char* const kClip =
    "HIERARCHY\nROOT stick\n{\n OFFSET 0 0 0\n CHANNELS 6 Xposition Yposition Zposition Zrotation "
    "Xrotation Yrotation\n JOINT other\n {\n  OFFSET 10 0 0\n  CHANNELS 3 Zrotation Xrotation "
    "Yrotation\n  End Site\n  {\n   OFFSET 1 0 0\n  }\n }\n}\nMOTION\nFrames: 2\nFrame Time: "
    "0.05\n1 100 2 0 0 0 0 0 0\n1 200 2 0 0 90 0 0 0\n";

TEST(CFiles, ClipsGivePosesOfTheAvatar) {
  const test::TempFolder folder;
  const std::string path = folder.write("walk.bvh", kClip);
  const test::SmallWorld world;
  auto options = test::initialised(ft_clip_options_init);
  options.scale = 0.01;
  options.yaw_deg = 30;
  options.origin[0] = 5;
  ft_clip* made = nullptr;
  ASSERT_EQ(ft_clip_create_from_file(path.c_str(), world.avatar.get(), &options, &made), FT_OK)
      << ft_last_error();
  const test::ClipHandle clip(made);
  ft_clip_info info{};
  info.size = sizeof info;
  ASSERT_EQ(ft_clip_get_info(made, &info), FT_OK);
  EXPECT_EQ(info.matched_joints, 1);
  EXPECT_EQ(info.frame_count, 2u);
  EXPECT_EQ(info.frame_time_s, 0.05);

  // The same by the C++ API.
  BvhOptions bvh;
  bvh.scale = 0.01;
  const Clip read = readBvhFile(path, bvh).value();
  RawSkeleton bones;
  bones.joints.push_back({"stick", kNoParent, {0, 1, 0}, Quaternion::Identity()});
  const Skeleton skeleton = Skeleton::build(bones).value();
  const JointMatch match = matchJoints(skeleton, read.skeleton).value();
  const Pose expected =
      placed(skeleton, poseOfAvatar(skeleton, read, match, 1), {false, {5, 0, 0}, 30});
  double rotation[4], translation[3];
  std::size_t count = 0;
  ASSERT_EQ(ft_clip_pose(made, 1, rotation, translation, 1, &count), FT_OK) << ft_last_error();
  EXPECT_EQ(count, 1u);
  EXPECT_EQ(translation[1], 2.0);
  EXPECT_EQ(rotation[0], expected.rotations[0].w());
  EXPECT_EQ(rotation[2], expected.rotations[0].y());
  EXPECT_EQ(translation[0], expected.translations[0].x());

  expectRefused(ft_clip_pose(made, 2, rotation, translation, 1, &count), FT_ERROR_OUT_OF_RANGE,
                {"frame", "2"});
  expectRefused(ft_clip_pose(made, 0, rotation, translation, 0, &count), FT_ERROR_BUFFER_TOO_SMALL,
                {});
  expectRefused(ft_clip_get_info(made, nullptr), FT_ERROR_NULL_ARGUMENT, {});
}

/// Acclaim's format has the skeleton in a file of its own.
TEST(CFiles, AcclaimIsReadAboutTheSkeletonThatIsNamed) {
  const test::TempFolder folder;
  const std::string amc = folder.write(
      "walk.amc",
      ":FULLY-SPECIFIED\n:DEGREES\n1\nroot 0 2 0 0 0 0\nstick 0 0 30\n2\nroot 0 4 0 0 0 "
      "0\nstick 0 0 60\n");
  const auto skeleton = [&](const char* name, const char* length) {
    return folder.write(name, std::string(":version 1.10\n:units\n length ") + length +
                                  "\n angle deg\n:root\n order TX TY TZ RX RY RZ\n axis XYZ\n "
                                  "position 0 0 0\n orientation 0 0 0\n:bonedata\n begin\n id 1\n "
                                  "name stick\n direction 0 -1 0\n length 1\n axis 0 0 0 XYZ\n dof "
                                  "rx ry rz\n end\n:hierarchy\n begin\n root stick\n end\n");
  };
  const std::string first = skeleton("first.asf", "1"), second = skeleton("second.asf", "0.5");
  const test::SmallWorld world;
  auto options = test::initialised(ft_clip_options_init);
  options.scale = 0.01;
  ft_clip* clip = nullptr;
  for (const std::string& asf : {first, second}) {
    options.skeleton = asf.c_str();
    options.row_rate_hz = 50;
    ASSERT_EQ(ft_clip_create_from_file(amc.c_str(), world.avatar.get(), &options, &clip), FT_OK)
        << ft_last_error();
    const test::ClipHandle handle(clip);
    ft_clip_info info{};
    info.size = sizeof info;
    ASSERT_EQ(ft_clip_get_info(clip, &info), FT_OK);
    EXPECT_EQ(info.frame_count, 2u);
    EXPECT_EQ(info.frame_time_s, 0.02);
    double rotation[4], translation[3];
    std::size_t count = 0;
    ASSERT_EQ(ft_clip_pose(clip, 1, rotation, translation, 1, &count), FT_OK) << ft_last_error();
    EXPECT_NEAR(rotation[0], std::cos(30 * 3.14159265358979323846 / 180), 1e-12);
  }
  options.skeleton = nullptr;  // there are two beside it
  expectRefused(ft_clip_create_from_file(amc.c_str(), world.avatar.get(), &options, &clip),
                FT_ERROR_MISMATCH, {});
  options.skeleton = first.c_str();
  const std::string bvh = folder.write("walk.bvh", kClip);
  expectRefused(ft_clip_create_from_file(bvh.c_str(), world.avatar.get(), &options, &clip),
                FT_ERROR_MISMATCH, {"skeleton", ".amc"});
  options.row_rate_hz = -1;
  expectRefused(ft_clip_create_from_file(amc.c_str(), world.avatar.get(), &options, &clip),
                FT_ERROR_OUT_OF_RANGE, {"row_rate_hz"});
}

TEST(CFiles, BadClipsAreRefused) {
  const test::TempFolder folder;
  const test::SmallWorld world;
  const std::string good = folder.write("walk.bvh", kClip);
  const std::string bad = folder.write("bad.bvh", "HIERARCHY\nROOT\n");
  std::string renamed = kClip;
  renamed.replace(renamed.find("stick"), 5, "nobody");
  const std::string strange = folder.write("strange.bvh", renamed);
  const ft_avatar* const avatar = world.avatar.get();
  ft_clip* clip = nullptr;
  expectRefused(ft_clip_create_from_file(bad.c_str(), avatar, nullptr, &clip), FT_ERROR_SYNTAX,
                {bad});
  expectRefused(ft_clip_create_from_file(strange.c_str(), avatar, nullptr, &clip),
                FT_ERROR_MISMATCH, {strange, "nobody"});
  expectRefused(ft_clip_create_from_file("/absent.bvh", avatar, nullptr, &clip),
                FT_ERROR_FILE_NOT_FOUND, {"/absent.bvh"});
  expectRefused(ft_clip_create_from_file(good.c_str(), nullptr, nullptr, &clip),
                FT_ERROR_NULL_ARGUMENT, {"avatar"});
  for (int which = 0; which < 4; ++which) {
    auto options = test::initialised(ft_clip_options_init);
    if (which == 0) options.scale = -1;
    if (which == 1) options.yaw_deg = std::nan("");
    if (which == 2) options.origin[1] = 1e8;
    if (which == 3) options.up = -2;
    expectRefused(ft_clip_create_from_file(good.c_str(), avatar, &options, &clip),
                  FT_ERROR_OUT_OF_RANGE, {});
  }
  EXPECT_EQ(clip, nullptr);
}

}  // namespace
}  // namespace foretouch
