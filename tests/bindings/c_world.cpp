#include "tests/bindings/c_world.h"

namespace foretouch::test {

SceneArrays::SceneArrays(const RawScene& raw) : objects(raw.objectOf), names(raw.objectNames) {
  for (const Triangle& triangle : raw.triangles) {
    for (const Eigen::Vector3d& v : triangle.vertices) {
      indices.push_back(static_cast<std::uint32_t>(indices.size()));
      positions.insert(positions.end(), v.data(), v.data() + 3);
    }
  }
  for (const std::string& name : names) namePointers.push_back(name.c_str());
}

ft_scene_arrays SceneArrays::view() const {
  auto arrays = initialised(ft_scene_arrays_init);
  arrays.positions = positions.data();
  arrays.vertex_count = positions.size() / 3;
  arrays.indices = indices.data();
  arrays.triangle_count = indices.size() / 3;
  arrays.objects = objects.data();
  arrays.object_names = namePointers.data();
  arrays.object_count = names.size();
  return arrays;
}

AvatarArrays::AvatarArrays(const Avatar& avatar,
                           const std::vector<std::vector<Triangle>>& surface) {
  const Skeleton& skeleton = avatar.skeleton();
  for (JointId j = 0; j < skeleton.numJoints(); ++j) {
    names.push_back(skeleton.name(j));
    parents.push_back(skeleton.parent(j));
    const Eigen::Vector3d& offset = skeleton.restOffset(j);
    offsets.insert(offsets.end(), offset.data(), offset.data() + 3);
    const Quaternion& q = skeleton.restRotation(j);
    rotations.insert(rotations.end(), {q.w(), q.x(), q.y(), q.z()});
    for (const Lss& l : avatar.lss(j)) {
      lss.push_back({{l.a.x(), l.a.y(), l.a.z()}, {l.b.x(), l.b.y(), l.b.z()}, l.radius});
      lssLinks.push_back(j);
    }
    if (surface.empty()) continue;
    for (const Triangle& triangle : surface[static_cast<std::size_t>(j)]) {
      triangles.emplace_back();
      triangleLinks.push_back(j);
      for (std::size_t corner = 0; corner < 3; ++corner) {
        std::memcpy(triangles.back().vertices + 3 * corner, triangle.vertices[corner].data(),
                    3 * sizeof(double));
      }
    }
  }
  for (const std::string& name : names) namePointers.push_back(name.c_str());
}

ft_avatar_arrays AvatarArrays::view() const {
  auto arrays = initialised(ft_avatar_arrays_init);
  arrays.joint_count = names.size();
  arrays.names = namePointers.data();
  arrays.parents = parents.data();
  arrays.offsets = offsets.data();
  arrays.rotations = rotations.data();
  arrays.lss = lss.data();
  arrays.lss_links = lssLinks.data();
  arrays.lss_count = lss.size();
  if (triangles.empty()) return arrays;
  arrays.triangles = triangles.data();
  arrays.triangle_links = triangleLinks.data();
  arrays.triangle_count = triangles.size();
  return arrays;
}

PoseArrays::PoseArrays(const Pose& pose) {
  for (const Quaternion& q : pose.rotations) {
    rotations.insert(rotations.end(), {q.w(), q.x(), q.y(), q.z()});
  }
  for (const Eigen::Vector3d& p : pose.translations) {
    translations.insert(translations.end(), p.data(), p.data() + 3);
  }
}

ft_pose PoseArrays::view() const {
  auto pose = initialised(ft_pose_init);
  pose.joint_count = static_cast<std::uint32_t>(rotations.size() / 4);
  pose.rotations = rotations.data();
  pose.translations = translations.data();
  return pose;
}

SceneHandle makeScene(const RawScene& raw) {
  const SceneArrays arrays(raw);
  const ft_scene_arrays view = arrays.view();
  ft_scene* scene = nullptr;
  EXPECT_EQ(ft_scene_create(&view, &scene), FT_OK) << ft_last_error();
  return SceneHandle(scene);
}

AvatarHandle makeAvatar(const Avatar& avatar, const std::vector<std::vector<Triangle>>& surface) {
  const AvatarArrays arrays(avatar, surface);
  const ft_avatar_arrays view = arrays.view();
  ft_avatar* made = nullptr;
  EXPECT_EQ(ft_avatar_create(&view, &made), FT_OK) << ft_last_error();
  return AvatarHandle(made);
}

QueryHandle makeQuery(const SceneHandle& scene, const AvatarHandle& avatar,
                      const ft_query_options* options) {
  ft_query* query = nullptr;
  EXPECT_EQ(ft_query_create(scene.get(), avatar.get(), options, &query), FT_OK) << ft_last_error();
  return QueryHandle(query);
}

SmallWorld::SmallWorld() {
  RawScene floor;
  floor.triangles = {{{{{-5, 0, -5}, {5, 0, -5}, {5, 0, 5}}}},
                     {{{{-5, 0, -5}, {5, 0, 5}, {-5, 0, 5}}}}};
  floor.objectOf = {0, 0};
  floor.objectNames = {"floor"};
  scene = makeScene(floor);
  RawSkeleton bones;
  bones.joints.push_back({"stick", kNoParent, {0, 1, 0}, Quaternion::Identity()});
  const Lss stick{{0, 0, 0}, {0.3, 0, 0}, 0.04};
  avatar = makeAvatar(Avatar::build(Skeleton::build(bones).value(), {{stick}}).value());
}

ft_pose SmallWorld::poseOf(const double (&rotation)[4], const double (&translation)[3]) {
  auto pose = initialised(ft_pose_init);
  pose.joint_count = 1;
  pose.rotations = rotation;
  pose.translations = translation;
  return pose;
}

void expectRefused(ft_status got, ft_status expected, const std::vector<std::string>& words) {
  EXPECT_EQ(got, expected) << ft_status_name(got) << ": " << ft_last_error();
  const std::string message = ft_last_error();
  EXPECT_EQ(message.rfind("ft_", 0), 0u) << message;
  for (const std::string& word : words) {
    EXPECT_NE(message.find(word), std::string::npos) << message << "\nlacks " << word;
  }
}

}  // namespace foretouch::test
