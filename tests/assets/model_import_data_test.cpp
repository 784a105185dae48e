// importModel() on real avatars and robots, where they are at hand: counts as recorded for them.
#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "assets/import/model_import.h"
#include "tests/assets/model_files.h"
#include "tests/support/shared_data.h"

namespace foretouch::test {
namespace {

struct KnownModel {
  const char* file;
  std::size_t nodes, triangles, bones, animations;
};

std::ostream& operator<<(std::ostream& stream, const KnownModel& model) {
  return stream << model.file;
}

class KnownAvatars : public testing::TestWithParam<KnownModel> {};

TEST_P(KnownAvatars, ComeWithAllTheirParts) {
  const KnownModel& known = GetParam();
  FORETOUCH_REQUIRE_SHARED(path, std::string("avatars/") + known.file);
  const auto result = importModel(*path, withModelImporter());
  ASSERT_TRUE(result.ok()) << describe(result.error());
  const Model& model = result.value();
  EXPECT_EQ(model.nodes.size(), known.nodes);
  EXPECT_EQ(trianglesOf(model), known.triangles);
  EXPECT_EQ(bonesOf(model), known.bones);
  EXPECT_EQ(model.animations.size(), known.animations);
  for (const ModelMesh& mesh : model.meshes) {
    for (const ModelBone& bone : mesh.bones) EXPECT_GE(bone.node, 0) << bone.name;
  }
}

// Bones are counted once a mesh. Raw, they are all there: its post-processing drops those without
// weights, which is why the catalogue of these files has fewer for some.
INSTANTIATE_TEST_SUITE_P(
    SharedData, KnownAvatars,
    testing::Values(KnownModel{"cesium_man.gltf", 22, 4672, 19, 1},
                    KnownModel{"robot_expressive.glb", 58, 3238, 19 * 43, 14},
                    KnownModel{"greenman.glb", 14, 356, 12, 4},
                    KnownModel{"Fox.glb", 27, 576, 24, 3},
                    KnownModel{"Testwuson.X", 40, 3732, 37, 3}, KnownModel{"guy.iqm", 1, 120, 0, 0},
                    KnownModel{"kaykit_manny/manny_med_mod.gltf", 30, 6756, 8 * 21, 0},
                    KnownModel{"kaykit_manny/Med_CombatMelee.glb", 24, 0, 0, 22},
                    KnownModel{"kaykit_manny/Med_MovementAdvanced.glb", 24, 0, 0, 13},
                    KnownModel{"makehuman/base.obj", 173, 36972, 0, 0}));

TEST(ImportGuyanim, IsRefusedAsItHoldsNothing) {
  FORETOUCH_REQUIRE_SHARED(path, "avatars/guyanim.iqm");
  const auto result = importModel(*path, withModelImporter());
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().code, ErrorCode::Empty);
  EXPECT_NE(result.error().message.find("expected triangles"), std::string::npos);
}

struct KnownRobot {
  const char* file;
  std::size_t links, moving, fixed, triangles, lss;
};

std::ostream& operator<<(std::ostream& stream, const KnownRobot& robot) {
  return stream << robot.file;
}

class KnownRobots : public testing::TestWithParam<KnownRobot> {};

TEST_P(KnownRobots, ComeWithAllTheirParts) {
  const KnownRobot& known = GetParam();
  FORETOUCH_REQUIRE_SHARED(path, std::string("robots/") + known.file);
  const auto result = importModel(*path, withModelImporter());
  ASSERT_TRUE(result.ok()) << describe(result.error());
  const Model& model = result.value();
  EXPECT_EQ(model.nodes.size(), known.links);
  std::size_t moving = 0, fixed = 0, lss = 0;
  for (const ModelNode& node : model.nodes) {
    moving += node.joint != ModelJointType::Free && node.joint != ModelJointType::Fixed;
    fixed += node.joint == ModelJointType::Fixed;
    lss += node.lss.size();
  }
  EXPECT_EQ(moving, known.moving);
  EXPECT_EQ(fixed, known.fixed);
  EXPECT_EQ(trianglesOf(model), known.triangles);
  EXPECT_EQ(lss, known.lss);
}

// Panda: its ten collision meshes have 3440 triangles, the finger's 32 counting twice.
INSTANTIATE_TEST_SUITE_P(
    SharedData, KnownRobots,
    testing::Values(KnownRobot{"kuka_iiwa/model.urdf", 8, 7, 0, 14758, 0},
                    KnownRobot{"franka_panda/panda.urdf", 13, 9, 3, 3440 + 32, 0},
                    KnownRobot{"capsule_humanoid/humanoid.urdf", 34, 21, 12, 0, 16 + 3}));

TEST(ImportPanda, FallsBackToCollisionWhereVisualMeshesAreMissing) {
  FORETOUCH_REQUIRE_SHARED(path, "robots/franka_panda/panda.urdf");
  ModelImportOptions options = withModelImporter();
  options.urdfSurface = UrdfSurface::Visual;
  const auto result = importModel(*path, options);
  ASSERT_TRUE(result.ok()) << describe(result.error());
  EXPECT_EQ(trianglesOf(result.value()), 3440U + 32U);
  const auto& notes = result.value().notes;
  EXPECT_EQ(std::count_if(notes.begin(), notes.end(),
                          [](const std::string& note) {
                            return note.find("was not found") != std::string::npos;
                          }),
            9);
}

TEST(ImportHumanoid, StandsUprightOnceTurned) {
  FORETOUCH_REQUIRE_SHARED(path, "robots/capsule_humanoid/humanoid.urdf");
  ModelImportOptions options = withModelImporter();
  options.import.up = UpAxis::Z;
  const auto result = importModel(*path, options);
  ASSERT_TRUE(result.ok()) << describe(result.error());
  const Model& model = result.value();
  const double thigh = toWorld(model, nodeNamed(model, "right_thigh")).translation.y();
  const double shin = toWorld(model, nodeNamed(model, "right_shin")).translation.y();
  const double torso = toWorld(model, nodeNamed(model, "torso")).translation.y();
  EXPECT_GT(torso, thigh + 0.2);
  EXPECT_GT(thigh, shin + 0.3);
}

}  // namespace
}  // namespace foretouch::test
