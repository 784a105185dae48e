#include "tests/bindings/solid_world.h"

#include <algorithm>
#include <cmath>

namespace foretouch::test {

SolidHandle makeSolid(const SceneHandle& scene, const AvatarHandle& avatar,
                      const ft_solid_options* options) {
  ft_solid* solid = nullptr;
  EXPECT_EQ(ft_solid_create(scene.get(), avatar.get(), options, &solid), FT_OK) << ft_last_error();
  return SolidHandle(solid);
}

RawScene tableScene(int numTiles) {
  RawScene table;
  const double side = 4.0 / numTiles;
  for (int i = 0; i < numTiles; ++i) {
    const double x = -2.0 + side * i;
    table.triangles.push_back({{{{x, 0, -2}, {x + side, 0, -2}, {x + side, 0, 2}}}});
    table.triangles.push_back({{{{x, 0, -2}, {x + side, 0, 2}, {x, 0, 2}}}});
    table.objectOf.insert(table.objectOf.end(), {0, 0});
  }
  table.objectNames = {"table"};
  return table;
}

Avatar armAvatar() {
  RawSkeleton bones;
  bones.joints.push_back({"Shoulder", kNoParent, {0, 0.3, 0}, Quaternion::Identity()});
  bones.joints.push_back({"Elbow", 0, {0.3, 0, 0}, Quaternion::Identity()});
  bones.joints.push_back({"Hand", 1, {0.25, 0, 0}, Quaternion::Identity()});
  const Lss upper{{0, 0, 0}, {0.3, 0, 0}, 0.05}, fore{{0, 0, 0}, {0.25, 0, 0}, 0.04};
  const Lss palm{{0, 0, 0}, {0.08, 0, 0}, 0.03};
  return Avatar::build(Skeleton::build(bones).value(), {{upper}, {fore}, {palm}}).value();
}

Pose armPose(const Avatar& avatar, double t) {
  const double down = std::clamp(std::min(t, 3.0 - t), 0.0, 1.0);
  const double along = std::clamp(t - 1.0, 0.0, 1.0);
  Pose pose = restPose(avatar.skeleton());
  pose.rotations[0] = Eigen::AngleAxisd(0.8 * along, Eigen::Vector3d::UnitY()) *
                      Eigen::AngleAxisd(-0.75 * down, Eigen::Vector3d::UnitZ());
  pose.rotations[1] = Eigen::AngleAxisd(-0.3 * down, Eigen::Vector3d::UnitZ());
  return validatedPose(avatar.skeleton(), std::move(pose)).value();
}

SolidWorld::SolidWorld()
    : avatarOfCxx(armAvatar()),
      sceneOfCxx(Scene::build(tableScene()).value()),
      scene(makeScene(tableScene())),
      avatar(makeAvatar(avatarOfCxx)) {}

WholeTick wholeTick(const ft_solid* solid, const ft_solid_tick& tick) {
  WholeTick whole;
  whole.tick = tick;
  std::size_t joints = 0, count = 0;
  EXPECT_EQ(ft_solid_shown(solid, nullptr, nullptr, 0, &joints), FT_OK) << ft_last_error();
  EXPECT_EQ(tick.joint_count, joints);
  if (joints == 0) return whole;
  whole.rotations.resize(4 * joints);
  whole.translations.resize(3 * joints);
  EXPECT_EQ(
      ft_solid_shown(solid, whole.rotations.data(), whole.translations.data(), joints, &count),
      FT_OK);
  whole.joints.resize(joints);
  whole.joints[0].size = sizeof(ft_solid_joint);
  EXPECT_EQ(ft_solid_joints(solid, whole.joints.data(), joints, &count), FT_OK);
  EXPECT_EQ(count, joints);
  whole.contacts.resize(tick.contact_count + 1);
  whole.contacts[0].size = sizeof(ft_solid_contact);
  EXPECT_EQ(ft_solid_contacts(solid, whole.contacts.data(), tick.contact_count, &count), FT_OK);
  EXPECT_EQ(count, tick.contact_count);
  if (tick.contact_count > 0) {
    EXPECT_EQ(whole.contacts.back().size, 0u) << "written past the end";
  }
  whole.contacts.pop_back();
  whole.wayTimes.resize(tick.way_count);
  whole.wayRotations.resize(4 * joints * tick.way_count);
  whole.wayTranslations.resize(3 * joints * tick.way_count);
  for (std::size_t i = 0; i < tick.way_count; ++i) {
    EXPECT_EQ(ft_solid_way(solid, i, &whole.wayTimes[i], &whole.wayRotations[4 * joints * i],
                           &whole.wayTranslations[3 * joints * i], joints, nullptr),
              FT_OK);
  }
  expectRefused(ft_solid_way(solid, tick.way_count, nullptr, nullptr, nullptr, 0, nullptr),
                FT_ERROR_OUT_OF_RANGE, {"ft_solid_way", "index"});
  return whole;
}

WholeTick follow(ft_solid* solid, const Pose& tracked, const std::vector<std::uint8_t>* isTracked) {
  const PoseArrays arrays(tracked);
  const ft_pose pose = arrays.view();
  ft_solid_tick tick{};
  tick.size = sizeof tick;
  const std::uint8_t* const flags = isTracked == nullptr ? nullptr : isTracked->data();
  EXPECT_EQ(ft_solid_follow(solid, &pose, flags, 1.0 / 90.0, &tick), FT_OK) << ft_last_error();
  return wholeTick(solid, tick);
}

}  // namespace foretouch::test
